// The first shimmer: the view of the plate that a first visit sees, shown until its beads are made.
import { decodeView, fetchView } from '../embed/view-file.js';
import { ViewRenderer } from '../embed/view-renderer.js';
import type { Shimmer } from '../model/view.js';

/** Name of the file, which web/gallery.js makes. */
const file = 'opening.view.png';

/** Loads the view and returns a function that draws it under a light. @throws Error if it cannot be loaded or drawn */
export async function loadShimmer(): Promise<Shimmer> {
  const view = await fetchView(new URL(file, document.baseURI), file, new AbortController().signal);
  const renderer = new ViewRenderer(() => undefined);
  renderer.hold(view, await decodeView(view, file));
  const canvas = document.createElement('canvas');
  return (light, width, height) => {
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    renderer.draw({ file: view, colour: view.colour, light, fromAfar: true }, canvas);
    return canvas;
  };
}
