// Words about the limits of links to plates.

export const words = {
  'link.missing': 'This link could not carry {parts}; something plain stands in their place. Ask for the project file.',
  'link.complete': 'It holds the whole plate.',
  'link.untold': 'A link cannot carry: {parts}. Send the project file for those.',
  'link.untold.shape': 'the shape’s file',
  'link.untold.directions': 'the picture of the directions',
  'link.untold.detail': 'the pictures in full size (small ones travel)',
  'link.untold.layers': 'layers with large files',
  'link.untold.strokes': 'your strokes',
  'link.untold.blocks': 'your printer’s start and end G-code',
  'link.copied': 'The link is in your clipboard.',
  'app.name': 'Sillon Studio',
} as const;
