// A plate as the engine takes it.
import type { PlateInput, ShapeInput, ToolpathParams } from 'sillon';
import type { DirectionRaster } from './raster.js';
import { pictureInput, sameSpool } from './lamp.js';
import type { Plate } from './plate.js';

export interface Input {
  plate: Plate;
  /** undefined: not drawn yet; a plate of one direction needs none. */
  raster: DirectionRaster | undefined;
}

/** Whether both make the same toolpath: printer, print, name and, without pictures under lamps, filament do not matter. */
export function sameToolpath(a: Input, b: Input): boolean {
  const { plate: p, raster } = a;
  const { plate: q } = b;
  if (raster !== b.raster || p.toolpath !== q.toolpath) return false;
  if (p.shape !== q.shape || p.width !== q.width || p.height !== q.height || !sameSpool(p, q)) return false;
  const lit = p.directions.kind === 'lamp' || q.directions.kind === 'lamp'; // the raster does not know them
  return (raster !== undefined && !lit) || (p.directions === q.directions && p.modes === q.modes);
}

/** Millimetres without a unit are the published scenes', which outline what they mean. */
export const paintOf = ({
  paint,
  unitless,
}: {
  paint?: 'shown' | 'ignore' | undefined;
  unitless: 'px' | 'mm';
}): 'shown' | 'ignore' => paint ?? (unitless === 'mm' ? 'ignore' : 'shown');

export function shapeInput({ shape, width, height }: Plate): ShapeInput {
  switch (shape.kind) {
    case 'file':
      return {
        file: shape.file.bytes,
        pageWidth: width,
        unitless: shape.unitless,
        ...(paintOf(shape) === 'ignore' && { paint: 'ignore' as const }),
        ...(shape.keepThin === true && { keepThin: true }),
      };
    case 'rounded':
      return { builtin: 'rounded', size: [width, height], radius: shape.radius };
    case 'rectangle':
    case 'disc':
      return { builtin: shape.kind, size: [width, height] };
  }
}

const greyPerMode = 85;

/** Every `step`th texel of every `step`th row. */
function thinned<Samples extends Uint8Array | Uint16Array>(
  samples: Samples,
  { width, height }: DirectionRaster,
  step: number,
): { width: number; height: number; samples: Samples } {
  if (step === 1) return { width, height, samples };
  const columns = Math.ceil(width / step);
  const rows = Math.ceil(height / step);
  const kept = samples.slice(0, columns * rows) as Samples;
  for (let y = 0; y < rows; ++y) {
    for (let x = 0; x < columns; ++x) kept[y * columns + x] = samples[y * step * width + x * step] ?? 0;
  }
  return { width: columns, height: rows, samples: kept };
}

/** @param step  every so many texels are given */
export function rasterInput(raster: DirectionRaster, step = 1): Required<Pick<PlateInput, 'directions' | 'modes'>> {
  const angles = thinned(raster.angle, raster, step);
  const modes = thinned(raster.mode, raster, step);
  return {
    directions: { file: { ...angles, channels: 1 }, encoding: 'angle' },
    modes: { file: { ...modes, channels: 1, samples: modes.samples.map((mode) => mode * greyPerMode) } },
  };
}

/** @param factor  by how much the spacing grows; above 1 for previews. */
export function engineInput({ plate, raster }: Input, factor = 1): { input: PlateInput; params: ToolpathParams } {
  const { spacing, bridge } = plate.toolpath;
  // A preview must not join parts that the plate keeps apart.
  const params = { ...plate.toolpath, spacing: spacing * factor, bridge: factor > 1 ? (bridge ?? spacing) : bridge };
  const shape = shapeInput(plate);
  const { directions } = plate;
  if (directions.kind === 'lamp') {
    const { file } = plate.modes;
    const modes = file === undefined ? { mode: plate.modes.base } : { file: file.bytes };
    return { input: { shape, pictures: pictureInput(plate, directions, ({ bytes }) => bytes), modes }, params };
  }
  if (raster === undefined) {
    const angle = directions.kind === 'angle' ? directions.angle : 0;
    return { input: { shape, directions: { angle }, modes: { mode: plate.modes.base } }, params };
  }
  // Two texels per bead are enough for a preview, and reading large pictures would take most of its time.
  const enough = (2 * plate.width) / params.spacing;
  const step = factor > 1 ? Math.max(1, Math.floor(raster.width / enough)) : 1;
  return { input: { shape, ...rasterInput(raster, step) }, params };
}
