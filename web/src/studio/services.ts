// Services that elements request from the layers above them, grouped by feature, with the file that implements each
// group. Each call may reject.
import type { Engine, Gcode, PlacedLayer } from 'sillon';
import type { Autosave, KeptPrint } from '../files/autosave.js';
import type { Example } from '../model/example.js';
import type { Role } from '../model/file-role.js';
import type { Fill } from '../model/fills.js';
import type { FreePlace, Taken, Wanted } from '../model/free-place.js';
import type { Plate } from '../model/plate.js';
import type { DirectionRaster } from '../model/raster.js';

/** Computes files and values of the current plate: app/making.ts. */
export interface MakingServices {
  /** Returns the engine, for work that does not depend on the plate. */
  engine(): Promise<Engine>;
  cancel(): void;
  retry(): void;
  gcode(): Promise<Gcode>;
  /** Returns the base layers as a solid, 3MF. */
  body(): Promise<Blob>;
  zones(): Promise<Blob>;
  svg(): Promise<Blob>;
  view(): Promise<Blob>;
  directions(plate: Plate): Promise<DirectionRaster>;
}

/** Finds the places of layers: app/making.ts. */
export interface PlacingServices {
  /** Returns the box in which the engine puts each complete layer, by layer id. */
  layerBoxes(plate: Plate): Promise<ReadonlyMap<number, PlacedLayer>>;
  /** Finds a free place on the plate for a new box. */
  freePlace(plate: Plate, taken: readonly Taken[], wanted: Wanted): Promise<FreePlace>;
}

/** Makes plates from files: app/opening.ts. */
export interface OpeningServices {
  /** Opens files in guessed roles; the dialog 'files' can change them. @throws StudioError, SillonError */
  open(files: readonly File[], role?: Role): Promise<void>;
  /** Gives one of the last opened files another role. */
  setRole(index: number, role: Role): Promise<void>;
  openExample(example: Example): Promise<void>;
  /** Shows another plate, on the visitor's own printer. */
  openMade(make: (plate: Plate) => Plate): void;
}

/** Keeps plates in this browser and in their files: app/keeping.ts. */
export interface KeepingServices {
  newPlate(): void;
  /** Returns the plates that are kept here. @throws Error if none is kept: in frames whose page does not ask for it */
  plates(): Autosave;
  /** Marks that a sliced print is re-brushed over the plate; undefined: none is any more. */
  keepPrint(print: KeptPrint | undefined): void;
  /** Shows a kept plate. @param take  also if another tab has it, which then goes on with a copy */
  openPlate(id: string, take: boolean): Promise<void>;
  /** Remembers the project file that the shown plate came from. */
  openedFrom(project: File): void;
  /** Writes the project over the file that it was opened from.
   * @returns a sentence for the visitor; empty if there is no such file */
  savedInPlace(project: Blob): Promise<string>;
  link(plate: Plate): Promise<{ url: string; told: string }>;
}

/** Draws one picture for each choice of a panel. @param wanted  returns false once nobody waits for the pictures */
export type Draw<Name extends string> = (plate: Plate, wanted: () => boolean) => Promise<Map<Name, Blob>>;

/** Draws the plate with each fill and with each shape, for their choices: app/own-pictures.ts. */
export interface DrawingServices {
  fillPictures: Draw<Fill>;
  shapePictures: Draw<Plate['shape']['kind']>;
}

export interface Services extends MakingServices, PlacingServices, OpeningServices, KeepingServices, DrawingServices {}
