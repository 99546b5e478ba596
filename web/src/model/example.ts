// A plate to begin with, as data.
import type { DirectionEncoding, DirectionMode } from 'sillon';
import type { FilamentKey } from './filaments.js';
import type { LayerKind, LayerValues } from './layers.js';
import type { DirectionSource, ShapeSource } from './plate.js';

/** The fields that differ from the core's defaults; files by their names. */
export type ExampleLayer = Partial<Omit<LayerValues, 'file' | 'others' | 'maskFile' | 'modeFile' | 'font'>> & {
  kind: LayerKind;
  file?: string | null;
  others?: readonly { file: string; lamp: readonly [number, number] | null }[];
  maskFile?: string | null;
  modeFile?: string | null;
  font?: string;
};

export interface Example {
  /** The dictionary has `example.ID`. */
  id: ExampleId;
  width: number;
  height: number;
  filament: FilamentKey;
  /** A name is that of a file. */
  shape: ShapeSource | string;
  directions:
    | DirectionSource
    | { file: string; encoding: DirectionEncoding }
    | { pictures: readonly { file: string; lamp: readonly [number, number] }[] };
  modes?: { mode?: DirectionMode; file?: string };
  /** The last on top. */
  layers?: readonly ExampleLayer[];
  nearest?: boolean;
}

export type ExampleId =
  | 'sunMoon'
  | 'ripples'
  | 'rays'
  | 'rings'
  | 'whirl'
  | 'silk'
  | 'grain'
  | 'nameSign'
  | 'photoRing'
  | 'logoCoaster'
  | 'keychain'
  | 'qrFrame'
  | 'portrait'
  | 'relief'
  | 'mosaic'
  | 'tiles'
  | 'crest'
  | 'brushwork';
