// Words about comparisons of the appearance and its sizes.

export const words = {
  'looks.over': 'Compare with',
  'looks.over.none': 'Plate alone',
  'looks.over.picture': 'Original picture',
  'looks.over.zigzag': 'A slicer’s straight lines',
  'looks.over.conflict': 'Where light is missing or too much',
  'looks.share.conflict': 'How much of the plate the map of missing light covers',
  'looks.share.picture': 'How much of the plate the original picture covers',
  'looks.share.zigzag': 'How much of the plate a slicer’s lines cover',
  'looks.size': 'Size',
  'looks.size.whole': 'Whole plate',
  'looks.size.life': 'Life size',
  'looks.size.arm': 'At arm’s length',
  'looks.size.free': 'As zoomed',
} as const;
