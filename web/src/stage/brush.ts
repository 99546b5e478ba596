// The brush over the plate: a pen whose strokes form a layer of the plate, above all others.
import type { Stroke } from 'sillon';
import { hundredth } from '../model/layer-changes.js';
import { changeLayer, newLayer, withLayer } from '../model/layer-list.js';
import { mostEntries } from '../model/layer-table.js';
import { pageOf, type Plate, type PlateLayer } from '../model/plate.js';
import type { Shown } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';
import { Pen } from './pen.js';

/** Returns the layer that takes the next stroke; undefined: a new layer is needed. */
function strokesLayer({ layers }: Plate): PlateLayer | undefined {
  const top = layers.at(-1);
  return top?.kind === 'strokes' && top.visible && top.strokes.length < mostEntries.strokes ? top : undefined;
}

/** Returns the plate with one more stroke, or with the last stroke replaced. */
function withStroke(plate: Plate, stroke: Stroke, more: boolean): Plate {
  const layer = strokesLayer(plate);
  if (layer === undefined) return more ? withLayer(plate, newLayer(plate, 'strokes', { strokes: [stroke] })) : plate;
  const before = more ? layer.strokes : layer.strokes.slice(0, -1);
  return changeLayer(plate, layer.id, () => ({ strokes: [...before, stroke] }));
}

export class Brush extends Pen {
  /** Stroke being drawn, as it is in the plate. */
  #stroke: Stroke | undefined;
  readonly #studio: Studio;

  constructor(studio: Studio) {
    super(
      () => pageOf(studio.store.state.plate),
      (points) => this.#draw(points),
      () => studio.settle(),
    );
    this.#studio = studio;
  }

  /** Puts the stroke so far into the plate. */
  #draw(points: readonly number[]): void {
    const { tool, brush, plate } = this.#studio.store.state;
    if (tool === 'pan') return;
    const stroke: Stroke = {
      tool,
      points: points.map(hundredth),
      radius: brush.radius * pageOf(plate)[0],
      soft: brush.softness,
      ...(tool === 'mode' ? { mode: brush.mode } : {}),
    };
    this.#stroke = stroke;
    this.#studio.change((now) => withStroke(now, stroke, points.length === 2), 'stroke');
  }

  abandon(): void {
    if (this.points !== undefined) this.#studio.store.abandon();
    this.lift();
  }

  /** Ends the stroke after an undo, a clear or a change of tool: the next point must not replace an earlier stroke. */
  follow({ plate, tool }: Readonly<Shown>, before: Readonly<Shown>): void {
    if (strokesLayer(plate)?.strokes.at(-1) !== this.#stroke || tool !== before.tool) this.lift();
  }
}
