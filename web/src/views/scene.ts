// Input of the views. Arrays are read, never changed.
import type { PrinterValues, Toolpath } from 'sillon';
import type { Directions } from '../model/raster.js';
import type { ColourBy, FilamentLook, Mark, ViewName } from '../model/view.js';
import type { Look } from './look.js';

/** Limits of a bead's speed; corners are not considered. */
export interface Feed {
  printer: PrinterValues;
  /** Layer height [mm]. */
  layerHeight: number;
}

export interface Scene extends Pick<Look, 'light' | 'lampSlope' | 'fromAfar' | 'page'> {
  /** Beads to draw; undefined: there are none yet, and the directions stand in for them. */
  toolpath: Toolpath | undefined;
  directions?: Directions | undefined;
  /** Spacing of the beads to come [mm]. */
  spacing?: number;
  /** Drawn pixels per screen pixel, in one direction; the camera's scale includes it. */
  fineness?: number;
  /** Something moves where drawing is slow: only the directions are drawn, which cost far less. */
  quick?: boolean;
  /** New beads fade in. */
  fades?: boolean;
  view: ViewName;
  colourBy: ColourBy;
  feed: Feed;
  /** Share of the print that is shown, 0..1. */
  progress: number;
  /** The same shape under a plain 45° zigzag stands beside the plate. */
  compare: boolean;
  /** Share of the page, from the left, over which that zigzag covers the plate; undefined: none of it. */
  wipe?: number | undefined;
  /** Beads blend into one surface, without relief. */
  blended?: boolean;
  /** Colour and roughness of the plastic. */
  filament: FilamentLook;
  marks: readonly Mark[];
  dark: boolean;
}

/** Middle of the screen [mm] and scale in pixels per mm. */
export interface Camera {
  x: number;
  y: number;
  scale: number;
}

/** Returns the width of all that the scene shows, in page widths. */
const shownOf = ({ compare }: Scene): number => (compare ? 2.08 : 1);

/** Returns the pixels per mm of a picture of the scene with a rim of ground around it. @param width  [pixels] */
export const captureScale = (scene: Scene, width: number): number => width / (scene.page[0] * (shownOf(scene) + 0.1));

/** Returns the height of a picture of the scene [pixels]. */
export const captureHeight = (scene: Scene, width: number): number =>
  Math.round(captureScale(scene, width) * scene.page[1] * 1.1);

/** Returns the camera of a picture of the scene. */
export const captureCamera = (scene: Scene, width: number): Camera => ({
  x: (scene.page[0] * shownOf(scene)) / 2,
  y: scene.page[1] / 2,
  scale: captureScale(scene, width),
});

/** Draws scenes into a canvas, with one WebGL2 context; it uploads only what changed. */
export interface Renderer {
  /** Drawing is slow in every scene. */
  readonly stepwise?: boolean;
  /** Draws at once; cheap if only camera, light, progress or colours changed. The beads of a long path are prepared
   * in slices and come a little later; the previous drawing stays until then. */
  draw(scene: Scene, camera: Camera): void;
  /** Resolves when the last drawing is ready to be seen. */
  finished(): Promise<void>;
  /** Sets the size of the canvas in device pixels; the caller draws again. */
  resize(width: number, height: number): void;
  /** Returns a picture of the scene, `width` pixels wide, whatever the canvas shows. */
  capture(scene: Scene, width: number): Promise<Blob>;
  dispose(): void;
}
