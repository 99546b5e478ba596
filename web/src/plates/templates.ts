// Plates to put one's own words and pictures into: projects of examples/, as the command line makes them.
import keychain from '../../../examples/keychain.json' with { type: 'json' };
import logoCoaster from '../../../examples/logo-coaster.json' with { type: 'json' };
import nameSign from '../../../examples/name-sign.json' with { type: 'json' };
import photoRing from '../../../examples/photo-ring.json' with { type: 'json' };
import qrFrame from '../../../examples/qr-frame.json' with { type: 'json' };
import { newGenerator, newShape } from '../model/defaults.js';
import type { Example, ExampleId, ExampleLayer } from '../model/example.js';
import { groundOf, studioLayer, type ProjectLayer } from '../model/ground.js';
import { shapeTable } from '../model/setting-table.js';
import type { ShapeSource } from '../model/plate.js';

/** The parts of a project that these files have. */
interface Template {
  shape: { builtin: string; size: number[]; radius?: number };
  layers: readonly object[];
  toolpath: { spacing: number; mapFilter?: string };
}

/** Files lie beside the page by their bare names. */
const bare = (path: string): string => path.replace(/^.*\//, '');

function layerOf(layer: ProjectLayer): ExampleLayer {
  const { file, others, maskFile, modeFile, ...values } = studioLayer(layer);
  return {
    ...values,
    file: file && bare(file),
    others: others.map((one) => ({ ...one, file: bare(one.file) })),
    maskFile: maskFile && bare(maskFile),
    modeFile: modeFile && bare(modeFile),
  };
}

/** Its lowest layer is one direction, or lies over one of 0°. */
function exampleOf(id: ExampleId, { shape, layers: all, toolpath }: Template): Example {
  const layers = all as readonly ProjectLayer[];
  const ground = groundOf(layers);
  const [width = 0, height = 0] = shape.size;
  const kind = shape.builtin as Exclude<ShapeSource['kind'], 'file'>;
  return {
    id,
    width,
    height: height || width,
    filament: 'bluePla',
    shape: { ...newShape(kind), radius: shape.radius ?? shapeTable.radius.default },
    directions: { ...newGenerator('angle'), angle: ground?.angle ?? 0 },
    layers: layers.slice(ground === undefined ? 0 : 1).map(layerOf),
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
