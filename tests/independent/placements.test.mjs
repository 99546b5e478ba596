// The beads of plates with layers run as Pillow, a library for pictures, crops, stretches, mirrors and turns the same
// pictures. Without Pillow the tests show as skipped.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { nativeProgram } from '../../wasm/test/support/projects.js';
import { pythonWith, run } from './plates.mjs';

const script = fileURLToPath(new URL('place_pictures.py', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'sillon-placements-'));
const python = pythonWith('PIL.ImageDraw');
const skip = python === undefined && 'no Pillow here; install the Debian package python3-pil';

before(() => {
  if (python !== undefined) run(python, [script, 'draw', folder]);
});
after(() => rmSync(folder, { recursive: true }));

/** Returns a source of numbers from 0 to 1, which are the same in every run (Park and Miller). */
function numbers(seed) {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

/** Describes a plate with one layer, which lies anywhere; `own` adds settings. */
function plateWith(kind, next, own) {
  const between = (low, high) => Number((low + (high - low) * next()).toFixed(2));
  const either = (first, second) => (next() < 0.5 ? first : second);
  const disc = next() < 0.5;
  const page = disc ? [60, 60] : [64, 48];
  const layer = {
    kind,
    // It lies so far from the middle that a page upside down would show.
    at: [page[0] / 2 + between(-6, 6), page[1] / 2 + either(-1, 1) * between(4, 9)],
    size: either([between(30, 38), 0], [between(28, 36), between(22, 30)]),
    rotation: either(-1, 1) * between(15, 75) + either(0, 90),
    mirror: next() < 0.5,
    ...own(between, either),
  };
  return { disc, page, layer, below: between(-80, 80) };
}

/** Makes the plate and tells how far its beads run from Pillow's picture, by the part that is misunderstood. */
function compare({ disc, page, layer, below }, name) {
  const project = join(folder, `${name}.json`);
  const view = join(folder, `${name}.png`);
  const shape = disc ? { builtin: 'disc', size: [page[0], 0] } : { builtin: 'rectangle', size: page };
  const layers = [{ kind: 'direction', angle: below }, layer];
  writeFileSync(project, JSON.stringify({ sillon: 1, shape, layers, toolpath: { spacing: 0.4 } }));
  run(nativeProgram, ['generate', project, '--view', view, '--quiet']);
  return JSON.parse(run(python, [script, 'compare', JSON.stringify({ disc, page, layer, below, view })]));
}

/** Fails unless the beads run as told, and unlike a layer of which one part has the other sense. */
function holds(plate, name) {
  const { told, ...others } = compare(plate, name);
  const what = `${name}: ${JSON.stringify({ plate, told, others })}`;
  for (const { compared, median, off } of [told.layer, told.around]) {
    assert.ok(compared > 100 && median < 3 && off < 0.1, what);
  }
  for (const [part, { layer }] of Object.entries(others)) assert.ok(layer.off > 0.25, `${part}, ${what}`);
}

test('maps lie where Pillow crops, stretches, mirrors and turns them', { skip }, () => {
  const next = numbers(1);
  for (const encoding of ['angle', 'rotation', 'angle', 'rotation', 'angle', 'rotation']) {
    const low = next() < 0.5;
    const plate = plateWith('map', next, (between, either) => ({
      file: join(folder, 'map.png'),
      encoding,
      // The crop lies near one edge, so that rows that count from the other edge give another part.
      cropMin: [between(0, 0.2), low ? between(0, 0.1) : between(0.35, 0.45)],
      cropMax: [between(0.7, 1), low ? between(0.55, 0.65) : between(0.9, 1)],
      ...either({ mask: 'own' }, { mask: 'inside', maskFile: join(folder, 'mask.png') }),
    }));
    holds(plate, `map-${encoding}-${plate.below}`);
  }
});

test('drawings lie where Pillow stretches, mirrors and turns their masks', { skip }, () => {
  const next = numbers(2);
  for (let k = 0; k < 6; ++k) {
    const plate = plateWith('drawing', next, () => ({ file: join(folder, 'mask.png') }));
    plate.layer.angle = plate.below + 90;
    holds(plate, `drawing-${k}`);
  }
});
