// Pictures that tell angles, read as the engine reads them.
import type { DirectionEncoding, Picture } from 'sillon';
import { doubleVectors, storeDegrees, storeDoubles } from './angle.js';
import { resampled } from './grey.js';
import { sizeFor, type Page, type Size } from './texels.js';

/** Grey of each pixel, 0..65535; alpha does not count. */
export function greys({ width, height, channels, samples }: Picture): Uint16Array {
  const scale = samples instanceof Uint16Array ? 1 : 257;
  const out = new Uint16Array(width * height);
  for (let pixel = 0, k = 0; pixel < out.length; ++pixel, k += channels) {
    const first = (samples[k] as number) * scale;
    if (channels < 3) {
      out[pixel] = first;
    } else {
      const sum = 13933 * first + (46871 * (samples[k + 1] as number) + 4732 * (samples[k + 2] as number)) * scale;
      out[pixel] = Math.floor((sum + 32768) / 65536);
    }
  }
  return out;
}

function tangents({ width, height, channels, samples }: Picture): Uint16Array {
  const scale = samples instanceof Uint16Array ? 1 : 257;
  const neutral = 257; // 8-bit pictures can say 127 or 128, not one half
  const out = new Uint16Array(width * height);
  for (let pixel = 0, k = 0; pixel < out.length; ++pixel, k += channels) {
    const x = 2 * (samples[k] as number) * scale - 65535;
    const y = 2 * (samples[k + 1] as number) * scale - 65535;
    const tells = Math.abs(x) > neutral || Math.abs(y) > neutral;
    out[pixel] = storeDegrees(tells ? (Math.atan2(y, x) * 180) / Math.PI : 0);
  }
  return out;
}

function anglesIn(picture: Picture, encoding: DirectionEncoding): Uint16Array {
  switch (encoding) {
    case 'angle':
      return greys(picture);
    case 'rotation':
      return greys(picture).map((grey) => (grey < 32768 ? grey + 32768 : grey - 32767));
    case 'tangent':
      return tangents(picture);
  }
}

/** A map keeps its own texels, which the engine then reads as if it had the file, unless they are far too many or too few
 * to draw and to paint on. */
export function mapSize(picture: Picture, page: Page, longest: number): Size {
  const own = Math.max(picture.width, picture.height);
  return own <= 2 * longest && 2 * own >= longest ? picture : sizeFor(page, longest);
}

export function mapAngles(encoding: DirectionEncoding, size: Size, picture: Picture): Uint16Array {
  const angles = anglesIn(picture, encoding);
  if (size.width === picture.width && size.height === picture.height) return angles;
  if (size.width > picture.width) return nearest(angles, picture, size);
  const vectors = doubleVectors();
  const part = (table: Float32Array): Float32Array => {
    const values = new Float32Array(angles.length);
    for (let k = 0; k < values.length; ++k) values[k] = table[angles[k] as number] as number;
    return resampled(values, picture, size);
  };
  const x = part(vectors.x);
  const y = part(vectors.y);
  return storeDoubles(x, y);
}

export function nearest<Values extends Uint8Array | Uint16Array | Int32Array>(
  values: Values,
  from: Size,
  to: Size,
): Values {
  const make = values.constructor as new (length: number) => Values;
  const out = new make(to.width * to.height);
  const columns = Int32Array.from({ length: to.width }, (_, x) => Math.floor(((x + 0.5) * from.width) / to.width));
  for (let y = 0, k = 0; y < to.height; ++y) {
    const row = Math.floor(((y + 0.5) * from.height) / to.height) * from.width;
    for (let x = 0; x < to.width; ++x, ++k) out[k] = values[row + (columns[x] as number)] as number;
  }
  return out;
}
