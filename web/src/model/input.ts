// A plate as the core has it: for the engine, and for a project.
import type { LayerInput, Picture, PlateInput, ToolpathParams } from 'sillon';
import { slopesOf } from './filaments.js';
import { completeLayers, layerInput, pictureLayers } from './layers.js';
import { type Plate, type PlateLayer, type SourceFile } from './plate.js';
import { without } from './without.js';

/** The stand-in for a file: its bytes for the engine, its path in a project. */
type ContentOf<Content> = (file: SourceFile) => Content;

export function shapeInput<Content>({ shape, width, height }: Plate, content: ContentOf<Content>) {
  if (shape.kind === 'file') return { ...without(shape, 'kind'), file: content(shape.file), pageWidth: width };
  return { ...without(shape, 'kind'), builtin: shape.kind, size: [width, height] satisfies [number, number] };
}

/** The sections of a plate's project. @param layer  how a layer is told */
export function sectionsOf<Content>(
  plate: Plate,
  content: ContentOf<Content>,
  layer: (layer: PlateLayer, content: ContentOf<Content>) => object = layerInput,
) {
  const { pictures, toolpath, print, printer } = plate;
  const layers = completeLayers(plate).map((one) => layer(one, content));
  return { shape: shapeInput(plate, content), layers, pictures, toolpath, print, printer };
}

/** @param preview  while a hand moves: by how much the spacing grows; pictures are solved for once */
export function engineInput(plate: Plate, preview?: { factor: number }): { input: PlateInput; params: ToolpathParams } {
  const { spacing, bridge } = plate.toolpath;
  const factor = preview?.factor ?? 1;
  // A preview must not join parts that the plate keeps apart.
  const params = { ...plate.toolpath, spacing: spacing * factor, bridge: factor > 1 ? (bridge ?? spacing) : bridge };
  const { shape, pictures, layers } = sectionsOf(plate, ({ bytes }) => bytes as Blob | Picture);
  // Slopes of the spool ask the engine for no printer, whose other settings need not fit yet.
  const lit = pictureLayers(plate).length > 0;
  const solved = lit && { pictures: { ...pictures, slopes: slopesOf(plate), ...(preview && { corrections: 0 }) } };
  return { input: { shape, layers: layers as LayerInput[], ...solved }, params };
}
