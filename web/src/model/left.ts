// What a plate was made of before another card was tried: to come back to it asks for no file again.
import { fillOf, groundOf, toldFrom, type Fill } from './fills.js';
import type { LayerValues } from './layers.js';
import type { Plate, PlateLayer, SourceFile } from './plate.js';

export interface Left {
  /** The latest last. */
  grounds: ReadonlyMap<Fill, PlateLayer>;
  /** From a file. */
  shape?: Pick<Plate, 'shape' | 'width' | 'height'>;
}

export const nothingLeft: Left = { grounds: new Map() };

/** What directions can be told from: the plate's own file, else that which was left last. */
export function filesFor(plate: Plate, left: Left): SourceFile[] {
  const ground = groundOf(plate);
  return [...(ground === undefined ? [] : [ground]), ...[...left.grounds.values()].reverse()].flatMap(toldFrom);
}

/** The values of a fill that was left, as far as they are of this file. */
export function leftOf(left: Left, fill: Fill, file: SourceFile | undefined): LayerValues | undefined {
  const before = left.grounds.get(fill);
  const files = before === undefined ? [] : toldFrom(before);
  return files.length === 0 || (file !== undefined && files.includes(file)) ? before : undefined;
}

export function leaving(plate: Plate, left: Left): Left {
  const ground = groundOf(plate);
  const fill = ground && fillOf(ground);
  if (ground === undefined || fill === undefined) return left;
  const others = [...left.grounds].filter(([one]) => one !== fill);
  return { ...left, grounds: new Map([...others, [fill, ground.visible ? ground : { ...ground, visible: true }]]) };
}
