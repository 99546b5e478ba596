// An example plate, as data.
import type { FilamentKey } from './filaments.js';
import type { LayerKind, LayerValues } from './layers.js';
import type { ShapeSource } from './plate.js';

/** A layer's fields that differ from the core's defaults. Files are given by their names. */
export type ExampleLayer = Partial<Omit<LayerValues, 'file' | 'pictures' | 'maskFile' | 'modeFile' | 'font'>> & {
  kind: LayerKind;
  file?: string;
  pictures?: readonly { file: string; lamp?: readonly [number, number] | null }[];
  maskFile?: string;
  modeFile?: string;
  font?: string;
};

export interface Example {
  /** Key of the example's name in the dictionary: `example.ID`. */
  id: ExampleId;
  width: number;
  height: number;
  filament: FilamentKey;
  /** A built-in shape, or the name of a drawing's file. */
  shape: ShapeSource | string;
  /** Layers from the bottom to the top. */
  layers: readonly ExampleLayer[];
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
