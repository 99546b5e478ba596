// Made by tools/generate.mjs from the core's words: ./dev generate.
export const words = {
  'rebrush.left.Narrow': "Narrower than three beads",
  'rebrush.left.Small': "Smaller than ten squares of one bead width",
  'rebrush.left.Covered': "The next layer lies on part of it",
  'rebrush.left.Bridge': "Bridges air",
  'rebrush.left.Ironed': "Ironed afterwards; switch ironing off in the slicer",
  'rebrush.left.Interleaved': "The slicer goes back and forth between it and another face",
  'rebrush.left.Command': "A command inside it would be lost",
  'rebrush.left.Object': "Another object begins inside it",
  'rebrush.left.Height': "Its moves rise or fall",
  'rebrush.left.Modes': "Inches, relative coordinates, E in mm³ or arcs by their radius are not followed",
  'rebrush.left.Flow': "Its plastic is not that of one full layer",
  'rebrush.left.Travel': "The next move needs the nozzle where its last bead ended",
  'rebrush.left.Cut': "The file ends inside it",
} as const;
