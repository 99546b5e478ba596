// Layers on the stage: what the pointer and the keys do with them there, and how they are drawn over the plate.
import { pageOf } from '../model/plate.js';
import type { Studio } from '../studio/studio.js';
import { Arranger } from './arranger.js';
import { followBoxes } from './boxes.js';
import { drawArranged } from './frame-drawing.js';
import type { PageView } from './grips.js';

type View = Pick<PageView, 'toPage' | 'toScreen'> & { scale: () => number };

export class LayerStage extends Arranger {
  readonly #styles: CSSStyleDeclaration;
  readonly #coarse = matchMedia('(pointer: coarse)');
  #picture: { of: Blob; bitmap: ImageBitmap | undefined } | undefined;
  readonly #own: Studio;
  readonly #viewNow: () => PageView;
  readonly #redraw: () => void;

  constructor(studio: Studio, view: View, redraw: () => void) {
    const viewNow = (): PageView => ({ ...view, scale: view.scale() });
    super(studio, viewNow);
    this.#own = studio;
    this.#viewNow = viewNow;
    this.#redraw = redraw;
    this.#styles = getComputedStyle(document.documentElement);
    followBoxes(studio);
  }

  /** @returns what draws them, in CSS pixels; undefined: nothing is to be drawn */
  drawing(): ((context: CanvasRenderingContext2D) => void) | undefined {
    const arranged = this.shown();
    if (arranged === undefined) return undefined;
    const page = pageOf(this.#own.store.state.plate);
    const bytes = arranged.cropping ? arranged.layer?.pictures[0]?.file.bytes : undefined;
    const picture = bytes && this.#bitmap(bytes);
    return (context) => {
      const pen = { context, view: this.#viewNow(), styles: this.#styles, coarse: this.#coarse.matches };
      drawArranged(pen, arranged, page, picture);
    };
  }

  #bitmap(bytes: Blob): ImageBitmap | undefined {
    if (this.#picture?.of === bytes) return this.#picture.bitmap;
    const picture: { of: Blob; bitmap: ImageBitmap | undefined } = { of: bytes, bitmap: undefined };
    this.#picture = picture;
    void Promise.all([import('../files/drawn.js'), this.#own.services.engine()])
      .then(([{ bitmapOf }, running]) => bitmapOf(bytes, running))
      .then(
        (bitmap) => {
          picture.bitmap = bitmap;
          this.#redraw();
        },
        () => undefined, // of a kind that browsers do not draw
      );
    return undefined;
  }
}
