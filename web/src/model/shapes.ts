// The built-in shapes, and holes that objects often need.
import type { BuiltinShape, RoundHole } from 'sillon';
import { newShape } from './defaults.js';
import { isRoundKind, pageOf, type Plate, type ShapeSource } from './plate.js';

/** Names of the shapes, in the order of the panel. */
export const builtinShapes = [
  'disc',
  'rectangle',
  'rounded',
  'hexagon',
  'heart',
  'shield',
  'star',
  'ring',
  'tag',
  'text',
] as const satisfies readonly BuiltinShape[];

/** Heights as shares of the widths, which the engine uses where it is given no height. */
export const ownHeight: Partial<Record<ShapeSource['kind'], number>> = {
  hexagon: Math.sqrt(3) / 2,
  heart: 0.914214,
  shield: 1.199359,
  star: 0.951057,
  tag: 0.4,
  text: 0.3, // height of the text's page; the letters keep their own proportions
};

const hundredth = (value: number): number => Math.round(value * 100) / 100;

/** Gives the plate another shape, in that shape's own proportions where it has any. Holes are dropped, since they
 * may lie outside. */
export function withShape(plate: Plate, kind: BuiltinShape): Plate {
  const { width, shape: before } = plate;
  const height = plate.height || width;
  const shape = { ...newShape(kind), offset: before.offset };
  const longest = Math.max(width, height);
  if (isRoundKind(kind)) {
    const side = ownHeight[before.kind] === undefined ? Math.min(width, height) : longest;
    return { ...plate, shape, width: side, height: side };
  }
  const share = ownHeight[kind];
  if (share === undefined) return { ...plate, shape };
  return share > 1
    ? { ...plate, shape, width: hundredth(longest / share), height: longest }
    : { ...plate, shape, width: longest, height: hundredth(longest * share) };
}

/** Diameters of holes [mm]: for an M4 screw, a key ring, and a magnet of 8 mm. */
export const usualHoles = { screw: 4.5, keyring: 5, magnet: 8.2 } as const;
export type HoleName = keyof typeof usualHoles;

const wall = 4; // [mm] between a key ring's hole and the upper edge of the page

/** The likely place for a new hole: near the upper edge for a key ring, otherwise in the middle. */
function placeFor(plate: Plate, name: HoleName): Pick<RoundHole, 'x' | 'y'> {
  const [width, height] = pageOf(plate);
  const { shape } = plate;
  const y = name === 'keyring' ? Math.max(height / 2, height - wall - usualHoles.keyring / 2) : height / 2;
  if (shape.kind !== 'ring') return { x: hundredth(width / 2), y: hundredth(y) };
  // The middle of a ring is empty, so the hole goes into the ring itself.
  const solid = (plate.width - (shape.inner || plate.width / 2)) / 2;
  return { x: hundredth(width / 2), y: hundredth(height - Math.max(0, shape.offset) - solid / 2) };
}

/** Adds a hole at its likely place. */
export const withHole = (plate: Plate, name: HoleName): Plate => ({
  ...plate,
  shape: {
    ...plate.shape,
    holes: [...plate.shape.holes, { ...placeFor(plate, name), diameter: usualHoles[name] }],
  },
});
