// A plate as the core has it: for the engine, and for a project.
import type { LayerInput, Picture, PlateInput, ToolpathParams } from 'sillon';
import { slopesOf } from './filaments.js';
import { samePictures } from './lamp.js';
import { completeLayers, layerInput, sameLayers, showsPictures } from './layers.js';
import { isDrawn, pageOf, type Plate, type PlateLayer, type SourceFile } from './plate.js';
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

/** The lowest layer: what the directions and modes of a plate say.
 * @param drawn  what stands for the studio's pictures of directions and modes; undefined: it drew none */
function lowestLayer<Content>(
  { directions, modes }: Plate,
  content: ContentOf<Content>,
  drawn?: { directions: Content; modes: Content },
) {
  const { mode, file } = modes;
  const held = { mode, ...(file !== undefined && { modeFile: content(file) }) };
  if (drawn !== undefined) return { kind: 'map' as const, file: drawn.directions, mode, modeFile: drawn.modes };
  if (directions.kind === 'lamp') {
    const pictures = directions.pictures.map((one) => ({ file: content(one.file), lamp: one.lamp }));
    return { kind: 'picture' as const, pictures, ...held };
  }
  if (directions.kind === 'map') {
    return { kind: 'map' as const, file: content(directions.file), encoding: directions.encoding, ...held };
  }
  return { kind: 'direction' as const, angle: directions.kind === 'angle' ? directions.angle : 0, ...held };
}

/** The sections of a plate's project. @param drawn  as of lowestLayer @param layer  how a layer is told */
export function sectionsOf<Content>(
  plate: Plate,
  content: ContentOf<Content>,
  drawn?: { directions: Content; modes: Content },
  layer: (layer: PlateLayer, content: ContentOf<Content>) => object = layerInput,
) {
  const { pictures, toolpath, print, printer } = plate;
  const above = completeLayers(plate).map((one) => layer(one, content));
  return {
    shape: shapeInput(plate, content),
    layers: [lowestLayer(plate, content, drawn), ...above],
    pictures,
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

/** Pictures of a raster's directions and modes. @param step  every so many texels are given */
export function rasterPictures(raster: DirectionRaster, step = 1) {
  const angles = thinned(raster.angle, raster, step);
  const modes = thinned(raster.mode, raster, step);
  return {
    directions: { ...angles, channels: 1 as const },
    modes: { ...modes, channels: 1 as const, samples: modes.samples.map((mode) => mode * greyPerMode) },
  };
}

/** A raster as a lowest layer. */
export const rasterLayer = (raster: DirectionRaster, step = 1): LayerInput => {
  const { directions, modes } = rasterPictures(raster, step);
  return { kind: 'map', file: directions, modeFile: modes };
};

/** @param preview  while a hand moves: by how much the spacing grows; pictures are solved for once */
export function engineInput(
  { plate, raster }: Input,
  preview?: { factor: number },
): { input: PlateInput; params: ToolpathParams } {
  const { spacing, bridge } = plate.toolpath;
  const factor = preview?.factor ?? 1;
  // A preview must not join parts that the plate keeps apart.
  const params = { ...plate.toolpath, spacing: spacing * factor, bridge: factor > 1 ? (bridge ?? spacing) : bridge };
  const { shape, pictures, layers } = sectionsOf(plate, ({ bytes }) => bytes as Blob | Picture);
  // Slopes of the spool ask the engine for no printer, whose other settings need not fit yet.
  const lit = plate.directions.kind === 'lamp' || showsPictures(plate);
  const solved = lit && { pictures: { ...pictures, slopes: slopesOf(plate), ...(preview && { corrections: 0 }) } };
  const coarse = factor > 1 && plate.directions.kind === 'map';
  const drawn = plate.directions.kind !== 'lamp' && raster !== undefined && (isDrawn(plate) || coarse);
  // Two texels per bead are enough for a preview, and reading large pictures would take most of its time.
  const enough = (2 * pageOf(plate)[0]) / params.spacing;
  const step = drawn && factor > 1 ? Math.max(1, Math.floor(raster.width / enough)) : 1;
  const [lowest, ...above] = layers as LayerInput[];
  const told = drawn ? rasterLayer(raster, step) : (lowest as LayerInput);
  return { input: { shape, layers: [told, ...above], ...solved }, params };
}
