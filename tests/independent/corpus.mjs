// ./dev bench corpus FOLDER...: the drawings in folders as Sillon reads them, beside what Chromium shows with the fonts that
// Sillon has.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, relative } from 'node:path';
import { gunzipSync } from 'node:zlib';

import { startChromium } from '../../wasm/test/support/browsers.js';
import { nativeProgram, root } from '../../wasm/test/support/projects.js';

const pixels = 1600; // of the longer side: a browser moves letters by parts of a pixel
const batch = 50; // files that one call of the program reads
const good = 0.9; // share of area in common
const shown = 20; // of the worst drawings
const expected = ['DrawingInPixels', 'TextInOtherFont']; // notes that tell of no difference

const filesIn = (path) =>
  statSync(path).isFile()
    ? [path]
    : readdirSync(path, { recursive: true })
        .filter((file) => /\.svgz?$/i.test(file))
        .sort()
        .map((file) => join(path, file));

/** Sillon's fonts are the only ones, whatever a drawing asks for. Chromium takes a family only where a rule binds it strongly. */
function fontConfig(folder) {
  const instead = (families, font) => `<match><test name="family" qual="any" compare="${families === '' ? 'not_eq' : 'eq'}">
    <string>${families === '' ? font : families}</string></test>
    <edit name="family" mode="append" binding="same"><string>${font}</string></edit></match>`;
  const file = join(folder, 'fonts.conf');
  writeFileSync(
    file,
    `<?xml version="1.0"?><!DOCTYPE fontconfig SYSTEM "urn:fontconfig:fonts.dtd"><fontconfig>
    <dir>${join(root, 'core/data/fonts')}</dir><cachedir>${join(folder, 'cache')}</cachedir>
    ${['serif', 'Times', 'Times New Roman', 'Georgia'].map((name) => instead(name, 'Roboto Slab')).join('')}
    ${instead('cursive', 'Caveat')}${instead('', 'Nunito')}</fontconfig>`,
  );
  return file;
}

function read(files) {
  const program = (list) => {
    try {
      return execFileSync(nativeProgram, ['shape', '--json', '--outline', ...list], { maxBuffer: 1 << 30 });
    } catch ({ stdout }) {
      return stdout; // some are refused
    }
  };
  return Array.from({ length: Math.ceil(files.length / batch) }, (_, k) =>
    program(files.slice(k * batch, (k + 1) * batch))
      .toString()
      .trim()
      .split('\n')
      .map((line) => JSON.parse(line)),
  ).flat();
}

/** Runs in the page. `common`: what both cover, as a share of what either does. */
async function compare({ svg, outline, page, pixels }) {
  const scale = pixels / Math.max(...page);
  const [width, height] = page.map((side) => Math.max(1, Math.round(side * scale)));
  const covered = (draw) => {
    const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    draw(context);
    return context.getImageData(0, 0, width, height).data;
  };
  const image = new Image(width, height);
  image.src = URL.createObjectURL(new Blob([svg], { type: 'image/svg+xml' }));
  try {
    await image.decode();
  } catch {
    return {};
  } finally {
    URL.revokeObjectURL(image.src);
  }
  const theirs = covered((context) => context.drawImage(image, 0, 0, width, height));
  const ours = covered((context) => {
    context.scale(width / page[0], height / page[1]);
    context.fill(new Path2D(outline));
  });
  let both = 0;
  let either = 0;
  for (let k = 3; k < theirs.length; k += 4) {
    const [mine, other] = [ours[k] >= 128, theirs[k] >= 128];
    both += mine && other ? 1 : 0;
    either += mine || other ? 1 : 0;
  }
  return { common: either === 0 ? 1 : both / either };
}

const counted = (words) => {
  const counts = new Map();
  for (const word of words) counts.set(word, (counts.get(word) ?? 0) + 1);
  return [...counts].sort(([, a], [, b]) => b - a);
};
const line = (number, text) => console.log(`${String(number).padStart(6)}  ${text}`);

const folder = mkdtempSync(join(tmpdir(), 'sillon-corpus-'));
process.env.FONTCONFIG_FILE = fontConfig(folder);
const browser = await startChromium();
try {
  const paths = process.argv.slice(2);
  const nameOf = (file) => relative(paths.length === 1 ? paths[0] : '.', file) || file;
  const drawings = read(paths.flatMap(filesIn));
  const page = await browser.newPage();
  for (const drawing of drawings) {
    if (drawing.error !== undefined) continue;
    const bytes = readFileSync(drawing.file);
    const svg = (bytes[0] === 0x1f ? gunzipSync(bytes) : bytes).toString();
    Object.assign(drawing, await page.evaluate(compare, { ...drawing, svg, pixels }));
  }
  const compared = drawings.filter(({ common }) => common !== undefined);
  const told = ({ notes }) => notes.filter(({ code }) => !expected.includes(code));
  const refused = drawings.filter(({ error }) => error !== undefined);
  line(drawings.length, 'drawings');
  line(compared.filter(({ common }) => common >= good).length, `have ${good} or more of their area in common with Chromium's`);
  const off = compared.filter(({ common }) => common < good);
  line(off.length, 'less');
  line(off.filter((one) => told(one).length === 0).length, 'of these without a note');
  const far = compared.filter(({ common }) => common < 0.5);
  line(far.length, 'less than half');
  line(far.filter((one) => told(one).length === 0).length, 'of these without a note');
  line(drawings.length - compared.length - refused.length, 'that Chromium does not show');
  line(refused.length, 'refused');
  counted(refused.map(({ error }) => error.replace(/^.*?": (<[^>]*> in line \d+: )?/, ''))).forEach(([why, n]) => line(n, `  ${why}`));
  console.log('Notes');
  counted(drawings.flatMap(({ notes = [] }) => notes.map(({ message }) => message))).forEach(([what, n]) => line(n, what));
  console.log(`The worst ${shown}`);
  const worst = off.sort((a, b) => a.common - b.common).slice(0, Number(process.env.WORST ?? shown));
  for (const one of worst) line(one.common.toFixed(3), `${nameOf(one.file)}  ${told(one).map(({ message }) => message).join('; ')}`);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
