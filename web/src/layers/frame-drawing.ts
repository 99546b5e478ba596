// Draws the chosen layer's frame, its handles, and the lines that it snaps to, over the plate.
import type { Place } from '../controls/gestures.js';
import { cornersOf, onPage, placeIn, type Frame, type Point } from '../model/layer-frame.js';
import { wholePicture } from '../model/layer-changes.js';
import type { Guide } from '../model/snap.js';
import type { Arranged } from './arranger.js';
import { anglePlace, handlesOf, knobPlace, sidePlace, sidesOf, type PageView } from './grips.js';

const handle = { pointer: 9, finger: 15 }; // [CSS pixels]

/** Everything needed for drawing. */
interface Pen {
  context: CanvasRenderingContext2D;
  view: PageView;
  styles: CSSStyleDeclaration;
  /** True for fingers, which need larger handles. */
  coarse: boolean;
}

function trace({ context, view }: Pen, points: readonly Point[]): void {
  context.beginPath();
  points.forEach((point, k) => {
    const { x, y } = view.toScreen(point);
    if (k === 0) context.moveTo(x, y);
    else context.lineTo(x, y);
  });
}

type Colour = '--accent' | '--bad';

/** Strokes the path with a lighter rim, so that it is visible on bright and on dark beads. */
function stroke({ context, styles }: Pen, width: number, colour: Colour = '--accent'): void {
  context.strokeStyle = styles.getPropertyValue('--surface');
  context.lineWidth = width + 2.5;
  context.stroke();
  context.strokeStyle = styles.getPropertyValue(colour);
  context.lineWidth = width;
  context.stroke();
}

function outline(pen: Pen, frame: Frame, width: number, colour?: Colour): void {
  trace(pen, cornersOf(frame));
  pen.context.closePath();
  stroke(pen, width, colour);
}

/** Draws a handle that is turned like the frame. */
function square({ context, styles }: Pen, { x, y }: { x: number; y: number }, side: number, turn: number): void {
  context.save();
  context.translate(x, y);
  context.rotate((-turn * Math.PI) / 180);
  context.beginPath();
  context.rect(-side / 2, -side / 2, side, side);
  context.fillStyle = styles.getPropertyValue('--raised');
  context.fill();
  context.strokeStyle = styles.getPropertyValue('--accent');
  context.lineWidth = 1.5;
  context.stroke();
  context.restore();
}

/** Draws a round handle at the end of a stem. */
function knob(pen: Pen, from: Place, at: Place, size: number): void {
  const { context, styles } = pen;
  context.beginPath();
  context.moveTo(from.x, from.y);
  context.lineTo(at.x, at.y);
  stroke(pen, 1.5);
  context.beginPath();
  context.arc(at.x, at.y, size / 2 + 1, 0, 2 * Math.PI);
  context.fillStyle = styles.getPropertyValue('--raised');
  context.fill();
  context.strokeStyle = styles.getPropertyValue('--accent');
  context.lineWidth = 1.5;
  context.stroke();
}

/** Draws a line to which the layer has snapped, dashed and a little longer than the page. */
function guide(pen: Pen, { axis, at }: Guide, page: Point): void {
  const { context } = pen;
  const beyond = 4 / pen.view.scale + 0.04 * Math.max(...page);
  trace(
    pen,
    axis === 0
      ? [
          [at, -beyond],
          [at, page[1] + beyond],
        ]
      : [
          [-beyond, at],
          [page[0] + beyond, at],
        ],
  );
  context.setLineDash([5, 4]);
  stroke(pen, 1);
  context.setLineDash([]);
}

/** Draws a text below the frame, or at the bottom of the view where that lies lower. */
function label({ context, view, styles }: Pen, frame: Frame, text: string): void {
  if (text === '') return;
  const places = cornersOf(frame).map(view.toScreen);
  const middle = view.toScreen(frame.middle);
  const low = Math.max(...places.map(({ y }) => y));
  const bottom = context.canvas.clientHeight - 34;
  context.font = `500 12px ${styles.getPropertyValue('--font')}`;
  const width = context.measureText(text).width + 16;
  const [left, top] = [middle.x - width / 2, Math.min(low + 12, bottom)];
  context.beginPath();
  context.roundRect(left, top, width, 22, 5);
  context.fillStyle = styles.getPropertyValue('--accent');
  context.fill();
  context.fillStyle = styles.getPropertyValue('--on-accent');
  context.textBaseline = 'middle';
  context.fillText(text, left + 8, top + 11.5);
  context.textBaseline = 'alphabetic';
}

/** Draws the whole picture in grey, since the plate shows no colours, and dims what is cropped. */
function crop(pen: Pen, frame: Frame, { layer }: Arranged, picture: ImageBitmap | undefined): void {
  const { context, view, styles } = pen;
  if (layer === undefined) return;
  const { low, high } = wholePicture(frame, layer);
  const [wide, tall] = [(high[0] - low[0]) * view.scale, (high[1] - low[1]) * view.scale];
  const at = view.toScreen(onPage(frame, [low[0], high[1]]));
  context.save();
  context.translate(at.x, at.y);
  context.rotate((-frame.turn * Math.PI) / 180);
  if (picture !== undefined) {
    context.save();
    if (layer.mirror) context.transform(-1, 0, 0, 1, wide, 0);
    context.filter = 'grayscale(1)';
    context.drawImage(picture, 0, 0, wide, tall);
    context.restore();
  }
  const [first, last] = [placeIn(frame, [-1, 1]), placeIn(frame, [1, -1])];
  context.beginPath();
  context.rect(0, 0, wide, tall);
  context.rect(
    (first[0] - low[0]) * view.scale,
    (high[1] - first[1]) * view.scale,
    (last[0] - first[0]) * view.scale,
    (first[1] - last[1]) * view.scale,
  );
  context.globalAlpha = 0.66;
  context.fillStyle = styles.getPropertyValue('--bench');
  context.fill('evenodd');
  context.restore();
}

/** Draws frames, handles, guides and the label. @param picture  picture of a layer that is being cropped, once it is
 * loaded */
export function drawArranged(pen: Pen, arranged: Arranged, page: Point, picture: ImageBitmap | undefined): void {
  const { frame, layer, cropping, over, bad, warned } = arranged;
  const size = pen.coarse ? handle.finger : handle.pointer;
  for (const each of warned) outline(pen, each, 2.5, '--bad');
  if (over !== undefined) outline(pen, over, 1);
  if (frame === undefined || layer === undefined) return;
  if (cropping) crop(pen, frame, arranged, picture);
  for (const line of arranged.guides) guide(pen, line, page);
  const { angle } = handlesOf(layer, cropping);
  const { view } = pen;
  if (!cropping && layer.kind !== 'border') knob(pen, sidePlace(frame, view, [0, 1]), knobPlace(frame, view), size);
  if (angle !== undefined) knob(pen, view.toScreen(frame.middle), anglePlace(frame, view, angle), size);
  outline(pen, frame, bad ? 2.5 : 1.5, bad ? '--bad' : '--accent');
  if (layer.kind !== 'border') {
    for (const side of sidesOf(cropping)) square(pen, sidePlace(frame, pen.view, side), size, frame.turn);
  }
  label(pen, frame, arranged.label);
}
