// Which of the page's modules are fetched together: few files, and none that only another part of the page needs.
import { fileURLToPath } from 'node:url';

const page = fileURLToPath(new URL('src/app/main.ts', import.meta.url));

/** Parts that are fetched later, by the room that they belong to: the first that fits. */
const rooms = [
  ['shimmer', /\/app\/shimmer\.ts$/],
  ['engine', /\/wasm\/dist\/index\.js$/],
  // What every visit asks for once its first view is there.
  [
    'first',
    /\/(app\/(example-layers|offline|own-pictures|plate-facts|sheet)|engine\/layer-boxes|files\/(autosave|drawn|handed)|layers\/(add-layer|layers-panel|shape-room|stage)|plates\/examples|print\/downloads|quality\/legend|stage\/(looks-bar|player|view-options)|views\/(fields|miniature))\.ts$/,
  ],
  ['problem', /\/i18n\/say-problem\.ts$/],
  ['calibrate', /\/src\/calibrate\/|\/files\/photo\.ts$/],
  ['files', /\/src\/files\/|\/app\/(take-in|drop-targets|tell-opened|pick-sliced)\.ts$|\/plates\/links\.ts$/],
  ['shape', /\/src\/shape\//],
  ['print', /\/src\/print\/|\/app\/(printer-sheet|lamp-card)\.ts$/],
  // A visitor's answer is asked for before anything is shown.
  ['own', /\/model\/own-print\.ts$/],
  ['quality', /\/src\/(quality|views)\//],
  ['rebrush', /\/src\/(rebrush|zones)\//],
  ['frame', /\/src\/embed\/|\/app\/framing\.ts$/],
  ['plates', /\/src\/plates\//],
  ['more', /./],
];
/** Rooms whose modules others use as well, and the chunk that these are in then. */
const common = { shimmer: 'first', engine: 'first', first: 'first', problem: 'problem' };

const roomOf = (part) =>
  /\/i18n\/(\w\w)\.ts$/.exec(part)?.[1] ?? // a language
  rooms.find(([, parts]) => parts.test(part))[0];

/** All that a module imports without being asked, itself among them. */
function reach(graph, id, found = new Set()) {
  if (found.has(id)) return found;
  found.add(id);
  for (const next of graph.getModuleInfo(id)?.importedIds ?? []) reach(graph, next, found);
  return found;
}

/** Modules that are imported when they are asked for, wherever that is. */
function lazyParts(graph, id, found = new Set()) {
  for (const one of reach(graph, id)) {
    for (const part of graph.getModuleInfo(one)?.dynamicallyImportedIds ?? []) {
      if (found.has(part)) continue;
      found.add(part);
      lazyParts(graph, part, found);
    }
  }
  return found;
}

/** @returns names of chunks by module. What a first view needs is one chunk, and what one room alone needs is that room's, so
 * that no two chunks need each other. */
function chunksOf(graph) {
  const users = new Map();
  for (const part of lazyParts(graph, page)) {
    const room = roomOf(part);
    for (const id of reach(graph, part)) users.set(id, (users.get(id) ?? new Set()).add(room));
  }
  const chunks = new Map();
  for (const [id, by] of users) {
    const [only] = by;
    const room = Object.keys(common).find((room) => by.has(room));
    chunks.set(id, by.size === 1 ? only : (common[room] ?? 'shared'));
  }
  for (const id of reach(graph, page)) chunks.set(id, 'studio');
  return chunks;
}

let chunks;

/** @returns null: a file of its own, as it comes */
export const chunkOf = (id, graph) => (chunks ??= chunksOf(graph)).get(id) ?? null;
