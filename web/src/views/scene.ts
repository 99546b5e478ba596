// What the views draw. Arrays are read, never changed.
import type { Toolpath } from 'sillon';
import type { DirectionRaster } from '../directions/raster.js';

export type ViewName = 'directions' | 'toolpath' | 'appearance' | 'quality';
export type ColourBy = 'direction' | 'width' | 'speed' | 'order';

/** Light and camera look at the plate from above; azimuth and elevation in degrees. */
export interface Light {
  azimuth: number;
  elevation: number;
}

/** A filament's look: linear RGB of its body, RMS slopes along and across the bead (degrees in the paper's Table 1). */
export interface FilamentLook {
  colour: [number, number, number];
  along: number;
  across: number;
}

/** What limits the speed of a bead [mm/s, mm³/s, mm]; corners are left out. */
export interface Feed {
  speed: number;
  maxFlow: number;
  layerHeight: number;
}

/** A place worth a look, found by the quality view [mm]. */
export interface Mark {
  x: number;
  y: number;
  kind: 'turn' | 'gap' | 'narrow' | 'wide' | 'lost';
}

export interface Scene {
  page: [number, number];
  toolpath: Toolpath | undefined;
  directions: DirectionRaster | undefined;
  view: ViewName;
  colourBy: ColourBy;
  feed: Feed;
  /** 0..1: how much of the print is shown. */
  progress: number;
  /** Beside the plate, the same shape under a plain 45° zigzag. */
  compare: boolean;
  light: Light;
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

/** Draws scenes into a canvas; one WebGL2 context, uploads only what changed. */
export interface Renderer {
  /** Draws now. Cheap when only camera, light, progress or colours changed. */
  draw(scene: Scene, camera: Camera): void;
  /** Size of the canvas in device pixels. */
  resize(width: number, height: number): void;
  /** A picture of the scene, `width` pixels wide, whatever the canvas shows. */
  capture(scene: Scene, width: number): Promise<Blob>;
  dispose(): void;
}
