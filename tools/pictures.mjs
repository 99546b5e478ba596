// ./dev pictures draws every picture of README and docs that comes from the program, so that pages show what it makes today.
// site/test/pictures.test.mjs fails where a picture is old.
//   node tools/pictures.mjs [FOLDER]   into docs/pictures, unless another folder is named
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

import { strFromU8, unzipSync } from 'fflate';

const root = fileURLToPath(new URL('..', import.meta.url));

/** Runs a program of the build, at the root of the source. */
const run = (program, args) =>
  execFileSync(join(root, 'build/release', program), args, { cwd: root, stdio: ['ignore', 'ignore', 'inherit'] });

export const scratch = mkdtempSync(join(tmpdir(), 'sillon-pictures-'));
process.on('exit', () => rmSync(scratch, { recursive: true, force: true }));

/** Gives the words of a command, and its layers from the bottom to the top. */
const args = (line, ...layers) => [
  ...line.split(' '),
  ...layers.flatMap((layer) => ['--layer', JSON.stringify(layer)]),
];

/** A command of sillon draws its preview: two panels as PNG, a loop of moving light as WebP. */
const preview = (name, width, line, ...layers) => ({
  names: [name],
  draw: (folder) =>
    run('sillon', [
      ...args(line, ...layers),
      ...(line.startsWith('generate') ? [] : ['-o', join(scratch, 'beside.gcode')]), // others need an output
      ...['--preview', join(folder, name), '--preview-width', `${width}`],
    ]),
});

export const plate = (name, width, line, ...layers) => preview(name, width, `generate --quiet ${line}`, ...layers);

/** The ground is that of previews, so that an SVG [mm] can be read on light and on dark pages. */
const drawing = (width, height, parts, scale = 4) =>
  `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${scale * width}" height="${scale * height}" ` +
  `font-family="sans-serif" font-size="4" text-anchor="middle" fill="#d8d4cc">\n` +
  `<rect width="${width}" height="${height}" fill="#262422"/>\n${parts.join('\n')}\n</svg>\n`;

/** Gives the toolpath of a plate as points, and its page, in twentieths of a millimetre: finer steps are not seen. */
function pathOf(line) {
  const file = join(scratch, 'path.svg');
  run('sillon', [...args(`generate --quiet ${line}`), '--svg', file]);
  const drawn = readFileSync(file, 'utf8');
  const numbers = (text) => (text.match(/-?[\d.]+/g) ?? []).map(Number);
  const points = [];
  for (const [, start, steps] of drawn.matchAll(/class="nozzle"[^>]* d="M([^l]*)([^"]*)"/g)) {
    let [x, y] = numbers(start);
    const way = numbers(steps);
    for (let k = 0; k < way.length; k += 2) {
      x += way[k];
      y += way[k + 1];
      points.push([Math.round(20 * x), Math.round(20 * y)]);
    }
  }
  const page = /viewBox="0 0 ([\d.]+) ([\d.]+)"/
    .exec(drawn)
    .slice(1)
    .map((side) => 20 * Number(side));
  return { page, points };
}

/** Gives path data in relative steps, which take fewer bytes. */
const lineOf = (points) =>
  `m${points.map(([x, y], k) => (k === 0 ? `${x} ${y}` : `${x - points[k - 1][0]} ${y - points[k - 1][1]}`)).join(' ')}`.replaceAll(
    ' -',
    '-',
  );

const cell = 42; // [mm] of a plate in a row of several

/** Plates stand in rows, with a word below each.
 * @param inside  gives what is drawn of a path's points @param scale  pixels of a millimetre */
const row = (name, columns, plates, inside, scale) => ({
  names: [name],
  draw(folder) {
    const foot = 7; // [mm]
    const parts = plates.map(({ word, line }, k) => {
      const { page, points } = pathOf(line);
      const [x, y] = [(k % columns) * cell, Math.floor(k / columns) * (cell + foot)];
      const box = `x="${x + 3}" y="${y + 3}" width="${cell - 6}" height="${cell - 6}" viewBox="0 0 ${page.join(' ')}"`;
      const label = `<text x="${x + cell / 2}" y="${y + cell + 3}">${word}</text>`;
      return `<svg ${box} fill="none" stroke-linejoin="round">\n${inside(points)}\n</svg>\n${label}`;
    });
    const height = Math.ceil(plates.length / columns) * (cell + foot);
    writeFileSync(join(folder, name), drawing(columns * cell, height, parts, scale));
  },
});

const inGold = (points) => `<path d="${lineOf(points)}z" stroke="#e0b060" stroke-width="15"/>`;

/** Colours go through the rainbow once, from the beginning of the path to its end. */
function inOrder(points) {
  const pieces = 90;
  const ways = [0];
  for (let k = 1; k < points.length; ++k)
    ways.push(ways[k - 1] + Math.hypot(points[k][0] - points[k - 1][0], points[k][1] - points[k - 1][1]));
  const at = (k) => ways.findIndex((way) => way >= (k / pieces) * ways.at(-1));
  return Array.from({ length: pieces }, (_, k) => {
    const colour = `hsl(${Math.round((300 * k) / pieces)} 85% 55%)`;
    return `<path d="${lineOf(points.slice(at(k), at(k + 1) + 1))}" stroke="${colour}" stroke-width="13"/>`;
  }).join('\n');
}

/** Zones lie on the top of their body, and are hatched as a slicer lays its lines. */
const zones = (name, side, line, ...layers) => ({
  names: [name],
  draw(folder) {
    const file = join(scratch, 'zones.3mf');
    run('sillon', [...args(`zones ${line}`, ...layers), '-o', file]);
    const parts = unzipSync(readFileSync(file));
    const model = strFromU8(parts['3D/3dmodel.model']);
    const points = [...model.matchAll(/<vertex x="([^"]+)" y="([^"]+)" z="([^"]+)"/g)].map(([, ...at]) =>
      at.map(Number),
    );
    const triangles = [...model.matchAll(/<triangle v1="(\d+)" v2="(\d+)" v3="(\d+)"/g)].map(
      ([, ...corners]) => corners,
    );
    const volumes = strFromU8(parts['Metadata/Slic3r_PE_model.config']).matchAll(
      /<volume firstid="(\d+)" lastid="(\d+)">(.*?)<\/volume>/gs,
    );
    const [left, top] = [108 - side / 2, 112 + side / 2]; // zones stand around 110, 110
    const topOf = (first, last) => {
      const own = triangles.slice(Number(first), Number(last) + 1).map((corners) => corners.map((k) => points[k]));
      const height = Math.max(...own.flat().map(([, , z]) => z));
      return own
        .filter((corners) => corners.every(([, , z]) => z === height))
        .map((corners) => `M${corners.map(([x, y]) => `${(x - left).toFixed(2)} ${(top - y).toFixed(2)}`).join('L')}Z`)
        .join('');
    };
    const drawn = ['</g>'];
    for (const [, first, last, settings] of volumes) {
      const angle = /key="fill_angle" value="([^"]+)"/.exec(settings)?.[1];
      if (angle === undefined) {
        // This is the body, and zones reach beyond it.
        drawn.unshift(`<clipPath id="body"><path d="${topOf(first, last)}"/></clipPath>`, '<g clip-path="url(#body)">');
        continue;
      }
      const [id, colour] = [`zone${drawn.length}`, `hsl(${Math.round(Number(angle) * 2)} 45% 62%)`];
      drawn.splice(
        -1,
        0,
        `<pattern id="${id}" width="1.2" height="1.2" patternUnits="userSpaceOnUse" patternTransform="rotate(${-angle})">` +
          `<rect width="1.2" height="1.2" fill="#262422"/><rect width="1.2" height="0.9" fill="${colour}"/></pattern>` +
          `<path d="${topOf(first, last)}" fill="url(#${id})"/>`,
      );
    }
    writeFileSync(join(folder, name), drawing(side + 4, side + 4, drawn));
  },
});

const shapeNames = ['rounded', 'disc', 'hexagon', 'heart', 'shield', 'star', 'ring', 'tag', 'rectangle'];
const stageNames = [
  ...['shape', 'distance', 'asked', 'lines', 'waves', 'phases'],
  ...['field', 'contour', 'stitched', 'relaxed', 'widths', 'look'],
];
const disc = '--shape disc --size 36 --spool goldPla';
const two = (first, second) =>
  `--shape disc --size 80 --picture examples/inputs/${first} --lamp 70 --picture examples/inputs/${second} --lamp 110`;
export const sunMoon = two('sun.png', 'moon.png');
export const wave = 'examples/paper/wave.json --spool goldPla';
const rings = { kind: 'pattern', angle: 90 };
const whirl = { kind: 'pattern', pattern: 'spiral', waveLength: 40 };

export const pictures = [
  // README shows these.
  plate('sun-moon.webp', 330, sunMoon),
  plate('wave.webp', 490, wave),
  plate(
    'name.webp',
    208,
    '--shape heart --size 80 --spool redPetg',
    { ...rings, at: [40, 10] },
    { kind: 'text', text: 'ANNA', textSize: 16, at: [40, 44] },
  ),
  plate('code.webp', 208, '--shape rounded --size 50 --angle 45 --spool goldPla --map-filter nearest', {
    kind: 'code',
    text: 'https://example.org',
    size: [48, 0],
  }),
  preview('rebrush.webp', 208, 'rebrush examples/lid.gcode --spool clearPetg', whirl),
  plate('two-lamps.webp', 208, two('star.png', 'heart.png')),
  // Guides show these.
  ...['name-sign', 'logo-coaster', 'photo-ring', 'keychain', 'qr-frame'].map((name) =>
    plate(`layers-${name}.png`, 200, `examples/${name}.json`),
  ),
  plate('pattern-rings.webp', 150, disc, rings),
  plate('pattern-spiral.webp', 150, disc, whirl),
  plate('pattern-waves.webp', 150, disc, { kind: 'pattern', pattern: 'waves' }),
  plate('pattern-noise.webp', 150, disc, {
    kind: 'pattern',
    pattern: 'noise',
    waveLength: 15,
    amplitude: 60,
    seed: 3,
  }),
  plate('pattern-echo.webp', 150, disc, { kind: 'pattern', pattern: 'echo', text: 'A', size: [18, 0] }),
  row(
    'shapes.svg',
    3,
    shapeNames.map((word) => ({
      word,
      line: `--shape ${word} --size 36 --angle 30 --spacing 1${word === 'star' ? ' --radius 0.5' : ''}`,
    })),
    inGold,
  ),
  zones('zones.svg', 60, '--shape disc --size 60 --zones 6', rings),
  plate('coaster.png', 240, '--shape disc --size 40 --angle 30'),
  plate('photo.png', 330, 'examples/inputs/photo.png --size 120'),
  plate('moving-logo.webp', 230, 'examples/logo.json'),
  plate('mode-parallel.png', 200, '--shape disc --size 30 --mode parallel'),
  ...['flow', 'speed', 'fan', 'width', 'directions', 'swatch', 'coupon'].map((kind) =>
    preview(`calibrate-${kind}.png`, 480, `calibrate ${kind} --filament pla-silk --spool goldPla`),
  ),
  {
    names: ['coupon-photograph.jpg'],
    draw: (folder) => run('sillon_bench', ['photograph', join(folder, 'coupon-photograph.jpg')]),
  },
  // Pages of internals show these.
  row(
    'even-shine.svg',
    2,
    ['plain', 'even'].map((order) => ({
      word: `--order ${order}`,
      line: `--shape disc --size 60 --angle 75 --spacing 0.8 --order ${order}`,
    })),
    inOrder,
    9,
  ),
  {
    names: stageNames.map((name, k) => `${String(k + 1).padStart(2, '0')}-${name}.png`),
    draw: (folder) => run('examples/stages', ['examples/logo.json', '1.8', folder]),
  },
  ...Object.entries({ default: 'standard', 2023: 'paper-2023' }).map(([name, preset]) =>
    plate(
      `quality-${name}.png`,
      640,
      `--shape disc --size 22 --directions examples/inputs/relief.png --spacing 0.5 --preset ${preset}`,
    ),
  ),
];

/** Draws them all. */
export function drawPictures(folder) {
  mkdirSync(folder, { recursive: true });
  for (const { draw } of pictures) draw(folder);
}

if (process.argv[1] !== undefined && resolve(process.argv[1]) === fileURLToPath(import.meta.url)) {
  drawPictures(resolve(process.argv[2] ?? join(root, 'docs/pictures')));
}
