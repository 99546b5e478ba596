// Corners, offset and holes of a shape.

export const words = {
  'shaping.corners': 'Corners',
  'shaping.corners.round': 'rounded',
  'shaping.corners.chamfer': 'cut off',
  'shaping.points': 'Points',
  'shaping.inner': 'Inner diameter',
  'shaping.inner.ring.help': '0 is half of the ring’s diameter.',
  'shaping.inner.tag.help': '0 is 5 mm, for a key ring.',
  'shaping.offset': 'Offset',
  'shaping.offset.help':
    'Moves the outline outwards, with round corners: a plate around a drawing. Below 0 it moves inwards and leaves a margin.',
  'shaping.holes': 'Holes',
  'shaping.holes.help': 'Places are those of the middle, from the lower left corner of the page.',
  'shaping.hole.screw': 'Screw, Ø {d} mm',
  'shaping.hole.keyring': 'Key ring, Ø {d} mm',
  'shaping.hole.magnet': 'Magnet, Ø {d} mm',
  'shaping.hole.x': 'Right',
  'shaping.hole.y': 'Up',
  'shaping.hole.diameter': 'Ø',
  'shaping.hole.remove': 'Remove hole {n}',
} as const;
