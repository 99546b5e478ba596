// Decodes a picture file for drawing, and keeps the last one.
import type { Studio } from '../studio/studio.js';

export class FileBitmap {
  #of: Blob | undefined;
  #bitmap: ImageBitmap | undefined;

  /** Creates an empty cache. @param drawn  called when another picture is ready */
  constructor(
    private readonly studio: Studio,
    private readonly drawn: () => void,
  ) {}

  /** Returns the picture of a file. @returns undefined: not ready yet, or a kind that browsers do not draw */
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
