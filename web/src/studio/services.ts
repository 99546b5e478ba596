// Services that the elements ask of parts above them, by feature, with the file that does it. Each may reject.
import type { Engine, Gcode, PlacedLayer } from 'sillon';
import type { Autosave, KeptPrint } from '../files/autosave.js';
import type { Example } from '../model/example.js';
import type { Role } from '../model/file-role.js';
import type { Fill } from '../model/fills.js';
import type { FreePlace, Taken, Wanted } from '../model/free-place.js';
import type { Plate } from '../model/plate.js';
import type { DirectionRaster } from '../model/raster.js';

/** Computes what follows from the plate as it is now: app/making.ts. */
export interface MakingServices {
  /** For what the plate has no part in. */
  engine(): Promise<Engine>;
  cancel(): void;
  retry(): void;
  gcode(): Promise<Gcode>;
  /** The base layers as a solid, 3MF. */
  body(): Promise<Blob>;
  zones(): Promise<Blob>;
  svg(): Promise<Blob>;
  view(): Promise<Blob>;
  directions(plate: Plate): Promise<DirectionRaster>;
}

/** Finds out where layers lie: app/making.ts. */
export interface PlacingServices {
  /** The box in which the engine puts each layer that lacks nothing, by its id. */
  layerBoxes(plate: Plate): Promise<ReadonlyMap<number, PlacedLayer>>;
  /** Finds a free place on the plate for a new box. */
  freePlace(plate: Plate, taken: readonly Taken[], wanted: Wanted): Promise<FreePlace>;
}

/** Makes plates of files: app/opening.ts. */
export interface OpeningServices {
  /** Opens files as they are guessed; they can be changed in the dialog 'files'. @throws StudioError, SillonError */
  open(files: readonly File[], role?: Role): Promise<void>;
  /** Uses one of the files that were opened last as something else. */
  setRole(index: number, role: Role): Promise<void>;
  openExample(example: Example): Promise<void>;
  /** Shows another plate, on the visitor's own printer. */
  openMade(make: (plate: Plate) => Plate): void;
}

/** Keeps plates here and in their files: app/keeping.ts. */
export interface KeepingServices {
  newPlate(): void;
  /** Those that are kept here. @throws where none is kept: in frames whose page does not ask for it */
  plates(): Autosave;
  /** A sliced print is re-brushed over the plate; undefined: none is any more. */
  keepPrint(print: KeptPrint | undefined): void;
  /** Shows one of them. @param take  also from another tab, which goes on with a copy */
  openPlate(id: string, take: boolean): Promise<void>;
  /** The plate that is shown now is that of a project file. */
  openedFrom(project: File): void;
  /** Writes the project over the file that it was opened from. @returns what is said of it; empty where there is none */
  savedInPlace(project: Blob): Promise<string>;
  link(plate: Plate): Promise<{ url: string; told: string }>;
}

/** Draws one picture for each choice of a panel; @param wanted  false once nobody waits for them. */
export type Draw<Name extends string> = (plate: Plate, wanted: () => boolean) => Promise<Map<Name, Blob>>;

/** Draws what each fill, and each shape, makes of the plate: app/own-pictures.ts. */
export interface DrawingServices {
  fillPictures: Draw<Fill>;
  shapePictures: Draw<Plate['shape']['kind']>;
}

export interface Services extends MakingServices, PlacingServices, OpeningServices, KeepingServices, DrawingServices {}
