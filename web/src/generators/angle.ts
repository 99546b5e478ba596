// Angles as rasters store them, and as double-angle vectors, which can be averaged: a bead at 180° is one at 0°.

const steps = 65535;

/** Half turns, any number of them, to what a raster stores. As the engine does it. */
function stored(halfTurns: number): number {
  const turned = halfTurns - Math.floor(halfTurns + 0.5);
  return Math.round((turned + 0.5) * steps);
}

export const storeDegrees = (degrees: number): number => stored(degrees / 180);

export const degreesOf = (angle: number): number => (angle / steps) * 180 - 90;

/** Of the double-angle vector (x, y), of any length; 0° where it has none. */
export const storeDouble = (x: number, y: number): number => stored(Math.atan2(y, x) / (2 * Math.PI));

export function storeDoubles(x: Float32Array, y: Float32Array): Uint16Array {
  const out = new Uint16Array(x.length);
  for (let k = 0; k < out.length; ++k) out[k] = storeDouble(x[k] as number, y[k] as number);
  return out;
}

let tables: { x: Float32Array; y: Float32Array } | undefined;

/** Unit double-angle vectors by stored angle: a stroke needs them for every texel that it blends. */
export function doubleVectors(): { x: Float32Array; y: Float32Array } {
  if (tables !== undefined) return tables;
  const x = new Float32Array(steps + 1);
  const y = new Float32Array(steps + 1);
  for (let angle = 0; angle <= steps; ++angle) {
    const double = (angle / steps - 0.5) * 2 * Math.PI;
    x[angle] = Math.cos(double);
    y[angle] = Math.sin(double);
  }
  tables = { x, y };
  return tables;
}
