// Made by tools/generate.mjs from the core's words: ./dev generate.
export const words = {
  'note.NotANumber': '{key} is {value}, which is not a number.',
  'note.OutOfRange': '{key} is {value}; it must be {low} to {high}.',
  'note.Thumbnails': '{key} is {value}; at most 8 sizes as PNG or QOI are taken.',
  'note.BedShape': '{key} is {value}; it must be corners such as “0x0,220x0,220x220,0x220”.',
  'note.BedUnknown': 'The file does not give the bed’s size; {width} × {depth} mm is assumed.',
  'note.BedCorners': 'The bed has {count} corners; the box around them is used.',
  'note.FilamentGuessed': 'The file gives no filament diameter; its beads match {diameter} mm, which is assumed.',
  'note.FilamentUnclear':
    'The file gives no filament diameter; with the {diameter} mm that is assumed, its beads would be {width} mm wide, from a nozzle of {nozzle} mm; check both.',
  'note.FlowTaken':
    'The flow ratio of the file’s filament is {value}; it is kept, and multiplies all that is extruded.',
  'note.ExcludedArea': '{key} is {value}; only one box can be excluded.',
  'note.Flavor': '{key} is {value}; known are Marlin, Klipper and RepRapFirmware; Marlin is assumed.',
  'note.BlockTooLong': '{key} is {value}; a block may have 65536 bytes.',
  'note.Placeholder': 'A placeholder has no value here: {detail}.',
  'note.SectionMissing': '{section} is inherited, but missing from the file.',
  'note.InheritedTooDeep': 'The file inherits in a circle, or from more than 1000 sections; the rest is missing.',
  'note.InheritedElsewhere': 'The file inherits from {name}, which is in another file; defaults fill the gaps.',
  'note.FixedArea': 'The start block names a fixed area ({line}); check that the plate lies there.',
  'note.FixedTemperatures':
    'The start block heats for purposes of its own ({lines}); these temperatures do not follow the filament.',
  'note.Factor': 'The start block has {line}, which scales the speed; it is set back to 100% after the block.',
  'note.FlowFactor': 'The start block has {line}, which scales the flow of the whole of each print.',
  'note.EndHeights': 'Heights in the end block were left out; the nozzle is lifted by 10 mm before it.',
  'note.EndPlaces': 'Places more than 10 mm off the bed were left out of the end block.',
  'note.NoHoming': 'The start block does not home.',
  'note.NoNozzleWait': 'The start block does not wait for a hot nozzle (M109).',
  'note.NoBedWait': 'The start block does not wait for a hot bed (M190).',
  'note.BeyondBed': 'The start block moves beyond the bed: {detail}.',
} as const;
