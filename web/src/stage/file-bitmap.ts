// A picture as a browser draws it, once that has been done.
import type { Studio } from '../studio/studio.js';

export class FileBitmap {
  #of: Blob | undefined;
  #bitmap: ImageBitmap | undefined;

  /** @param drawn  called once there is another one */
  constructor(
    private readonly studio: Studio,
    private readonly drawn: () => void,
  ) {}

  /** @returns undefined: there is none yet, or it is of a kind that browsers do not draw */
  of(bytes: Blob): ImageBitmap | undefined {
    if (this.#of !== bytes) void this.#draw(bytes).catch(() => undefined);
    return this.#bitmap;
  }

  async #draw(bytes: Blob): Promise<void> {
    this.#of = bytes;
    this.#bitmap = undefined;
    const [{ bitmapOf }, engine] = await Promise.all([import('../files/drawn.js'), this.studio.services.engine()]);
    const bitmap = await bitmapOf(bytes, engine);
    if (this.#of === bytes) this.#bitmap = bitmap;
    this.drawn();
  }
}
