// The brush over the plate: a pen whose strokes are the plate's.
import { pageOf, type Stroke } from '../model/plate.js';
import type { Shown } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';
import { Pen } from './pen.js';

export class Brush extends Pen {
  /** What is being drawn, as it lies in the plate. */
  #stroke: Stroke | undefined;
  readonly #studio: Studio;

  constructor(studio: Studio) {
    super(
      () => pageOf(studio.store.state.plate),
      (points) => {
        this.#draw(points);
      },
      () => {
        studio.settle();
      },
    );
    this.#studio = studio;
  }

  #draw(points: readonly number[]): void {
    const { tool, brush, plate } = this.#studio.store.state;
    if (tool === 'pan') return;
    const page = pageOf(plate);
    const stroke: Stroke = {
      tool,
      points: points.map((value, k) => value / page[k % 2 === 0 ? 0 : 1]),
      radius: brush.radius,
      softness: brush.softness,
      ...(tool === 'mode' ? { mode: brush.mode } : {}),
    };
    const first = points.length === 2;
    this.#stroke = stroke;
    this.#studio.change(
      ({ strokes, ...rest }) => ({ ...rest, strokes: [...(first ? strokes : strokes.slice(0, -1)), stroke] }),
      'stroke',
    );
  }

  abandon(): void {
    if (this.points !== undefined) this.#studio.store.abandon();
    this.lift();
  }

  /** Undone, cleared, or another tool: what is drawn next must not take the place of an earlier stroke. */
  follow({ plate, tool }: Readonly<Shown>, before: Readonly<Shown>): void {
    if (plate.strokes.at(-1) !== this.#stroke || tool !== before.tool) this.lift();
  }
}
