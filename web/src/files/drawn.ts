// A drawing as a picture: the browser draws it, but only what the engine has read, and only what is cheap of that.
import type { Engine, Picture, Shape } from 'sillon';
import { directionsFor, flatColours } from '../model/flat-colours.js';
import { newColours } from '../model/defaults.js';
import type { DirectionSource, FlatColour, SourceFile } from '../model/plate.js';
import { isOfFile, StudioError } from '../model/problem.js';
import { fineResolution } from '../model/raster.js';
import { plainDrawing, UnfitDrawing, type PlainDrawing } from './plain-drawing.js';

const svgType = 'image/svg+xml';

/** What reading drawings and pictures takes. */
export type DrawingEngine = Pick<Engine, 'decodePicture' | 'readShape'>;

/** What a pixel may cost in full resolution; where it costs more there are fewer. */
const finePixel = 4000;
/** Heights of the page that all outlines together may go up and down: each row of pixels meets as many. */
const mostCrossings = 50_000;

/** User units per unit of length, as CSS has them. */
const unitSizes: Readonly<Record<string, number>> = {
  '': 1,
  px: 1,
  mm: 96 / 25.4,
  cm: 96 / 2.54,
  q: 96 / 101.6,
  in: 96,
  pt: 96 / 72,
  pc: 16,
};

/** [user units]; undefined for shares and nonsense. */
function lengthOf(text: string | undefined): number | undefined {
  const [, digits, unit = ''] = /^\s*([\d.eE+-]+)\s*([a-zA-Z]*)\s*$/.exec(text ?? '') ?? [];
  const size = unitSizes[unit.toLowerCase()];
  const length = Number(digits) * (size ?? Number.NaN);
  return length > 0 && Number.isFinite(length) ? length : undefined;
}

/** The root's tag: its name, its attributes, its end. Not parsed as a document: that would be one of this page, whose policy
 * forbids the style sheets that drawings bring along. */
const rootTag = /<((?:[\w-]+:)?svg)((?:\s+[^\s=>/]+\s*=\s*(?:"[^"]*"|'[^']*'))*)\s*(\/?>)/;

const attributeIn = (attributes: string, name: string): string | undefined => {
  const found = new RegExp(`\\s${name}\\s*=\\s*(?:"([^"]*)"|'([^']*)')`).exec(attributes);
  return found === null ? undefined : (found[1] ?? found[2]);
};

/** With its size said in pixels, which browsers ask for, and without soft edges. @throws Error */
function sized(text: string, longest: number): { svg: Blob; width: number; height: number } {
  const [tag, name = '', attributes = '', end = ''] = rootTag.exec(text) ?? [];
  if (tag === undefined) throw new Error('this is not a drawing');
  const box = (attributeIn(attributes, 'viewBox') ?? '')
    .trim()
    .split(/[\s,]+/)
    .map(Number);
  const [, , boxWidth = 0, boxHeight = 0] = box;
  const boxed = box.length === 4 && boxWidth > 0 && boxHeight > 0;
  const wide = lengthOf(attributeIn(attributes, 'width'));
  const tall = lengthOf(attributeIn(attributes, 'height'));
  const ratio = boxed ? boxWidth / boxHeight : undefined;
  const width = wide ?? (tall !== undefined && ratio !== undefined ? tall * ratio : boxed ? boxWidth : 300);
  const height = tall ?? (ratio !== undefined ? width / ratio : 150);
  const scale = longest / Math.max(width, height);
  const size = { width: Math.max(1, Math.round(width * scale)), height: Math.max(1, Math.round(height * scale)) };
  const kept = attributes.replace(/\s(?:width|height|shape-rendering)\s*=\s*(?:"[^"]*"|'[^']*')/g, '');
  const view = boxed ? '' : ` viewBox="0 0 ${width} ${height}"`;
  const root = `<${name}${kept}${view} width="${size.width}" height="${size.height}" shape-rendering="crispEdges"${end}`;
  return { svg: new Blob([text.replace(tag, () => root)], { type: svgType }), ...size };
}

/** How often a row of pixels meets outlines, on average. */
function crossingsOf({ page, paths }: Shape): number {
  let climbed = 0;
  for (const ring of paths.flatMap(({ rings }) => rings)) {
    for (let k = 1, last = ring.length - 1; k < ring.length; last = k, k += 2) {
      climbed += Math.abs((ring[k] as number) - (ring[last] as number));
    }
  }
  return climbed / page[1];
}

const checked = new WeakMap<Blob, Promise<PlainDrawing>>();

/** Nothing stops the browser once it draws: what it gets must be known to end.
 * @throws what the engine refuses; StudioError DrawingTooMuch */
async function check(file: Blob, engine: DrawingEngine): Promise<PlainDrawing> {
  const shape = await engine.readShape({ file, unitless: 'px' });
  try {
    if (crossingsOf(shape) > mostCrossings) {
      throw new UnfitDrawing(`a line across the drawing meets more than ${mostCrossings} outlines; draw it with fewer`);
    }
    return plainDrawing(await file.text());
  } catch (error) {
    throw error instanceof UnfitDrawing ? new StudioError('DrawingTooMuch', {}, error.message) : error;
  }
}

/** @param longest  side [pixels]; of many elements it is less
 * @throws what the engine refuses; StudioError DrawingTooMuch; Error where the browser cannot draw it */
async function drawSvg(file: Blob, engine: DrawingEngine, longest: number = fineResolution): Promise<OffscreenCanvas> {
  const plain = checked.get(file) ?? check(file, engine);
  checked.set(file, plain);
  const { text, pixel } = await plain.catch((error: unknown) => {
    if (!isOfFile(error)) checked.delete(file); // another time it may be read
    throw error;
  });
  const side = longest * Math.min(1, Math.sqrt(finePixel / pixel));
  const { svg, width, height } = sized(text, side);
  const url = URL.createObjectURL(svg);
  try {
    const image = new Image(width, height);
    image.src = url;
    await image.decode();
    const canvas = new OffscreenCanvas(width, height);
    pixelsOf(canvas).drawImage(image, 0, 0, width, height);
    return canvas;
  } finally {
    URL.revokeObjectURL(url);
  }
}

function pixelsOf(canvas: OffscreenCanvas): OffscreenCanvasRenderingContext2D {
  const context = canvas.getContext('2d', { willReadFrequently: true });
  if (context === null) throw new Error('this browser has no canvas to draw on');
  return context;
}

/** @throws as drawing does */
async function svgPicture(file: Blob, engine: DrawingEngine): Promise<Picture> {
  const canvas = await drawSvg(file, engine);
  const { width, height } = canvas;
  return { width, height, channels: 4, samples: pixelsOf(canvas).getImageData(0, 0, width, height).data };
}

export const isSvg = ({ bytes }: SourceFile): boolean => bytes.type === svgType;

/** Any file of directions as a picture. @throws what the engine refuses; StudioError DrawingTooMuch */
export const pictureOfFile = (file: SourceFile, engine: DrawingEngine): Promise<Picture> =>
  isSvg(file) ? svgPicture(file.bytes, engine) : engine.decodePicture(file.bytes);

/** To be laid over the plate. @throws where the browser does not draw it */
export async function bitmapOf(file: Blob, engine: DrawingEngine): Promise<ImageBitmap> {
  return file.type === svgType ? (await drawSvg(file, engine)).transferToImageBitmap() : createImageBitmap(file);
}

/** A drawing as a small picture for an <img>. @throws where the browser does not draw it */
export const smallPng = async (file: Blob, engine: DrawingEngine, side: number): Promise<Blob> =>
  (await drawSvg(file, engine, side)).convertToBlob({ type: 'image/png' });

const known = new WeakMap<Blob, string[]>();

/** The flat colours of a drawing or a picture, from dark to light; none where it cannot be drawn. */
export async function coloursIn(file: SourceFile, engine: DrawingEngine): Promise<string[]> {
  const before = known.get(file.bytes);
  if (before !== undefined) return before;
  const found = await pictureOfFile(file, engine).then(flatColours, () => []);
  known.set(file.bytes, found);
  return found;
}

/** A direction for each of them. @param before  as of `directionsFor` */
export const coloursOf = async (
  file: SourceFile,
  engine: DrawingEngine,
  before?: readonly FlatColour[],
): Promise<DirectionSource> => newColours(file, directionsFor(await coloursIn(file, engine), before));
