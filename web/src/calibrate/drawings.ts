// Line drawings of the calibration prints and of the coaster, on a grid of 48, in the colour of the surrounding text.
import { svg, type SVGTemplateResult } from 'lit';
import type { CalibrationKind } from 'sillon';

/** Path of an Archimedean spiral. */
const spiral = (x: number, y: number, radius: number, turns: number): string => {
  const points = Array.from({ length: 24 * turns + 1 }, (_, k) => {
    const [angle, r] = [(2 * Math.PI * k) / 24, (radius * k) / (24 * turns)];
    return `${(x + r * Math.cos(angle)).toFixed(1)} ${(y - r * Math.sin(angle)).toFixed(1)}`;
  });
  return `M${points.join('L')}`;
};

/** The spokes of a ring. */
const star = (x: number, y: number, inner: number, outer: number, count: number): string =>
  Array.from({ length: count }, (_, k) => {
    const [u, v] = [Math.cos((2 * Math.PI * k) / count), Math.sin((2 * Math.PI * k) / count)];
    const at = (r: number): string => `${(x + r * u).toFixed(1)} ${(y + r * v).toFixed(1)}`;
    return `M${at(inner)}L${at(outer)}`;
  }).join('');

const lines = (x: number, right: number, ys: readonly number[]): string =>
  ys.map((y) => `M${x} ${y}H${right}`).join('');
const waves = (y: number): string => `M5 ${y}q4.5 -5 9 0t9 0M26 ${y}q4.5 -2.5 9 0t9 0`;
const strips = (y: number): string => `M5 ${y + 2}h4M14 ${y}h29v4h-29zM14 ${y + 2}h29`;

const drawings: Record<CalibrationKind | 'coaster', string> = {
  coaster: `${spiral(24, 24, 18, 5)}M24 4.5a19.5 19.5 0 0 1 0 39a19.5 19.5 0 0 1 0 -39`,
  coupon: `${star(17, 18, 5, 12, 16)}${spiral(38, 9, 5, 3)}${spiral(38, 22, 5, 3)}M5 36l33 -3v9l-33 -3zM5 37.5h33`,
  flow: `${spiral(13, 14, 8, 3)}${spiral(35, 14, 8, 4)}${spiral(13, 35, 8, 5)}${spiral(35, 35, 8, 6)}`,
  speed: [9, 16, 23, 30, 37].map(waves).join(''),
  fan: `${[7, 34].map(strips).join('')}M24 16.5a4 4 0 0 1 0 8a4 4 0 0 1 0 -8M24 20.5h-10M34 20.5h-10M5 27h4M14 29h29`,
  width: `M5 21L43 11M5 22.5L43 15.5M5 24H43M5 25.5L43 32.5M5 27L43 37M5 40v-3M17.5 40v-3M30.5 40v-3M43 40v-3`,
  directions: `${star(24, 25, 7, 16, 24)}M24 4v3M44.5 25h-3`,
  swatch: `M4 9h40v30h-40z${lines(8, 40, [14, 17, 20, 23])}M14 12v13M17 12v13M24 12v13M31 12v13M34 12v13M8 35v-5M13 35l2 -5M19 34l4 -4M25 33h5M32 30l4 4M40 35v-5`,
};

export const drawing = (kind: keyof typeof drawings): SVGTemplateResult => svg`
  <svg class="drawing" viewBox="0 0 48 48" fill="none" stroke="currentColor" stroke-width="1.1" stroke-linecap="round"
    stroke-linejoin="round" aria-hidden="true" focusable="false">
    <path d=${drawings[kind]} />
  </svg>`;
