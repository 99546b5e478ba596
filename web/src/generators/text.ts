import type { Picture } from 'sillon';
import { storeDegrees } from './angle.js';
import { parted, tonesAt } from './grey.js';
import { placeIn, type Place, type Room } from './room.js';
import type { SourceOf } from './source.js';
import { sizeFor, type Page, type Size } from './texels.js';

const lineHeight = 1.2;
const mostOfPage = 0.94; // larger letters are made smaller rather than cut off

/** How much smaller letters must be to stay whole. @param wide, tall  of their box, shares of the page's
 * @param round  they must fit into the ellipse of the page */
export const fitOf = (wide: number, tall: number, round: boolean): number =>
  Math.min(1, round ? mostOfPage / Math.max(1e-6, Math.hypot(wide, tall)) : mostOfPage / Math.max(wide, tall, 1e-6));

function contextOf({ width, height }: Size): OffscreenCanvasRenderingContext2D {
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  if (context === null) throw new Error('this browser has no canvas to draw letters on');
  return context;
}

const linesOf = ({ text }: SourceOf<'text'>): string[] => text.split('\n');

function fontOf({ font, bold }: SourceOf<'text'>, pixels: number): string {
  const family = font.replace(/[^\p{L}\p{N} ,-]/gu, '');
  return `${bold ? 'bold ' : ''}${pixels}px ${family || 'sans-serif'}`;
}

/** Of all lines together. @param context  of a picture of this size */
function placeOf(
  source: SourceOf<'text'>,
  { width, height }: Size,
  context: OffscreenCanvasRenderingContext2D,
  round: boolean,
  room?: Room,
): Place {
  const lines = linesOf(source);
  const wanted = source.size * width;
  context.font = fontOf(source, wanted);
  const widest = Math.max(...lines.map((line) => context.measureText(line).width));
  const [wide, tall] = [widest / width, (wanted * lineHeight * lines.length) / height];
  return room === undefined ? { scale: fitOf(wide, tall, round), x: 0.5, y: 0.5 } : placeIn(wide, tall, room);
}

/** Height of the letters, a share of the page's width: long lines have smaller ones than wanted. Needs a canvas, as `drawText`. */
export function letterShare(source: SourceOf<'text'>, page: Page, round = false, room?: Room): number {
  const size = sizeFor(page, 512);
  return source.size * placeOf(source, size, contextOf(size), round, room).scale;
}

/** The letters, white on black, in the middle of the page, or where they fit into `room`. */
export function drawText(source: SourceOf<'text'>, size: Size, round = false, room?: Room): Picture {
  const { width, height } = size;
  const context = contextOf(size);
  const { scale, x, y } = placeOf(source, size, context, round, room);
  const lines = linesOf(source);
  const wanted = source.size * width;
  context.fillStyle = 'black';
  context.fillRect(0, 0, width, height);
  context.fillStyle = 'white';
  context.font = fontOf(source, wanted * scale);
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  lines.forEach((line, k) => {
    const below = (k - (lines.length - 1) / 2) * lineHeight * wanted * scale;
    context.fillText(line, x * width, y * height + below);
  });
  return { width, height, channels: 4, samples: context.getImageData(0, 0, width, height).data };
}

/** @param letters  white where letters are. */
export function textAngles(source: SourceOf<'text'>, size: Size, letters: Picture): Uint16Array {
  const inside = storeDegrees(source.letters);
  const outside = storeDegrees(source.ground);
  return parted(tonesAt(letters, size), 0.5, outside, inside);
}
