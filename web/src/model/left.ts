// Keeps what a plate was made of before another card was tried, so that going back asks for no file again.
import { fillOf, groundOf, toldFrom, type Fill } from './fills.js';
import type { LayerValues } from './layers.js';
import type { Plate, PlateLayer, SourceFile } from './plate.js';

export interface Left {
  /** Former grounds by their fills; the last one is the most recent. */
  grounds: ReadonlyMap<Fill, PlateLayer>;
  /** The last shape that came from a file. */
  shape?: Pick<Plate, 'shape' | 'width' | 'height'>;
}

export const nothingLeft: Left = { grounds: new Map() };

/** Files that directions can come from: the plate's own first, then those of former grounds, the most recent first. */
export function filesFor(plate: Plate, left: Left): SourceFile[] {
  const ground = groundOf(plate);
  return [...(ground === undefined ? [] : [ground]), ...[...left.grounds.values()].reverse()].flatMap(toldFrom);
}

/** Former values of a fill, provided that they come from this file or from none. */
export function leftOf(left: Left, fill: Fill, file: SourceFile | undefined): LayerValues | undefined {
  const before = left.grounds.get(fill);
  const files = before === undefined ? [] : toldFrom(before);
  return files.length === 0 || (file !== undefined && files.includes(file)) ? before : undefined;
}

/** Remembers the plate's ground before it is replaced. */
export function leaving(plate: Plate, left: Left): Left {
  const ground = groundOf(plate);
  const fill = ground && fillOf(ground);
  if (ground === undefined || fill === undefined) return left;
  const others = [...left.grounds].filter(([one]) => one !== fill);
  return { ...left, grounds: new Map([...others, [fill, ground.visible ? ground : { ...ground, visible: true }]]) };
}
