// The rooms of core and what they include, read from the sources: a drawing of it for docs/internals/rooms.md.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';

/** Room -> rooms that its files include, besides itself. */
export function includesOfRooms(root) {
  const rooms = new Map();
  for (const base of ['core/include/sillon', 'core/src']) {
    for (const entry of readdirSync(join(root, base), { recursive: true, withFileTypes: true })) {
      if (!/\.[ch]pp$/.test(entry.name)) continue;
      const folder = entry.parentPath ?? entry.path;
      const [room] = folder.slice(join(root, base).length + 1).split('/');
      if (room === '') continue; // sillon.hpp, which includes all
      if (!rooms.has(room)) rooms.set(room, new Set());
      const text = readFileSync(join(folder, entry.name), 'utf8');
      for (const [, included] of text.matchAll(/^\s*#\s*include "(?:sillon\/)?(\w+)\//gm)) {
        if (included !== room) rooms.get(room).add(included);
      }
    }
  }
  return rooms;
}

/** How many steps it is down to a room that includes none; throws where includes go round in a circle. */
function levelsOf(rooms) {
  const levels = new Map();
  const level = (room, above) => {
    if (above.includes(room)) throw new Error(`rooms include each other: ${[...above, room].join(' -> ')}`);
    if (!levels.has(room)) {
      const below = [...rooms.get(room)].map((other) => level(other, [...above, room]));
      levels.set(room, below.length === 0 ? 0 : 1 + Math.max(...below));
    }
    return levels.get(room);
  };
  for (const room of rooms.keys()) level(room, []);
  return levels;
}

/** Without the includes that follow from others: a -> c where a -> b and b -> c. */
function essential(rooms) {
  const reached = (room) => new Set([...rooms.get(room)].flatMap((other) => [other, ...reached(other)]));
  const kept = new Map();
  for (const [room, included] of rooms) {
    kept.set(
      room,
      [...included].filter((one) => ![...included].some((other) => other !== one && reached(other).has(one))).sort(),
    );
  }
  return kept;
}

const wide = 128;
const high = 34;
const columns = 168;
const rows = 74;
const margin = 14;

export function drawRooms(root) {
  const rooms = includesOfRooms(root);
  const levels = levelsOf(rooms);
  const arrows = essential(rooms);
  const top = Math.max(...levels.values());

  // An arrow over several levels takes a place on each of them, so that it passes between the rooms.
  const chains = [...arrows].flatMap(([room, included]) =>
    included.map((other) => {
      const between = Array.from({ length: levels.get(room) - levels.get(other) - 1 }, (_, k) => ({
        name: `${room} > ${other}`,
        level: levels.get(room) - 1 - k,
        room: false,
      }));
      return [room, ...between, other];
    }),
  );
  const places = [...rooms.keys()].map((name) => ({ name, level: levels.get(name), room: true }));
  const placeOf = new Map(places.map((place) => [place.name, place]));
  const below = new Map();
  for (const chain of chains) {
    const way = chain.map((step) => placeOf.get(step) ?? step);
    way.slice(0, -1).forEach((place, k) => below.set(place, [...(below.get(place) ?? []), way[k + 1]]));
    places.push(...way.filter(({ room }) => !room));
  }

  // Above the middle of what it leads to, a column apart from the others of its level.
  const at = new Map();
  for (let level = 0; level <= top; ++level) {
    const row = places.filter((place) => place.level === level);
    const wanted = (place) => {
      const to = (below.get(place) ?? []).map((other) => at.get(other));
      return to.length === 0 ? 0 : to.reduce((sum, one) => sum + one, 0) / to.length;
    };
    row.sort((one, other) => wanted(one) - wanted(other) || (one.name < other.name ? -1 : 1));
    const middle = row.reduce((sum, place) => sum + wanted(place), 0) / row.length;
    const width = (place) => (place.room ? 1 : 0.3);
    let edge = middle - row.reduce((sum, place) => sum + width(place), 0) / 2;
    for (const place of row) {
      at.set(place, edge + width(place) / 2);
      edge += width(place);
    }
  }
  const left = Math.min(...at.values());
  const x = (place) => margin + wide / 2 + (at.get(place) - left) * columns;
  const y = ({ level }) => margin + (top - level) * rows;
  const width = 2 * margin + wide + (Math.max(...at.values()) - left) * columns;
  const height = 2 * margin + high + top * rows;

  const lines = chains.map((chain) => {
    const way = chain.map((step) => placeOf.get(step) ?? step);
    const end = way.at(-1);
    const lean = (place, to) => Math.max(-1, Math.min(1, at.get(to) - at.get(place))) * wide * 0.3;
    let path = `M${(x(way[0]) + lean(way[0], way[1])).toFixed(1)} ${y(way[0]) + high}`;
    for (let k = 1; k < way.length; ++k) {
      const fromX = k === 1 ? x(way[0]) + lean(way[0], way[1]) : x(way[k - 1]);
      const toX = way[k] === end ? x(end) + lean(end, way[k - 1]) : x(way[k]);
      const [fromY, toY] = [y(way[k - 1]) + high, y(way[k]) - (way[k] === end ? 7 : 0)];
      const bend = (toY - fromY) / 2;
      path += `C${fromX.toFixed(1)} ${fromY + bend} ${toX.toFixed(1)} ${toY - bend} ${toX.toFixed(1)} ${toY}`;
      if (way[k] !== end) path += `v${high}`;
    }
    return `  <path d="${path}"/>`;
  });
  const boxes = [...placeOf.values()]
    .sort((one, other) => (one.name < other.name ? -1 : 1))
    .map(
      (
        place,
      ) => `  <rect x="${(x(place) - wide / 2).toFixed(1)}" y="${y(place)}" width="${wide}" height="${high}" rx="8"/>
  <text x="${x(place).toFixed(1)}" y="${y(place) + 22}">${place.name}</text>`,
    );
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${Math.round(width)} ${Math.round(height)}" width="${Math.round(width)}" height="${Math.round(height)}">
<!-- Made by tools/generate.mjs from the includes of core: ./dev generate. -->
<style>
  rect { fill: #f4f1ec; stroke: #8a8278; }
  text { font: 14px system-ui, sans-serif; fill: #23201c; text-anchor: middle; }
  path { fill: none; stroke: #8a8278; stroke-width: 1.5; marker-end: url(#head); }
  marker path { fill: #8a8278; stroke: none; }
  @media (prefers-color-scheme: dark) {
    rect { fill: #2a2723; }
    text { fill: #eee9e1; }
  }
</style>
<marker id="head" viewBox="0 0 8 8" refX="1" refY="4" markerWidth="6" markerHeight="6" orient="auto"><path d="M0 0 8 4 0 8z"/></marker>
${lines.join('\n')}
${boxes.join('\n')}
</svg>
`;
}
