// Words about the start and end G-code that a plate brings or the printer has, and about the printer that a plate
// brings.

export const words = {
  'blocks.title': 'Before you print',
  'blocks.help':
    'These lines run on your printer. Read them before the first download; you are not asked again until they change.',
  'blocks.generalHeatLimits': 'Temperature limits are off.',
  'blocks.unchecked': 'Not checked',
  'blocks.remove': 'Remove these lines',
  'brought.help':
    'Whoever made this plate chose these. Use them only if you know where they come from: they move and heat your printer.',
  'brought.setting': 'Setting',
  'brought.mine': 'Your printer',
  'brought.theirs': 'This plate',
} as const;
