// Words about the directions of a drawing's colours.

export const words = {
  'colours.nth': 'Colour {n}',
  'colours.one': 'Colour {n}, {colour}',
  'colours.none': 'No flat colours were found in it.',
  'colours.tones': 'By brightness',
  'colours.tones.help': 'Dark colours are dark under the light at 60°, light ones bright.',
  'colours.even': 'Evenly apart',
  'colours.even.help': 'All directions as different as can be.',
  'colours.note': 'Colours with the same direction shine as one.',
} as const;
