// Roles that opened files can have in a plate.
import type { Plate, SourceFile } from './plate.js';

/** Roles that a picture can have. */
export const pictureRoles = [
  'lamp',
  'more',
  'mask',
  'tone',
  'edges',
  'levels',
  'colours',
  'angle',
  'rotation',
  'tangent',
  'modes',
  'none',
] as const;

/** Role of a file; the dictionary names it in `role.NAME`. */
export type Role = (typeof pictureRoles)[number] | 'shape' | 'project';

/** Note on how a picture differs from its file: it is one frame of an animation, or white artwork on a ground that
 * is black now. The dictionary has `files.NAME`. */
export type FileNote = 'animated' | 'white';

/** A file as it was opened, and its role. */
export interface Opened {
  source: SourceFile;
  notes: readonly FileNote[];
  role: Role;
  /** Roles that the file can have. */
  roles: readonly Role[];
}

/** Files that were opened together, with the plate before and after they were used. */
export interface OpenedFiles {
  before: Plate;
  made: Plate;
  files: readonly Opened[];
}

/** A file and the role that somebody has given it: 'shape', 'image' (its directions), or a `Role`. An empty role is
 * guessed. */
export interface Opening {
  file: File;
  role: string;
}
