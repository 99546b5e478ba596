// Translates a plate into the core's form, for the engine and for projects.
import type { LayerInput, Picture, PlateInput, ToolpathParams } from 'sillon';
import { slopesOf } from './filaments.js';
import { completeLayers, layerInput, pictureLayers } from './layers.js';
import { type Plate, type PlateLayer, type SourceFile } from './plate.js';
import { without } from './without.js';

/** Replaces a file by what stands for it: its bytes for the engine, its path in a project. */
type ContentOf<Content> = (file: SourceFile) => Content;

/** The plate's shape in the core's form. */
export function shapeInput<Content>({ shape, width, height }: Plate, content: ContentOf<Content>) {
  if (shape.kind === 'file') return { ...without(shape, 'kind'), file: content(shape.file), pageWidth: width };
  return { ...without(shape, 'kind'), builtin: shape.kind, size: [width, height] satisfies [number, number] };
}

/** The core's sections of a plate's project. @param layer  translates one layer */
export function sectionsOf<Content>(
  plate: Plate,
  content: ContentOf<Content>,
  layer: (layer: PlateLayer, content: ContentOf<Content>) => object = layerInput,
) {
  const { pictures, toolpath, print, printer } = plate;
  const layers = completeLayers(plate).map((one) => layer(one, content));
  return { shape: shapeInput(plate, content), layers, pictures, toolpath, print, printer };
}

/** Input and parameters for making the plate's path.
 * @param preview  makes a quick preview while a hand moves: multiplies the spacing by `factor` and solves for
 * pictures once */
export function engineInput(plate: Plate, preview?: { factor: number }): { input: PlateInput; params: ToolpathParams } {
  const { spacing, bridge } = plate.toolpath;
  const factor = preview?.factor ?? 1;
  // A preview must not join parts that the plate keeps apart.
  const params = { ...plate.toolpath, spacing: spacing * factor, bridge: factor > 1 ? (bridge ?? spacing) : bridge };
  const { shape, pictures, layers } = sectionsOf(plate, ({ bytes }) => bytes as Blob | Picture);
  // The slopes are given instead of the printer, whose other settings may still be invalid.
  const lit = pictureLayers(plate).length > 0;
  const solved = lit && { pictures: { ...pictures, slopes: slopesOf(plate), ...(preview && { corrections: 0 }) } };
  return { input: { shape, layers: layers as LayerInput[], ...solved }, params };
}
