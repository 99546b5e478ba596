// Words of the fields for reading a drawing.

export const words = {
  'drawing.unitless': 'Lengths without a unit are',
  'drawing.unitless.px': 'pixels (1/96 inch)',
  'drawing.unitless.mm': 'millimetres',
  'drawing.paint': 'The drawing is read',
  'drawing.paint.shown': 'as it appears',
  'drawing.paint.ignore': 'by its outlines',
  'drawing.paint.help': 'By its outlines: whatever they are painted with, also what is not filled at all.',
  'drawing.keepThin': 'Keep thin places',
  'drawing.keepThin.help':
    'What is at least half a bead wide is widened to one bead. Otherwise it stays empty; the Check view marks it.',
} as const;
