// Draws all that lies above the plate: a veil outside its shape, marks, the brush, and rulers in millimetres.
import type { Shape } from 'sillon';
import { fillShape } from '../views/outline.js';
import { markColours } from '../views/palette.js';
import type { Camera } from '../views/scene.js';
import type { Mark } from '../model/view.js';

export interface Cursor {
  x: number;
  y: number;
}

export interface Overlay {
  camera: Camera;
  /** Device pixels per CSS pixel. */
  pixels: number;
  page: readonly [number, number];
  cursor: Cursor | undefined;
  /** Radius of the brush [mm]. */
  radius: number;
  softness: number;
  marks: readonly Mark[];
  /** Index of the mark in focus. */
  mark: number;
  /** Light that stands in for the plate. */
  shimmer: ((width: number, height: number) => CanvasImageSource) | undefined;
  /** Draws strokes that the beads do not follow yet. @param context  transformed to millimetres of the page */
  strokes: ((context: CanvasRenderingContext2D, styles: CSSStyleDeclaration) => void) | undefined;
  /** Draws above everything else on the plate. @param context  in CSS pixels */
  above: ((context: CanvasRenderingContext2D) => void) | undefined;
  /** Shape outside of which the page is veiled. */
  shape: Shape | undefined;
  /** Picture over the page from the left, up to the share `wipe`. */
  picture: ImageBitmap | OffscreenCanvas | undefined;
  /** The picture is drawn in grey, since the plate cannot show its colours. */
  grey: boolean;
  wipe: number;
  /** Rulers stand at the edges. */
  ruled: boolean;
  styles: CSSStyleDeclaration;
}

export const rulerWidth = 20; // [CSS pixels]
const leastBetweenNumbers = 56;

/** Returns the smallest 1, 2 or 5 times a power of ten that is not below `least`. */
function roundStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5].find((factor) => factor * power >= least) ?? 10);
}

/** Clears the canvas and draws the overlay. */
export function drawOverlay(canvas: HTMLCanvasElement, overlay: Overlay): void {
  const context = canvas.getContext('2d');
  if (context === null) return;
  const { pixels, camera } = overlay;
  const width = canvas.width / pixels;
  const height = canvas.height / pixels;
  const scale = camera.scale / pixels;
  const toX = (x: number): number => (x - camera.x) * scale + width / 2;
  const toY = (y: number): number => height / 2 - (y - camera.y) * scale;
  context.setTransform(pixels, 0, 0, pixels, 0, 0);
  context.clearRect(0, 0, width, height);
  if (overlay.shimmer !== undefined) {
    const [wide, tall] = [overlay.page[0] * scale, overlay.page[1] * scale];
    const shimmer = overlay.shimmer(Math.ceil(wide * pixels), Math.ceil(tall * pixels));
    context.drawImage(shimmer, toX(0), toY(overlay.page[1]), wide, tall);
  }
  context.save();
  context.setTransform(scale * pixels, 0, 0, -scale * pixels, toX(0) * pixels, toY(0) * pixels);
  overlay.strokes?.(context, overlay.styles);
  if (overlay.shape !== undefined) drawVeil(context, overlay.shape, overlay);
  context.restore();
  drawPicture(context, overlay, toX, toY);
  drawMarks(context, overlay, toX, toY);
  if (overlay.above !== undefined) {
    context.save();
    overlay.above(context);
    context.restore();
  }
  const { cursor } = overlay;
  if (cursor !== undefined) {
    const at = { x: toX(cursor.x), y: toY(cursor.y) };
    drawBrush(context, at, overlay.radius * scale, overlay.softness);
  }
  if (overlay.ruled) drawRulers(context, overlay, width, height, scale, toX, toY);
}

/** Draws the picture over the left part of the page. */
function drawPicture(
  context: CanvasRenderingContext2D,
  { picture, grey, wipe, page }: Overlay,
  toX: (x: number) => number,
  toY: (y: number) => number,
): void {
  if (picture === undefined || wipe <= 0) return;
  const [left, top] = [toX(0), toY(page[1])];
  const [wide, tall] = [toX(page[0]) - left, toY(0) - top];
  if (grey) context.filter = 'grayscale(1)';
  context.drawImage(picture, 0, 0, picture.width * wipe, picture.height, left, top, wide * wipe, tall);
  context.filter = 'none';
}

/** Draws the outline of a brush. @param radius  in the context's unit */
export function drawBrush(context: CanvasRenderingContext2D, { x, y }: Cursor, radius: number, softness: number): void {
  const ring = (size: number, dashes: number[]): void => {
    for (const [colour, line] of [
      ['rgb(0 0 0 / 0.55)', 3],
      ['rgb(255 255 255 / 0.95)', 1.25],
    ] as const) {
      context.beginPath();
      context.setLineDash(dashes);
      context.arc(x, y, Math.max(1, size), 0, 2 * Math.PI);
      context.strokeStyle = colour;
      context.lineWidth = line;
      context.stroke();
    }
  };
  ring(radius, []);
  if (softness > 0.02) ring(radius * (1 - softness), [2, 3]);
  context.setLineDash([]);
  context.fillStyle = 'white';
  context.fillRect(x - 0.75, y - 0.75, 1.5, 1.5);
}

/** Veils the page outside the shape. */
function drawVeil(context: CanvasRenderingContext2D, shape: Shape, { page, styles }: Overlay): void {
  context.save();
  context.globalAlpha = 0.82;
  context.fillStyle = styles.getPropertyValue('--bench');
  context.fillRect(-0.5, -0.5, page[0] + 1, page[1] + 1);
  context.globalAlpha = 1;
  context.globalCompositeOperation = 'destination-out';
  fillShape(context, shape);
  context.restore();
}

/** Draws a circle for each mark, and cross-hairs around the mark in focus. */
function drawMarks(
  context: CanvasRenderingContext2D,
  { marks, mark: looked, styles }: Overlay,
  toX: (x: number) => number,
  toY: (y: number) => number,
): void {
  context.lineWidth = 1.5;
  for (const { x, y, kind } of marks) {
    context.strokeStyle = markColours[kind];
    context.beginPath();
    context.arc(toX(x), toY(y), 6, 0, 2 * Math.PI);
    context.stroke();
  }
  const at = marks[looked];
  if (at === undefined) return;
  const [x, y] = [toX(at.x), toY(at.y)];
  context.strokeStyle = styles.getPropertyValue('--accent');
  context.lineWidth = 2;
  context.beginPath();
  context.arc(x, y, 26, 0, 2 * Math.PI);
  for (const [dx, dy] of [
    [1, 0],
    [-1, 0],
    [0, 1],
    [0, -1],
  ] as const) {
    context.moveTo(x + 26 * dx, y + 26 * dy);
    context.lineTo(x + 36 * dx, y + 36 * dy);
  }
  context.stroke();
}

/** Draws rulers at the top and left edges, with the sides of the plate and the place of the brush. */
function drawRulers(
  context: CanvasRenderingContext2D,
  { camera, page, cursor, styles }: Overlay,
  width: number,
  height: number,
  scale: number,
  toX: (x: number) => number,
  toY: (y: number) => number,
): void {
  const step = roundStep(leastBetweenNumbers / scale);
  const tick = step / (step / 10 ** Math.floor(Math.log10(step)) === 2 ? 4 : 5);
  const digits = Math.max(0, -Math.floor(Math.log10(step)));
  context.fillStyle = styles.getPropertyValue('--surface');
  context.fillRect(0, 0, width, rulerWidth);
  context.fillRect(0, 0, rulerWidth, height);
  // The plate's own sides are tinted on the rulers.
  context.fillStyle = styles.getPropertyValue('--tint');
  context.fillRect(toX(0), 0, page[0] * scale, rulerWidth);
  context.fillRect(0, toY(page[1]), rulerWidth, page[1] * scale);
  context.strokeStyle = styles.getPropertyValue('--edge');
  context.fillStyle = styles.getPropertyValue('--soft');
  context.font = `10px ${styles.getPropertyValue('--font')}`;
  context.lineWidth = 1;
  context.beginPath();
  const across = width / scale / 2;
  for (let k = Math.ceil((camera.x - across) / tick); k * tick <= camera.x + across; ++k) {
    const x = Math.round(toX(k * tick)) + 0.5;
    const long = Math.abs(k * tick - Math.round((k * tick) / step) * step) < tick / 2;
    context.moveTo(x, rulerWidth);
    context.lineTo(x, rulerWidth - (long ? 9 : 4));
    // A number that began in the corner would lose its sign or first digit there.
    if (long && x >= rulerWidth) context.fillText((k * tick).toFixed(digits), x + 3, 10);
  }
  const tall = height / scale / 2;
  for (let k = Math.ceil((camera.y - tall) / tick); k * tick <= camera.y + tall; ++k) {
    const y = Math.round(toY(k * tick)) + 0.5;
    const long = Math.abs(k * tick - Math.round((k * tick) / step) * step) < tick / 2;
    context.moveTo(rulerWidth, y);
    context.lineTo(rulerWidth - (long ? 9 : 4), y);
    const word = (k * tick).toFixed(digits);
    if (!long || y - 3 - context.measureText(word).width < rulerWidth) continue;
    context.save();
    context.translate(10, y - 3);
    context.rotate(-Math.PI / 2);
    context.fillText(word, 0, 0);
    context.restore();
  }
  context.stroke();
  context.strokeStyle = styles.getPropertyValue('--line');
  context.strokeRect(rulerWidth + 0.5 - 1, rulerWidth + 0.5 - 1, width + 2, height + 2);
  if (cursor !== undefined) {
    context.fillStyle = styles.getPropertyValue('--accent');
    context.fillRect(toX(cursor.x) - 0.75, 0, 1.5, rulerWidth);
    context.fillRect(0, toY(cursor.y) - 0.75, rulerWidth, 1.5);
  }
  context.fillStyle = styles.getPropertyValue('--surface');
  context.fillRect(0, 0, rulerWidth - 1, rulerWidth - 1);
  context.fillStyle = styles.getPropertyValue('--soft');
  context.fillText('mm', 2, 13);
}
