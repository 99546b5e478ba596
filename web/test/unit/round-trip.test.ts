// A project goes from the command line into the studio and back: each setting of the core's table is still what it was.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, test } from 'node:test';
import { unzipSync } from 'fflate';
import { createEngine, type Engine } from 'sillon';
import { readProject, writeProject } from '../../src/files/project.js';
import { sourceFile } from '../../src/files/source-file.js';
import type { SourceFile } from '../../src/model/plate.js';

const program = resolve('build/release/sillon');
const folder = mkdtempSync(join(tmpdir(), 'sillon-round-'));

let engine: Engine;
let files: SourceFile[];
before(async () => {
  engine = await createEngine({ threads: 'off' });
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="20" height="16"><path d="M1 1H19V15H1Z"/></svg>`;
  const picture = (name: string): Promise<SourceFile> =>
    sourceFile(name, new Uint8Array(readFileSync(`examples/inputs/${name}`)));
  files = await Promise.all([
    sourceFile('leaf.svg', new TextEncoder().encode(svg)),
    ...['logo_angle.png', 'logo_mode.png', 'moon.png', 'sun.png'].map(picture),
  ]);
  for (const { name, bytes } of files) writeFileSync(join(folder, name), new Uint8Array(await bytes.arrayBuffer()));
});
after(() => {
  engine.dispose();
  rmSync(folder, { recursive: true });
});

type Section = Record<string, unknown>;
type Sections = Record<string, Section>;
type Completed = Sections & { layers: Section[] };

interface Row {
  section: string;
  key: string;
  type: string;
  default?: unknown;
  low?: number;
  high?: number;
  choices?: string[];
  /** Kinds of layers that have it; left out: all. */
  kinds?: string[];
}

const run = (...words: string[]): string => {
  const { status, stdout, stderr } = spawnSync(program, words, { cwd: folder, encoding: 'utf8' });
  assert.equal(status, 0, `${words.join(' ')}: ${stderr}`);
  return stdout;
};

/** The project with every field, as the command line writes it. */
function completed(path: string): Completed {
  const out = `${path}.full.json`;
  run('generate', path, '--project', out, '--quiet');
  const { layers = [{ kind: 'direction' }], ...said } = JSON.parse(
    readFileSync(join(folder, out), 'utf8'),
  ) as Sections & {
    layers?: Section[];
  };
  return { ...said, layers } as Completed; // without layers beads lie at 0°
}

/** Another value of a setting. What rules between settings, and a quick test, ask for stands in `chosen`. */
function another({ section, key, type, default: usual, low = 0, high = 0, choices = [] }: Row): unknown {
  const one = (from: unknown): number => {
    const number = typeof from === 'number' ? from : low;
    const moved = number + (number === high ? low - high : high - number) / 10;
    return type.startsWith('integer') ? Math.ceil(moved) : moved;
  };
  switch (type) {
    case 'number':
    case 'integer':
      return one(usual);
    case 'pair':
    case 'integer pair':
      return Array.isArray(usual) ? usual.map(one) : [one(low), one(one(low))];
    case 'choice':
      return choices.find((choice) => choice !== usual);
    case 'flag':
      return usual !== true;
    case 'text':
      return `another ${key}`;
    case 'block':
      return 'G28 ; home\nG1 Z5 F600\n';
  }
  return assert.fail(`${section}.${key} is of type ${type}, which this test does not know`);
}

const chosen: Sections = {
  toolpath: { seed: 12345, sweepsPerLevel: 9, relaxationRounds: 3, spacing: 1.25, preset: 'fine' },
  print: { layers: 2, base: 3, coast: 0, startHeight: 1.5, place: [3.5, 4.25] },
  printer: { profile: 'prusa-mk4s', filament: 'petg', screenSizes: '48x48', speed: 61.5, roundBed: false },
};

/** Sections that exclude each other are spread over several projects. */
const projects: Record<string, Sections> = {
  drawing: {
    shape: { file: 'leaf.svg', pageWidth: 22.5, unitless: 'mm', paint: 'shown', keepThin: true, radius: 2.5 },
    print: { coast: 0.5, scarf: 0 },
    printer: { bedMin: [0, 0], bedMax: [300, 300], roundBed: true },
  },
  layered: { shape: { builtin: 'rectangle', size: [24, 18.5] } },
  outlines: { shape: { file: 'leaf.svg', pageWidth: 22.5, unitless: 'px', paint: 'ignore' } },
  rounded: {
    shape: { builtin: 'rounded', size: [24, 18.5], radius: 2.5, keepThin: true },
  },
  star: {
    shape: {
      builtin: 'star',
      size: [24, 18.5],
      points: 7,
      radius: 0.5,
      corners: 'chamfer',
      offset: 1.5,
      holes: [{ x: 13.5, y: 10, diameter: 2 }],
    },
  },
  letters: { shape: { builtin: 'text', size: [24, 18.5], text: 'Ab', font: 'Bebas Neue', weight: 300 } },
  ring: { shape: { builtin: 'ring', size: [24, 24], inner: 9.5 } },
  pictures: { shape: { builtin: 'rectangle', size: [24, 18.5] } },
};

const pictures = [
  { file: 'moon.png', lamp: [60.5, 35] },
  { file: 'sun.png', lamp: null },
];

/** The lowest layer of a project. */
const lowest: Record<string, Section> = {
  drawing: { kind: 'map', file: 'logo_angle.png', encoding: 'rotation', modeFile: 'logo_mode.png', mode: 'smoothest' },
  layered: { kind: 'direction', angle: 12.5 },
  rounded: { kind: 'direction', angle: 33.3, mode: 'smoothest' },
  pictures: { kind: 'picture', pictures },
};

/** Values of the layers over it, in the project `layered`; they have others of their kinds, too. They are not seen: what counts is
 * that the values come back. */
const above: Section[] = [
  { kind: 'direction' },
  { kind: 'map', file: 'moon.png' },
  { kind: 'picture', pictures },
  { kind: 'text' },
  { kind: 'code' },
  { kind: 'pattern', file: 'leaf.svg', seed: 12345 },
  { kind: 'tones', file: 'moon.png', colours: [{ colour: '#00ff7f', angle: 30.5 }] },
  { kind: 'drawing', file: 'leaf.svg' },
  { kind: 'border' },
  { kind: 'strokes', strokes: [{ tool: 'mode', radius: 2, soft: 0.25, mode: 'parallel', points: [1, 2, 3.5, 4] }] },
];

/** The layer with every value that its kind has. */
function filled(layer: Section, rows: readonly Row[]): Section {
  const given: Section = { maskFile: 'leaf.svg', modeFile: 'logo_mode.png', font: 'Caveat', ...layer };
  const own = rows.filter(({ kinds }) => kinds?.includes(String(layer['kind'])) ?? true);
  return Object.fromEntries(own.map((row) => [row.key, given[row.key] ?? another(row)]));
}

/** Without the studio's own section; files lie elsewhere. */
function compared({ studio: _, ...sections }: Completed): unknown {
  return JSON.parse(JSON.stringify(sections), (key, value: unknown) =>
    ['file', 'maskFile', 'modeFile'].includes(key) && typeof value === 'string' ? value.split('/').at(-1) : value,
  );
}

/** Layers stand in a list, with what differs from the defaults. */
const valuesIn = (project: Completed, section: string, key: string): unknown[] =>
  section === 'layers'
    ? project.layers.filter((layer) => key in layer).map((layer) => layer[key])
    : [project[section]?.[key]];

/** Sends a project to the studio and back. @returns the settings that it has off their defaults */
async function there(name: string, sections: Sections, settings: readonly Row[]): Promise<string[]> {
  const asked: Sections = {};
  for (const row of settings) {
    const { section, key } = row;
    if (section === 'layers') continue;
    const own = sections[section]?.[key] ?? chosen[section]?.[key];
    if (own !== undefined || section !== 'shape') (asked[section] ??= {})[key] = own ?? another(row);
  }
  const path = `${name}.json`;
  const rows = settings.filter(({ section }) => section === 'layers');
  const over = name === 'layered' ? above.map((layer) => filled(layer, rows)) : [];
  const layers = [...(lowest[name] === undefined ? [] : [lowest[name]]), ...over];
  const text = JSON.stringify({ sillon: 1, ...asked, ...(layers.length > 0 && { layers }) });
  writeFileSync(join(folder, path), text);
  const before = completed(path);

  const plate = await readProject(await sourceFile(path, new TextEncoder().encode(text)), files, engine);
  const zip = new Uint8Array(await (await writeProject(plate)).arrayBuffer());
  for (const [file, bytes] of Object.entries(unzipSync(zip))) {
    const place = join(folder, name, file);
    mkdirSync(dirname(place), { recursive: true });
    writeFileSync(place, bytes);
  }
  const back = completed(join(name, 'project.json'));
  assert.deepEqual(compared(back), compared(before), name);
  assert.equal(back['studio']?.['name'], name); // the command line has left the studio's section as it was

  // A preset is but its values.
  const isOff = ({ section, key, default: usual }: Row): boolean =>
    (section === 'layers' || asked[section]?.[key] !== undefined) &&
    valuesIn(before, section, key).some(
      (value) => JSON.stringify(value) !== JSON.stringify(usual) || usual === undefined,
    );
  return settings.filter(isOff).map(({ section, key }) => `${section}.${key}`);
}

test('every setting off its default is the same after the command line, the studio and the command line', async () => {
  const { settings } = JSON.parse(run('settings', '--json')) as { settings: Row[] };
  const changed = new Set<string>();
  for (const [name, sections] of Object.entries(projects)) {
    for (const id of await there(name, sections, settings)) changed.add(id);
  }
  const left = settings.map(({ section, key }) => `${section}.${key}`).filter((id) => !changed.has(id));
  assert.deepEqual(left, [], 'left at their defaults');
});
