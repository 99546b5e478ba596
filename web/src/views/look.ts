// What a shader with `lookOfBead` is told: once for a picture rather than for each of its pixels.
import { appearance } from '../model/appearance.js';
import type { Light } from '../model/view.js';
import { lampOf } from './light.js';
import type { Program } from './program.js';

export interface Look {
  light: Light;
  /** The slope of the surface that blurs a point as much as the lamp's size. */
  lampSlope: number;
  /** Seen from straight above all over, as pictures are solved for; else from some page widths above. */
  fromAfar: boolean;
  /** Of the filament, linear 0..1. */
  body: readonly [number, number, number];
  /** RMS slopes along and across the bead [degrees]. */
  slopes: readonly [number, number];
  page: readonly [number, number];
}

/** The light of a bead's whole top: the shader's `highlightOf` where all of it is seen.
 * @param along, across  the tilt of what reflects @param variances  along, across */
export function highlightOf(along: number, across: number, variances: readonly [number, number]): number {
  let sum = 0;
  for (let k = 0; k < 8; ++k) {
    const slope = across - appearance.profileSlope * ((k + 0.5) / 4 - 1);
    sum += Math.exp((-along * along) / (2 * variances[0]) - (slope * slope) / (2 * variances[1]));
  }
  return sum / 8;
}

/** @returns vector to the lamp, variances along and across, light of the brightest direction */
export function exposed({ light, lampSlope, slopes }: Pick<Look, 'light' | 'lampSlope' | 'slopes'>) {
  const lamp = lampOf(light);
  const variance = (degrees: number): number => Math.tan((degrees * Math.PI) / 180) ** 2 + lampSlope ** 2;
  const variances = [variance(slopes[0]), variance(slopes[1])] as const;
  // Exposed for the brightest direction, which is across the light, or along it where beads are rougher that way.
  const middle = Math.hypot(lamp[0], lamp[1]) / (1 + lamp[2]);
  const brightest = Math.max(highlightOf(0, middle, variances), highlightOf(middle, 0, variances), 1e-6);
  return { lamp, variances, brightest };
}

export function setLook(gl: WebGL2RenderingContext, { at }: Program, look: Look): void {
  const { lamp, variances, brightest } = exposed(look);
  gl.uniform3f(at('lamp'), ...lamp);
  gl.uniform3f(at('body'), ...look.body);
  gl.uniform3f(at('surface'), ...variances, brightest);
  gl.uniform1f(at('eyeNear'), look.fromAfar ? 0 : 1);
  gl.uniform2f(at('page'), ...look.page);
}
