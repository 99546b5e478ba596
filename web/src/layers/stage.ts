// Layers on the stage: handling of the pointer and the keys, and drawing over the plate.
import { pageOf } from '../model/plate.js';
import type { Studio } from '../studio/studio.js';
import { Arranger } from './arranger.js';
import { followBoxes } from './boxes.js';
import { drawArranged } from './frame-drawing.js';
import type { PageView } from './grips.js';

type View = Pick<PageView, 'toPage' | 'toScreen'> & { scale: () => number };

/** An arranger that also draws, with the picture that is being cropped. */
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

  /** A function that draws the layers' frames, in CSS pixels; undefined where nothing is drawn. */
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
        () => undefined, // browsers cannot draw this kind of file
      );
    return undefined;
  }
}
