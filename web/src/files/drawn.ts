// A drawing as a picture: the browser draws it, as nothing else reads all of SVG. Scripts in it do not run, and nothing is fetched.
import type { Engine, Picture } from 'sillon';
import { directionsFor, flatColours } from '../model/flat-colours.js';
import { newColours } from '../model/defaults.js';
import type { DirectionSource, FlatColour, SourceFile } from '../model/plate.js';
import { fineResolution } from '../model/raster.js';

const svgType = 'image/svg+xml';

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

/** @param longest  side [pixels] @throws Error where the browser cannot draw it */
export async function drawSvg(file: Blob, longest: number = fineResolution): Promise<Picture> {
  const { svg, width, height } = sized(await file.text(), longest);
  const url = URL.createObjectURL(svg);
  try {
    const image = new Image(width, height);
    image.src = url;
    await image.decode();
    const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    if (context === null) throw new Error('this browser has no canvas to draw on');
    context.drawImage(image, 0, 0, width, height);
    return { width, height, channels: 4, samples: context.getImageData(0, 0, width, height).data };
  } finally {
    URL.revokeObjectURL(url);
  }
}

export const isSvg = ({ bytes }: SourceFile): boolean => bytes.type === svgType;

/** Any file of directions as a picture. */
export const pictureOfFile = (file: SourceFile, engine: Pick<Engine, 'decodePicture'>): Promise<Picture> =>
  isSvg(file) ? drawSvg(file.bytes) : engine.decodePicture(file.bytes);

/** To be laid over the plate. @throws where the browser does not draw it */
export async function bitmapOf(file: Blob): Promise<ImageBitmap> {
  if (file.type !== svgType) return createImageBitmap(file);
  const { width, height, samples } = await drawSvg(file);
  return createImageBitmap(new ImageData(new Uint8ClampedArray(samples), width, height));
}

const known = new WeakMap<Blob, string[]>();

/** The flat colours of a drawing or a picture, from dark to light; none where it cannot be drawn. */
export async function coloursIn(file: SourceFile, engine: Pick<Engine, 'decodePicture'>): Promise<string[]> {
  const before = known.get(file.bytes);
  if (before !== undefined) return before;
  const found = await pictureOfFile(file, engine).then(flatColours, () => []);
  known.set(file.bytes, found);
  return found;
}

/** A direction for each of them. @param before  as of `directionsFor` */
export const coloursOf = async (
  file: SourceFile,
  engine: Pick<Engine, 'decodePicture'>,
  before?: readonly FlatColour[],
): Promise<DirectionSource> => newColours(file, directionsFor(await coloursIn(file, engine), before));
