// Pictures of the layer kinds as small plates. The beads run in one direction, and in another where the layer lies.
import { svg, type SVGTemplateResult } from 'lit';
import type { LayerKind } from '../model/layers.js';

// Lengths are in units of the SVG view box: the size of the plate, the distance between beads, and the step at which a
// bead is tested for being inside.
const width = 60;
const height = 42;
const spacing = 2.3;
const step = 0.5;

type Inside = (x: number, y: number) => boolean;

const box =
  (left: number, top: number, right: number, bottom: number): Inside =>
  (x, y) =>
    x >= left && x <= right && y >= top && y <= bottom;

const disc =
  (cx: number, cy: number, radius: number): Inside =>
  (x, y) =>
    Math.hypot(x - cx, y - cy) <= radius;

const any =
  (...parts: readonly Inside[]): Inside =>
  (x, y) =>
    parts.some((part) => part(x, y));

/** Draws parallel beads at an angle [degrees] as an SVG path, and keeps the parts that lie inside. */
function hatch(angle: number, inside: Inside): string {
  const turn = (angle * Math.PI) / 180;
  const [c, s] = [Math.cos(turn), -Math.sin(turn)];
  const reach = Math.hypot(width, height) / 2;
  const parts: string[] = [];
  for (let row = -Math.ceil(reach / spacing); row * spacing <= reach; ++row) {
    let begun = false;
    let last = '';
    for (let along = -reach; along <= reach; along += step) {
      const x = width / 2 + along * c - row * spacing * s;
      const y = height / 2 + along * s + row * spacing * c;
      // The margin leaves room for half the width of a bead.
      const within = box(0.8, 0.8, width - 0.8, height - 0.8)(x, y) && inside(x, y);
      const place = `${x.toFixed(1)} ${y.toFixed(1)}`;
      if (within && !begun) parts.push(`M${place}`);
      else if (!within && begun) parts.push(`L${last}`);
      begun = within;
      last = place;
    }
    if (begun) parts.push(`L${last}`);
  }
  return parts.join('');
}

/** A capital A: all places near one of its three strokes. */
const letter: Inside = (x, y) => {
  const away = (ax: number, ay: number, bx: number, by: number): number => {
    const [dx, dy] = [bx - ax, by - ay];
    const share = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)));
    return Math.hypot(x - ax - share * dx, y - ay - share * dy);
  };
  return Math.min(away(19, 36, 30, 6), away(41, 36, 30, 6), away(23, 26, 37, 26)) <= 3.4;
};

/** This grid imitates a QR code: it has three finder squares and a few modules. */
const modules = ['1110111', '1010101', '1110111', '0001010', '1110110', '1010011', '1110101'];
const code: Inside = (x, y) => {
  const [column, row] = [Math.floor((x - 12) / 5.14), Math.floor((y - 3) / 5.14)];
  return modules[row]?.[column] === '1';
};

const star: Inside = (x, y) => {
  const [dx, dy] = [x - width / 2, y - height / 2 - 1];
  const angle = Math.atan2(dx, -dy);
  return Math.hypot(dx, dy) <= 13 + 6 * Math.cos(5 * angle);
};

/** A landscape of two hills. */
const hills: Inside = (x, y) => y > 31 - 13 * Math.exp(-(((x - 20) / 11) ** 2)) - 9 * Math.exp(-(((x - 44) / 9) ** 2));

// The rings are wider apart than other beads, so that the last of them just passes the plate's left and right edges.
const rings = Array.from({ length: 12 }, (_, k) => {
  const radius = 1.4 + k * spacing * 1.18;
  return `M${width / 2 + radius} ${height / 2}a${radius} ${radius} 0 1 0 ${-2 * radius} 0a${radius} ${radius} 0 1 0 ${2 * radius} 0`;
}).join('');

/** Short beads whose directions turn from left to right, as in a map. */
const fan = Array.from({ length: 11 * 7 }, (_, k) => {
  const [x, y] = [5 + (k % 11) * 5, 4.5 + Math.floor(k / 11) * 5.5];
  const angle = ((x + 0.6 * y) / width) * Math.PI;
  const [dx, dy] = [2.3 * Math.cos(angle), -2.3 * Math.sin(angle)];
  return `M${(x - dx).toFixed(1)} ${(y - dy).toFixed(1)}L${(x + dx).toFixed(1)} ${(y + dy).toFixed(1)}`;
}).join('');

interface Tile {
  below: string;
  above: string;
}

const over = (inside: Inside, angle: number, below = 0): Tile => ({
  below: hatch(below, (x, y) => !inside(x, y)),
  above: hatch(angle, inside),
});

const frame: Inside = (x, y) => !box(6.5, 6.5, width - 6.5, height - 6.5)(x, y);

const drawn: Record<LayerKind, () => Tile> = {
  text: () => over(letter, 90),
  picture: () => over(any(hills, disc(45, 12, 5)), 60, 150),
  drawing: () => over(star, 90),
  code: () => over(code, 90),
  pattern: () => ({ below: '', above: rings }),
  direction: () => over(box(16, 9, 44, 33), 45),
  border: () => ({
    below: hatch(0, (x, y) => !frame(x, y)),
    above: 'M1.5 1.5h57v39h-57zM4.1 4.1h51.8v33.8h-51.8z',
  }),
  map: () => ({ below: '', above: fan }),
  tones: () => over(any(hills, disc(45, 12, 5)), 90),
  strokes: () => over(disc(30, 21, 12), 60),
};

const made = new Map<LayerKind, Tile>();

/** Draws the picture of a layer kind. Its paths are computed only once. */
export function tile(kind: LayerKind): SVGTemplateResult {
  const { below, above } = made.get(kind) ?? drawn[kind]();
  made.set(kind, { below, above });
  return svg`<svg class="tile" viewBox="0 0 ${width} ${height}" fill="none"
    stroke="currentColor" stroke-linecap="round" aria-hidden="true" focusable="false">
    <path class="below" d=${below} /><path class="above" d=${above} />
  </svg>`;
}
