// Details of problems beyond their codes, and their places in files.

export const words = {
  'check.place': 'Line {line}: {what}',
  'check.places': 'Line {line} and {n} more: {what}',
  'problem.emptyFile': '{name} is empty.',
  'problem.emptyFile.hint': 'Nothing is in it. Download or copy it again.',
  'problem.otherFile': '{name} is a {format} file.',
  'problem.otherFile.hint': 'Export it as SVG, PNG or JPEG, and open that.',
  'reason.SettingOutOfRange': '{label} is {value}; it must be {low} to {high}.',
  'reason.SettingOutOfRange.hint': 'Change it, or undo.',
  'reason.OverBedEdge': 'The plate lies over the edge of the bed: {sides}.',
  'reason.left': '{mm} mm on the left',
  'reason.right': '{mm} mm on the right',
  'reason.front': '{mm} mm in front',
  'reason.back': '{mm} mm at the back',
  'reason.CopiesTooHigh.hint': 'Print fewer layers, or one plate at a time.',
  'reason.PlateTooLarge': 'The plate is too large for a spacing of {mm} mm.',
  'reason.leastSpacing': 'Choose a spacing of at least {mm} mm.',
  'reason.percent': 'At {percent} % of its size it would fit.',
} as const;
