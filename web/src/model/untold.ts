/** Parts of a plate that a link cannot carry. */
export const untoldParts = ['shape', 'directions', 'detail', 'layers', 'strokes', 'blocks'] as const;
export type Untold = (typeof untoldParts)[number];
