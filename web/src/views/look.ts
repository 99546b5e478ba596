// Uniforms of shaders with `lookOfBead`, computed once per picture instead of once per pixel.
import { appearance } from '../model/appearance.js';
import type { Light } from '../model/view.js';
import { lampOf } from './light.js';
import type { Program } from './program.js';

export interface Look {
  light: Light;
  /** Slope of the surface that blurs a point as much as the lamp's size does. */
  lampSlope: number;
  /** The eye is straight above every point, as pictures are solved for; otherwise some page widths above the plate. */
  fromAfar: boolean;
  /** Colour of the filament, linear 0..1. */
  body: readonly [number, number, number];
  /** RMS slopes along and across the bead [degrees]. */
  slopes: readonly [number, number];
  page: readonly [number, number];
}

/** Returns the light of the whole top of a bead, as the shader's `highlightOf` does for a fully visible top.
 * @param along, across  tilt of the reflecting facet
 * @param variances  variances of the slope along and across the bead */
export function highlightOf(along: number, across: number, variances: readonly [number, number]): number {
  let sum = 0;
  for (let k = 0; k < 8; ++k) {
    const slope = across - appearance.profileSlope * ((k + 0.5) / 4 - 1);
    sum += Math.exp((-along * along) / (2 * variances[0]) - (slope * slope) / (2 * variances[1]));
  }
  return sum / 8;
}

/** Computes the lamp and the exposure of a look.
 * @returns vector to the lamp, variances along and across the bead, light of the brightest direction */
export function exposed({ light, lampSlope, slopes }: Pick<Look, 'light' | 'lampSlope' | 'slopes'>) {
  const lamp = lampOf(light);
  const variance = (degrees: number): number => Math.tan((degrees * Math.PI) / 180) ** 2 + lampSlope ** 2;
  const variances = [variance(slopes[0]), variance(slopes[1])] as const;
  // Exposure is set for the brightest direction: across the light, or along it if beads are rougher that way.
  const middle = Math.hypot(lamp[0], lamp[1]) / (1 + lamp[2]);
  const brightest = Math.max(highlightOf(0, middle, variances), highlightOf(middle, 0, variances), 1e-6);
  return { lamp, variances, brightest };
}

/** Sets the uniforms of `lookOfBead` in the program in use. */
export function setLook(gl: WebGL2RenderingContext, { at }: Program, look: Look): void {
  const { lamp, variances, brightest } = exposed(look);
  gl.uniform3f(at('lamp'), ...lamp);
  gl.uniform3f(at('body'), ...look.body);
  gl.uniform3f(at('surface'), ...variances, brightest);
  gl.uniform1f(at('eyeNear'), look.fromAfar ? 0 : 1);
  gl.uniform2f(at('page'), ...look.page);
}
