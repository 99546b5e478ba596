// How a hand moves the camera over a bench.
import type { Camera } from './scene.js';

/** Nearer by a factor, with the same place [mm] under the pointer. @param least, most  pixels per mm */
export function zoomed(
  camera: Camera,
  at: { x: number; y: number },
  factor: number,
  least: number,
  most: number,
): Camera {
  const scale = Math.min(most, Math.max(least, camera.scale * factor));
  const share = camera.scale / scale;
  return { x: at.x + (camera.x - at.x) * share, y: at.y + (camera.y - at.y) * share, scale };
}

/** Dragged along [pixels, y down]. Its middle leaves the page by no more than a share of the page's sides. */
export function panned(camera: Camera, dx: number, dy: number, page: readonly [number, number], share: number): Camera {
  const within = (value: number, length: number): number =>
    Math.min((1 + share) * length, Math.max(-share * length, value));
  return {
    ...camera,
    x: within(camera.x - dx / camera.scale, page[0]),
    y: within(camera.y + dy / camera.scale, page[1]),
  };
}
