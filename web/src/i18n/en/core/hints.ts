// Made by tools/generate.mjs from the core's words: ./dev generate.
export const words = {
  'hint.TooLarge': "Use a larger “Line width”, a smaller size or smaller pictures.",
  'hint.EmptyShape': "The shape needs filled areas wider than a bead; convert text and lines to paths, or make small shapes larger.",
  'hint.DoesNotFit': "Make the print smaller, rotate or centre it, print fewer copies or layers, or choose another printer.",
  'hint.OutOfMemory': "Use a larger “Line width” or a smaller size, or close what else needs memory.",
} as const;
