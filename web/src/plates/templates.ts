// Plates to put one's own words and pictures into: projects of examples/, as the command line makes them.
import keychain from '../../../examples/keychain.json';
import logoCoaster from '../../../examples/logo-coaster.json';
import nameSign from '../../../examples/name-sign.json';
import photoRing from '../../../examples/photo-ring.json';
import qrFrame from '../../../examples/qr-frame.json';
import { newGenerator, newShape } from '../model/defaults.js';
import type { Example, ExampleId, ExampleLayer } from '../model/example.js';
import { shapeTable } from '../model/setting-table.js';
import type { ShapeSource } from '../model/plate.js';

/** The parts of a project that these files have. */
interface Template {
  shape: { builtin: string; size: number[]; radius?: number };
  directions?: { angle: number };
  layers: readonly { kind: string; file?: string }[];
  toolpath: { spacing: number; mapFilter?: string };
}

/** Files lie beside the page by their bare names. */
const named = (layer: { file?: string }): ExampleLayer =>
  ({ ...layer, ...(layer.file !== undefined && { file: layer.file.replace(/^.*\//, '') }) }) as ExampleLayer;

function exampleOf(id: ExampleId, { shape, directions, layers, toolpath }: Template): Example {
  const [width = 0, height = 0] = shape.size;
  const kind = shape.builtin as Exclude<ShapeSource['kind'], 'file'>;
  return {
    id,
    width,
    height: height || width,
    filament: 'bluePla',
    shape: { ...newShape(kind), radius: shape.radius ?? shapeTable.radius.default },
    directions: { ...newGenerator('angle'), angle: directions?.angle ?? 0 },
    layers: layers.map(named),
    nearest: toolpath.mapFilter === 'nearest',
  };
}

export const templates: readonly Example[] = [
  exampleOf('nameSign', nameSign),
  exampleOf('photoRing', photoRing),
  exampleOf('logoCoaster', logoCoaster),
  exampleOf('keychain', keychain),
  exampleOf('qrFrame', qrFrame),
];
