// A plate to begin with, as data.
import type { FilamentKey } from './filaments.js';
import type { LayerKind, LayerValues } from './layers.js';
import type { ShapeSource } from './plate.js';

/** The fields that differ from the core's defaults; files by their names. */
export type ExampleLayer = Partial<Omit<LayerValues, 'file' | 'pictures' | 'maskFile' | 'modeFile' | 'font'>> & {
  kind: LayerKind;
  file?: string;
  pictures?: readonly { file: string; lamp?: readonly [number, number] | null }[];
  maskFile?: string;
  modeFile?: string;
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
  /** Bottom first. */
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
