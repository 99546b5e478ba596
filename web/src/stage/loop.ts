// Makes a short seamless loop of the moving light, at a size for messengers, with a renderer of its own.
import encoder from '@jsquash/webp/codec/enc/webp_enc_simd.js';
import { defaultOptions } from '@jsquash/webp/meta.js';
import { animatedWebp, type WebpFrame } from '../files/webp.js';
import { loop } from '../model/loop.js';
import type { Light } from '../model/view.js';
import { loopLights } from '../views/loop-lights.js';
import { createRenderer } from '../views/renderer.js';
import { captureHeight, type Renderer, type Scene } from '../views/scene.js';

/** Colour of the ground: WebP stores transparency apart, which would cost as much again. */
const ground = '#262422';

/** Starts libwebp; the package's own types name files that it does not contain. */
const startEncoder = encoder as unknown as () => Promise<{
  encode(data: BufferSource, width: number, height: number, options: typeof defaultOptions): Uint8Array | null;
}>;

/** Lets other tasks of the page run. */
const turnOfOthers = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));

/** Returns a function that takes a picture of the scene under a light. */
function camera(renderer: Renderer, scene: Scene): (light: Light) => Promise<ImageData> {
  const { side } = loop;
  const tall = captureHeight(scene, side) / side;
  const width = tall > 1 ? Math.round(side / tall) : side;
  const height = captureHeight(scene, width);
  const canvas = Object.assign(document.createElement('canvas'), { width, height });
  const context = canvas.getContext('2d', { willReadFrequently: true }) as CanvasRenderingContext2D;
  context.fillStyle = ground;
  return async (light) => {
    const picture = await createImageBitmap(await renderer.capture({ ...scene, light }, width));
    context.fillRect(0, 0, width, height);
    context.drawImage(picture, 0, 0);
    picture.close();
    return context.getImageData(0, 0, width, height);
  };
}

/** Encodes all pictures with the highest quality whose files together are small enough, or with the lowest. They
 * share one quality, since different ones would flicker. */
async function encoded(pictures: readonly ImageData[], signal?: AbortSignal): Promise<Uint8Array[]> {
  const { bytes: most, qualityStep } = loop;
  const libwebp = await startEncoder();
  for (let quality: number = loop.bestQuality; ; quality -= qualityStep) {
    const files: Uint8Array[] = [];
    let size = 0;
    for (const { data, width, height } of pictures) {
      await turnOfOthers();
      signal?.throwIfAborted();
      const file = libwebp.encode(data, width, height, { ...defaultOptions, quality });
      if (file === null) throw new Error('the picture could not be made');
      files.push(file);
      size += file.length;
    }
    if (size <= most || quality <= qualityStep) return files;
  }
}

/** Makes the loop.
 * @param lamps  lamps of the plate's pictures; without pictures, one light
 * @throws StudioError NoWebGl; the signal's reason */
export async function makeLoop(scene: Scene, lamps: readonly Light[], signal?: AbortSignal): Promise<Blob> {
  const renderer = createRenderer(document.createElement('canvas')); // the page's own renderer stays as it is
  try {
    const take = camera(renderer, scene);
    const lights = loopLights(lamps);
    const pictures: ImageData[] = [];
    for (const { light } of lights) {
      signal?.throwIfAborted();
      pictures.push(await take(light));
    }
    const files = await encoded(pictures, signal);
    const frames: WebpFrame[] = files.map((bytes, k) => ({ bytes, milliseconds: lights[k]?.milliseconds ?? 0 }));
    const { width, height } = pictures[0] as ImageData;
    return new Blob([animatedWebp(frames, width, height)], { type: 'image/webp' });
  } finally {
    renderer.dispose();
  }
}
