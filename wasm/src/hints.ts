// Made by tools/generate.mjs from the core's words: ./dev generate.
export const coreHints = {
  TooLarge: "Use a larger toolpath.spacing, a smaller size or smaller pictures.",
  EmptyShape: "The shape needs filled areas wider than a bead; convert text and lines to paths, or make small shapes larger.",
  DoesNotFit: "Make the print smaller, rotate or centre it, print fewer copies or layers, or choose another printer.",
  OutOfMemory: "Use a larger toolpath.spacing or a smaller size, or close what else needs memory.",
} as const;
