// What the views draw. Arrays are read, never changed.
import type { PrinterValues, Toolpath } from 'sillon';
import type { Directions } from '../model/raster.js';
import type { ColourBy, FilamentLook, Mark, ViewName } from '../model/view.js';
import type { Look } from './look.js';

/** Limits of the speed of a bead; corners are left out. */
export interface Feed {
  printer: PrinterValues;
  /** [mm] */
  layerHeight: number;
}

export interface Scene extends Pick<Look, 'light' | 'lampSlope' | 'fromAfar' | 'page'> {
  /** undefined: there are no beads yet, and the directions stand in for them. */
  toolpath: Toolpath | undefined;
  directions?: Directions | undefined;
  /** Spacing of the beads that are still to come [mm]. */
  spacing?: number;
  /** Pixels drawn per pixel of the screen, one way; the camera's scale has it in it. */
  fineness?: number;
  /** Something moves where it is hard to draw: the directions do, which take far less. */
  quick?: boolean;
  /** Beads that have come show little by little. */
  fades?: boolean;
  view: ViewName;
  colourBy: ColourBy;
  feed: Feed;
  /** 0..1: how much of the print is shown. */
  progress: number;
  /** Beside the plate, the same shape under a plain 45° zigzag. */
  compare: boolean;
  /** Over the plate's left, up to this share of the page, lies that zigzag; undefined: nothing does. */
  wipe?: number | undefined;
  /** No bead is told from its neighbours. */
  blended?: boolean;
  filament: FilamentLook;
  marks: readonly Mark[];
  dark: boolean;
}

/** Middle of the screen [mm] and pixels per mm. */
export interface Camera {
  x: number;
  y: number;
  scale: number;
}

const shownOf = ({ compare }: Scene): number => (compare ? 2.08 : 1);

/** Pixels per mm of a picture of the scene, around which some ground is seen. @param width  [pixels] */
export const captureScale = (scene: Scene, width: number): number => width / (scene.page[0] * (shownOf(scene) + 0.1));

/** [pixels] */
export const captureHeight = (scene: Scene, width: number): number =>
  Math.round(captureScale(scene, width) * scene.page[1] * 1.1);

export const captureCamera = (scene: Scene, width: number): Camera => ({
  x: (scene.page[0] * shownOf(scene)) / 2,
  y: scene.page[1] / 2,
  scale: captureScale(scene, width),
});

/** Draws scenes into a canvas; one WebGL2 context, uploads only what changed. */
export interface Renderer {
  /** It is always hard to draw. */
  readonly stepwise?: boolean;
  /** Draws now. Cheap when only camera, light, progress or colours changed. Beads of a long path come a little later, when
   * they are prepared in slices; what stood in their place stays until then. */
  draw(scene: Scene, camera: Camera): void;
  /** When what was drawn last is there to be seen. */
  finished(): Promise<void>;
  /** Size of the canvas in device pixels; it is to be drawn anew. */
  resize(width: number, height: number): void;
  /** A picture of the scene, `width` pixels wide, whatever the canvas shows. */
  capture(scene: Scene, width: number): Promise<Blob>;
  dispose(): void;
}
