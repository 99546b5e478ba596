// Plates for the visitor's own words and pictures: projects from examples/, which the command line can make as well.
import keychain from '../../../examples/keychain.json' with { type: 'json' };
import logoCoaster from '../../../examples/logo-coaster.json' with { type: 'json' };
import nameSign from '../../../examples/name-sign.json' with { type: 'json' };
import photoRing from '../../../examples/photo-ring.json' with { type: 'json' };
import qrFrame from '../../../examples/qr-frame.json' with { type: 'json' };
import { newShape } from '../model/defaults.js';
import type { Example, ExampleId, ExampleLayer } from '../model/example.js';
import { shapeTable } from '../model/setting-table.js';
import type { ShapeSource } from '../model/plate.js';

/** The parts of these project files that are used here. */
interface Template {
  shape: { builtin: string; size: number[]; radius?: number };
  layers: readonly object[];
  toolpath: { spacing: number; mapFilter?: string };
}

/** Name of a file without its folder, under which it is served beside the page. */
const bare = (path: string): string => path.replace(/^.*\//, '');

const layerOf = ({ file, pictures, maskFile, modeFile, ...values }: ExampleLayer): ExampleLayer => ({
  ...values,
  ...(file !== undefined && { file: bare(file) }),
  ...(pictures !== undefined && { pictures: pictures.map((one) => ({ ...one, file: bare(one.file) })) }),
  ...(maskFile !== undefined && { maskFile: bare(maskFile) }),
  ...(modeFile !== undefined && { modeFile: bare(modeFile) }),
});

/** A project of examples/ as an example of the gallery. */
function exampleOf(id: ExampleId, { shape, layers, toolpath }: Template): Example {
  const [width = 0, height = 0] = shape.size;
  const kind = shape.builtin as Exclude<ShapeSource['kind'], 'file'>;
  return {
    id,
    width,
    height: height || width,
    filament: 'bluePla',
    shape: { ...newShape(kind), radius: shape.radius ?? shapeTable.radius.default },
    layers: (layers as readonly ExampleLayer[]).map(layerOf),
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
