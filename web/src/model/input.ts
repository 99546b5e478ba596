// A plate as the core has it: for the engine, and for a project.
import type { PlateInput, ToolpathParams } from 'sillon';
import { slopesOf } from './filaments.js';
import { samePictures } from './lamp.js';
import { completeLayers, layerInput, sameLayers, showsPictures } from './layers.js';
import { isDrawn, pageOf, type Plate, type SourceFile } from './plate.js';
import type { DirectionRaster } from './raster.js';
import { without } from './without.js';

export interface Input {
  plate: Plate;
  /** undefined: not drawn yet; a plate of one direction needs none. */
  raster: DirectionRaster | undefined;
}

/** Whether both make the same toolpath: printer, print, name and, without pictures under lamps, filament do not matter. */
export function sameToolpath(a: Input, b: Input): boolean {
  const { plate: p } = a;
  const { plate: q } = b;
  if (p.shape !== q.shape || p.width !== q.width || p.height !== q.height || p.toolpath !== q.toolpath) return false;
  if (isDrawn(p) !== isDrawn(q) || !samePictures(p, q) || !sameLayers(p, q)) return false;
  return isDrawn(p) && a.raster !== undefined
    ? a.raster === b.raster
    : p.directions === q.directions && p.modes === q.modes;
}

/** The stand-in for a file: its bytes for the engine, its path in a project. */
type ContentOf<Content> = (file: SourceFile) => Content;

export function shapeInput<Content>({ shape, width, height }: Plate, content: ContentOf<Content>) {
  if (shape.kind === 'file') return { ...without(shape, 'kind'), file: content(shape.file), pageWidth: width };
  return { ...without(shape, 'kind'), builtin: shape.kind, size: [width, height] satisfies [number, number] };
}

/** The sections of a plate's project.
 * @param drawn  what stands for the studio's pictures of directions and modes; undefined: it drew none */
export function sectionsOf<Content>(
  plate: Plate,
  content: ContentOf<Content>,
  drawn?: { directions: Content; modes: Content },
) {
  const { directions, modes, pictures, toolpath, print, printer } = plate;
  const lit = directions.kind === 'lamp' ? directions.pictures : [];
  const told =
    directions.kind === 'map'
      ? { file: content(directions.file), encoding: directions.encoding }
      : { angle: directions.kind === 'angle' ? directions.angle : 0 };
  const modeFile = modes.file && content(modes.file);
  const layers = completeLayers(plate).map((layer) => layerInput(layer, content));
  return {
    shape: shapeInput(plate, content),
    directions: drawn === undefined ? told : { file: drawn.directions, encoding: 'angle' as const },
    modes: { mode: modes.mode, ...((drawn?.modes ?? modeFile) !== undefined && { file: drawn?.modes ?? modeFile }) },
    pictures: { ...pictures, files: lit.map(({ file, lamp }) => ({ file: content(file), lamp })) },
    ...(layers.length > 0 && { layers }),
    toolpath,
    print,
    printer,
  };
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
export function rasterInput(raster: DirectionRaster, step = 1) {
  const angles = thinned(raster.angle, raster, step);
  const modes = thinned(raster.mode, raster, step);
  return {
    directions: { file: { ...angles, channels: 1 as const }, encoding: 'angle' as const },
    modes: { file: { ...modes, channels: 1 as const, samples: modes.samples.map((mode) => mode * greyPerMode) } },
  };
}

/** @param preview  while a hand moves: by how much the spacing grows; pictures are solved for once */
export function engineInput(
  { plate, raster }: Input,
  preview?: { factor: number },
): { input: PlateInput; params: ToolpathParams } {
  const { spacing, bridge } = plate.toolpath;
  const factor = preview?.factor ?? 1;
  // A preview must not join parts that the plate keeps apart.
  const params = { ...plate.toolpath, spacing: spacing * factor, bridge: factor > 1 ? (bridge ?? spacing) : bridge };
  const { shape, directions, modes, pictures, layers } = sectionsOf(plate, ({ bytes }) => bytes);
  // Slopes of the spool ask the engine for no printer, whose other settings need not fit yet.
  const solved = { pictures: { ...pictures, slopes: slopesOf(plate), ...(preview && { corrections: 0 }) } };
  const over = { ...(layers !== undefined && { layers }), ...(showsPictures(plate) && solved) };
  if (plate.directions.kind === 'lamp') return { input: { shape, modes, ...over, ...solved }, params };
  const coarse = factor > 1 && plate.directions.kind === 'map';
  if (raster === undefined || !(isDrawn(plate) || coarse)) {
    return { input: { shape, directions, modes, ...over }, params };
  }
  // Two texels per bead are enough for a preview, and reading large pictures would take most of its time.
  const enough = (2 * pageOf(plate)[0]) / params.spacing;
  const step = factor > 1 ? Math.max(1, Math.floor(raster.width / enough)) : 1;
  return { input: { shape, ...rasterInput(raster, step), ...over }, params };
}
