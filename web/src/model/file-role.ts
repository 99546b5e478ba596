// What the files that people open are for.
import type { Plate, SourceFile } from './plate.js';

/** What a file may be for; the dictionary has `role.NAME`. */
export type Role =
  | 'shape'
  | 'mask'
  | 'colours'
  | 'lamp'
  | 'more'
  | 'tone'
  | 'edges'
  | 'levels'
  | 'angle'
  | 'rotation'
  | 'tangent'
  | 'modes'
  | 'project'
  | 'none';

/** A way in which a picture is not as it came: one of an animation's pictures, or white artwork on a ground that is black now. The
 * dictionary has `files.NAME`. */
export type FileNote = 'animated' | 'white';

/** A file as it was opened, and what it is used as. */
export interface Opened {
  source: SourceFile;
  notes: readonly FileNote[];
  role: Role;
  /** What it may be used as. */
  roles: readonly Role[];
}

/** Files that were opened together, and the plate without them and with them. */
export interface OpenedFiles {
  before: Plate;
  made: Plate;
  files: readonly Opened[];
}

/** A file, and what it is for where somebody says so: 'shape', 'image' (its directions), or a role. Empty: as it is guessed. */
export interface Opening {
  file: File;
  role: string;
}
