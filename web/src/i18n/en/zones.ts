// Words about bodies and their faces that carry a plate.

export const words = {
  'zones.title': 'Which face of {name}?',
  'zones.help':
    'The face becomes the plate: give it a picture, text or a pattern. Your slicer gets the whole body, with zones of straight lines on that face. Flat faces that look up as the file has it are listed.',
  'zones.reading': 'Reading {name}',
  'zones.face': '{width} × {height} mm, {z} mm high',
  'zones.area': '{area} mm²',
  'zones.none': '{name} has no flat face that looks up.',
  'zones.none.help':
    'It needs 25 mm² or more. Lay the body in your slicer or CAD program so that the face lies on top, and export it again.',
  'zones.tooLarge': '{name} has more than 64 MB.',
  'zones.opened': 'The plate is now a face of {name}. When it looks right, download the body with its zones.',
  'zones.download': 'Download the body',
} as const;
