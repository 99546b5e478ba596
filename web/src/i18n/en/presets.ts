// Names of the qualities of a toolpath.

export const words = {
  'preset.title': 'Quality',
  'preset.draft': 'Draft',
  'preset.standard': 'Standard',
  'preset.fine': 'Fine',
  'preset.fewest-turns': 'Fewest turns',
  'preset.custom': 'Custom',
  'preset.draft.help': 'Fast, and half the file size.',
  'preset.standard.help': 'Right for most plates.',
  'preset.fine.help': 'Fewest U-turns and kinks; takes longer.',
  'preset.fewest-turns.help':
    'Line width and directions may vary, and beads may leave the outline, where that saves U-turns.',
} as const;
