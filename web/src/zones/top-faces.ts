// Finds the level top faces of a body with their outlines. A plate's layers can lie on them.
import type { Mesh } from './mesh.js';

/** A level top face. Lengths are mm, places as in the body's file. */
export interface TopFace {
  z: number;
  areaMm2: number;
  /** Lower left corner of its bounding box; `size` is that of the box. */
  corner: [number, number];
  size: [number, number];
  /** Rings of the outline and of holes: x and y of each corner, from the lower left corner of the box. */
  rings: number[][];
}

const level = 1e-3; // [mm]; a triangle that rises less counts as level, as in the core
const weld = 1e3; // 1/mm; points within the same micrometre are merged
const leastArea = 25; // [mm²]; smaller faces have no room for a picture
const mostFaces = 40; // every card of the dialog draws all faces, so that their cost grows with the square

type Nine = [number, number, number, number, number, number, number, number, number];

const cornersAt = (mesh: Mesh, k: number): Nine => Array.from(mesh.subarray(k, k + 9)) as Nine;

/** Returns six times the volume of a body; negative if its triangles face inwards. Only the sign is used. */
function volumeOf(mesh: Mesh): number {
  let six = 0;
  for (let k = 0; k < mesh.length; k += 9) {
    const [ax, ay, az, bx, by, bz, cx, cy, cz] = cornersAt(mesh, k);
    six += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  }
  return six;
}

interface Triangle {
  /** Keys of the corners, counter-clockwise seen from above. */
  keys: [string, string, string];
  area: number;
  z: number;
}

type Point = readonly [number, number];

/** Disjoint sets with path halving (union-find), which group triangles into faces. */
class Parts {
  readonly #of: number[];
  constructor(count: number) {
    this.#of = Array.from({ length: count }, (_, k) => k);
  }
  rootOf(k: number): number {
    let at = k;
    while (this.#of[at] !== at) {
      this.#of[at] = this.#of[this.#of[at] as number] as number;
      at = this.#of[at] as number;
    }
    return at;
  }
  join(a: number, b: number): void {
    this.#of[this.rootOf(a)] = this.rootOf(b);
  }
}

const edgesOf = ({ keys: [a, b, c] }: Triangle): [string, string][] => [
  [a, b],
  [b, c],
  [c, a],
];

/** Rings of edges that belong to one triangle only, which bound the face. */
function ringsOf(triangles: readonly Triangle[]): string[][] {
  const edges = new Set(triangles.flatMap(edgesOf).map(([a, b]) => `${a} ${b}`));
  const from = new Map<string, string[]>();
  for (const [a, b] of triangles.flatMap(edgesOf)) {
    if (!edges.has(`${b} ${a}`)) from.set(a, [...(from.get(a) ?? []), b]);
  }
  const rings: string[][] = [];
  for (const begin of from.keys()) {
    for (let at = from.get(begin)?.pop(); at !== undefined; at = from.get(begin)?.pop()) {
      const ring = [begin];
      for (; at !== undefined && at !== begin; at = from.get(at)?.pop()) ring.push(at);
      if (ring.length >= 3) rings.push(ring);
    }
  }
  return rings;
}

/** Removes corners on straight lines, of which meshes are full. */
function straightened(ring: readonly Point[]): Point[] {
  return ring.filter(([x, y], k) => {
    const [ax, ay] = ring.at(k - 1) as Point;
    const [bx, by] = ring[(k + 1) % ring.length] as Point;
    const off = Math.abs((x - ax) * (by - ay) - (y - ay) * (bx - ax));
    return off > 1e-6 * Math.max(1, Math.hypot(bx - ax, by - ay));
  });
}

/** A face with its outline, from connected triangles. */
function faceOf(triangles: readonly Triangle[], points: ReadonlyMap<string, Point>): TopFace {
  const rings = ringsOf(triangles).map((ring) => straightened(ring.map((key) => points.get(key) as Point)));
  const whole = rings.filter(({ length }) => length >= 3);
  const all = whole.flat();
  const range = (axis: 0 | 1): [number, number] => {
    const values = all.map((point) => point[axis]);
    return [values.reduce((a, b) => Math.min(a, b), Infinity), values.reduce((a, b) => Math.max(a, b), -Infinity)];
  };
  const [[left, right], [bottom, top]] = [range(0), range(1)];
  return {
    z: triangles[0]?.z ?? 0,
    areaMm2: triangles.reduce((sum, { area }) => sum + area, 0),
    corner: [left, bottom],
    size: [right - left, top - bottom],
    rings: whole.map((ring) => ring.flatMap(([x, y]) => [x - left, y - bottom])),
  };
}

/** The level top faces of a body, the largest first; those too small for a picture are left out. */
export function topFaces(mesh: Mesh): TopFace[] {
  const outwards = volumeOf(mesh) < 0 ? -1 : 1;
  const points = new Map<string, Point>();
  const triangles: Triangle[] = [];
  for (let k = 0; k < mesh.length; k += 9) {
    const [ax, ay, az, bx, by, bz, cx, cy, cz] = cornersAt(mesh, k);
    const up = outwards * ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax));
    if (!(up > 0) || Math.max(az, bz, cz) - Math.min(az, bz, cz) > level) continue;
    const keyOf = (x: number, y: number, z: number): string => {
      const key = [x, y, z].map((value) => Math.round(weld * value)).join();
      if (!points.has(key)) points.set(key, [Math.round(weld * x) / weld, Math.round(weld * y) / weld]);
      return key;
    };
    const keys: Triangle['keys'] = [keyOf(ax, ay, az), keyOf(bx, by, bz), keyOf(cx, cy, cz)];
    if (outwards < 0) keys.reverse();
    triangles.push({ keys, area: up / 2, z: Math.max(az, bz, cz) });
  }
  const parts = new Parts(triangles.length);
  const at = new Map<string, number>();
  for (const [k, triangle] of triangles.entries()) {
    for (const [a, b] of edgesOf(triangle)) {
      const edge = a < b ? `${a} ${b}` : `${b} ${a}`;
      const other = at.get(edge);
      if (other === undefined) at.set(edge, k);
      else parts.join(k, other);
    }
  }
  const groups = new Map<number, Triangle[]>();
  for (const [k, triangle] of triangles.entries()) {
    const group = groups.get(parts.rootOf(k));
    if (group === undefined) groups.set(parts.rootOf(k), [triangle]);
    else group.push(triangle);
  }
  return [...groups.values()]
    .filter((group) => group.reduce((sum, { area }) => sum + area, 0) >= leastArea)
    .map((group) => faceOf(group, points))
    .filter(({ rings }) => rings.length > 0)
    .sort((a, b) => b.areaMm2 - a.areaMm2 || b.z - a.z)
    .slice(0, mostFaces);
}

const short = (value: number): string => String(Number(value.toFixed(3)));

/** The outline as an SVG path, whose y axis points down. The second parameter is an offset [mm]. */
export const pathOf = ({ rings, size }: TopFace, [dx, dy]: readonly [number, number] = [0, 0]): string =>
  rings
    .map((ring) => {
      const corners = Array.from({ length: ring.length / 2 }, (_, k) => [
        (ring[2 * k] as number) + dx,
        size[1] - (ring[2 * k + 1] as number) + dy,
      ]);
      return `M${corners.map((corner) => corner.map(short).join(' ')).join('L')}Z`;
    })
    .join('');

/** The face as an SVG drawing in millimetres. */
export function drawingOf(face: TopFace): string {
  const [width, height] = face.size.map(short);
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width}mm" height="${height}mm" viewBox="0 0 ${width} ${height}">` +
    `<path fill-rule="evenodd" d="${pathOf(face)}"/></svg>`
  );
}
