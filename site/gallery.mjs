// The gallery: every example as the program makes it, with what it takes to make it again.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join, posix } from 'node:path';

import { zipSync } from 'fflate';

import { escaped, render } from './markdown.mjs';
import { pageOf, root } from './pages.mjs';

const program = join(root, 'build/release/sillon');
const epoch = new Date(1980, 0, 1); // the same zip for the same files

/** What examples/README.md says of an example: its row of the table. */
function wordsOf(name) {
  const rows = readFileSync(join(root, 'examples/README.md'), 'utf8').split('\n');
  const row = rows.find((line) => line.startsWith('|') && line.split('|')[1].includes(`\`${name}.json\``));
  if (row === undefined) throw new Error(`examples/README.md has no row for ${name}.json`);
  const cells = row.split('|').map((cell) => cell.trim());
  return render(cells[3], () => undefined).html;
}

/** The project and what it names, as one file that the studio opens; unpacked, the command line reads it. */
function projectZip(name) {
  const text = readFileSync(join(root, `examples/${name}.json`));
  const project = JSON.parse(text);
  const files = { 'project.json': text };
  const layers = project.layers ?? [];
  const lit = layers.flatMap(({ pictures }) => pictures ?? []);
  const named = [project.shape, ...layers, ...lit].flatMap((part) => [part?.file, part?.modeFile, part?.maskFile]);
  for (const file of named.filter((name) => name !== undefined)) {
    if (!/^[\w/.-]+$/.test(file) || posix.normalize(file).startsWith('..'))
      throw new Error(`${name}: odd file ${file}`);
    files[file] = readFileSync(join(root, 'examples', file));
  }
  return zipSync(files, { mtime: epoch });
}

const decimal = (value, digits) => value.toFixed(digits);

/** What the project says, but for names of files. */
function settingsOf(name) {
  const project = JSON.parse(readFileSync(join(root, `examples/${name}.json`), 'utf8'));
  const told = [];
  const tell = (section, settings) => {
    for (const [key, value] of Object.entries(settings ?? {})) {
      if (!['file', 'modeFile', 'maskFile', 'pictures'].includes(key))
        told.push(`${section}.${key} ${JSON.stringify(value)}`);
    }
  };
  tell('shape', project.shape);
  (project.layers ?? []).forEach((layer, number) => tell(`layers[${number}]`, layer));
  for (const section of ['pictures', 'toolpath', 'print', 'printer']) tell(section, project[section]);
  return told.join(', ');
}

function make(folder, name) {
  const made = join(folder, 'gallery', name);
  const args = ['generate', join(root, `examples/${name}.json`), '--preview-width', '420'];
  const run = (...more) => execFileSync(program, [...args, ...more], { stdio: ['ignore', 'ignore', 'inherit'] });
  run('--preview', `${made}.png`, '--report', `${made}.json`, '--project', `${made}.tmp`);
  const report = JSON.parse(readFileSync(`${made}.json`, 'utf8'));
  const png = readFileSync(`${made}.png`);
  rmSync(`${made}.json`);
  rmSync(`${made}.tmp`);
  const zip = projectZip(name);
  writeFileSync(`${made}.zip`, zip);
  const moves = existsSync(`${made}-2.png`); // two pictures: what they become under each other's lamps
  if (moves) {
    rmSync(`${made}-2.png`);
    run('--preview', `${made}.webp`);
  }
  return { report, zip, moves, width: png.readUInt32BE(16), height: png.readUInt32BE(20) };
}

function figure(name, { report, zip, moves, width, height }) {
  const { lengthMm, coverage, spacing, toolpaths, grid } = report;
  const [wide, tall] = grid.map((cells) => (cells - 6) * (spacing / 2)); // without the margin of one and a half spacings
  const size = `${decimal(wide, 0)} × ${decimal(tall, 0)} mm`;
  const still = `<img src="${name}.png" width="${width}" height="${height}" loading="lazy" alt="${escaped(name)}: directions in colour, and the look under a lamp" />`;
  const moving = `<img src="${name}.webp" loading="lazy" alt="${escaped(name)}: the look as the lamp moves from one picture's place to the other's" />`;
  const images = moves ? `${still}\n${moving}` : still;
  const path = toolpaths === 1 ? 'one path' : `${toolpaths} paths`;
  return `<article>
<h2 id="${name}">${name}</h2>
${images}
${wordsOf(name)}
<dl>
<div><dt>Size</dt><dd>${size}</dd></div>
<div><dt>Spacing</dt><dd>${spacing} mm</dd></div>
<div><dt>Toolpath</dt><dd>${path}, ${decimal(lengthMm / 1000, 1)}&nbsp;m, coverage ${decimal(coverage, 1)}&nbsp;%</dd></div>
<div><dt>Set</dt><dd>${escaped(settingsOf(name))}</dd></div>
</dl>
<p><a href="../#open=gallery/${name}.zip">Open ${name} in the studio</a>, or <a href="${name}.zip" download>download the project</a>
(${Math.ceil(zip.length / 1000)} kB): unpack it, then <code>sillon generate project.json --gcode ${name}.gcode</code></p>
</article>
`;
}

/** @param examples  names of projects in examples/ */
export async function drawGallery(folder, examples) {
  if (!existsSync(program)) throw new Error(`${program} is missing; ./dev build release makes it`);
  mkdirSync(dirname(join(folder, 'gallery/index.html')), { recursive: true });
  const figures = examples.map((name) => figure(name, make(folder, name)));
  const body = `<h1>Gallery</h1>
<p>Each plate as the program makes it from a project in <code>examples</code>: the beads coloured by direction, and their look under a lamp from
the upper right. None has been printed by us.</p>
<div class="gallery">
${figures.join('\n')}</div>`;
  const description =
    'Plates that Sillon makes from a shape and a picture, each with its project, which opens in the studio.';
  const page = pageOf('gallery/index.html', 'Gallery', body, { wide: true, description });
  writeFileSync(join(folder, 'gallery/index.html'), page);
}
