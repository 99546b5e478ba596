// Files of other slicers as donors: each printer profile that comes with PrusaSlicer, Slic3r and CuraEngine slices a cube,
// `sillon import` makes a printer of it, and what `sillon generate` writes for that printer passes `sillon check`.
// A few printers of each by default; all of them, in half an hour, with SILLON_DONORS=all. Missing slicers are named.
import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';

import { nativeProgram } from '../../wasm/test/support/projects.js';
import {
  bedOf, cube, curaPrinters, noCura, noPrusaSlicer, noSlic3r, prusaPrinters, run, sliceForCura, sliceForPrusa,
} from './slicers.mjs';

const all = process.env['SILLON_DONORS'] === 'all';
const folder = mkdtempSync(join(tmpdir(), 'sillon-donors-'));
after(() => rmSync(folder, { recursive: true }));

// One of each kind: Marlin, Prusa's, Klipper, RepRapFirmware, deltas, beds with the origin in their middle, unusual blocks.
const prusaSample = [
  'Original Prusa i3 MK3S & MK3S+',
  'Original Prusa MINI & MINI+',
  'Creality Ender-3 (0.4 mm nozzle)',
  'FLSun Q5',
  'Anycubic Kossel Linear Plus', // gives 0.2 mm less back than it retracts
  'Original Prusa i3 MK3 MMU2', // takes the filament out at the end
  'Voron_v2_300 0.4 nozzle',
  'RatRig V-Core-3-300',
];
const curaSample = ['creality_ender3', 'prusa_i3_mk3', 'ultimaker_original', 'anycubic_kossel', 'flsun_qq_s', 'voron2_300'];

const model = join(folder, 'cube.stl');
writeFileSync(model, cube());

/**
 * Blocks that are refused for what stands in them, of printers that come with the slicers. In front of a nozzle they are
 * faults, or nobody can tell what they do.
 */
const blocksAtFault = [
  /a bead at or below the bed: Z 0$/, // told so: "G1 X60 Z0 E9"
  /startGcode does not home/, // the firmware does, or a macro whose name does not say so
  /moves before it homes/,
  /extrudes with the nozzle at 0 degrees/, // Cura's values that only Cura fills in
  /extrudes before it has waited for a hot nozzle/,
  /stands for no value here/, // "{retraction_amount}"
  /a letter given twice/, // "F2400G1 Z3 F720" on one line
  /over the bed's edge/, // beside the bed as the printer's own profile has it
  /startGcode: retracted further than any hot end is long/, // of the other extruder
  /extrudes nothing after its first layer mark/, // M101 and M103 of Bits from Bytes, in place of E
];

/** From a slicer's file to ours. @returns what went wrong; empty: nothing */
function fault(donor, options = []) {
  const printer = join(folder, 'printer.json');
  const ours = join(folder, 'ours.gcode');
  const imported = run(nativeProgram, ['import', donor]);
  if (imported.status !== 0) return `import: ${imported.stderr}`;
  writeFileSync(printer, imported.stdout);
  const made = run(nativeProgram, ['generate', printer, '--shape', 'disc', '--size', '12', '--gcode', ours, '--quiet', ...options]);
  if (made.status !== 0) return `generate: ${made.stderr}`;
  const checked = run(nativeProgram, ['check', ours]);
  const errors = checked.stdout.split('\n').filter((line) => line.startsWith('error'));
  return checked.status === 0 ? '' : `check: ${errors.join(' | ')}${checked.stderr}`;
}

/**
 * Slices for each printer and judges what comes of it. Printers that the slicer itself refuses are counted only; with all
 * of them also those whose blocks are at fault.
 * @param options  for `sillon generate`, by name
 */
function judge(context, names, slice, options = () => []) {
  const faults = [];
  const blocks = [];
  const refused = [];
  for (const name of names) {
    const donor = join(folder, 'donor.gcode');
    rmSync(donor, { force: true });
    slice(name, donor);
    if (!existsSync(donor)) {
      refused.push(name);
      continue;
    }
    const wrong = fault(donor, options(name)).trim();
    const refusedBlock = !wrong.startsWith('check') && blocksAtFault.some((pattern) => pattern.test(wrong));
    if (wrong !== '') (all && refusedBlock ? blocks : faults).push(`${name}: ${wrong.split('\n').slice(0, 3).join(' | ')}`);
  }
  context.diagnostic(`${names.length - refused.length} printers sliced, ${refused.length} refused by the slicer`);
  if (refused.length > 0) context.diagnostic(`refused: ${refused.join(', ')}`);
  if (blocks.length > 0) context.diagnostic(`blocks at fault: ${blocks.length}\n${blocks.join('\n')}`);
  assert.ok(names.length > refused.length, 'no printer was sliced');
  assert.deepEqual(faults, []);
}

test('PrusaSlicer: files for its printers become printers whose files pass', {
  skip: noPrusaSlicer,
  timeout: 4 * 3_600_000,
}, (context) => {
  const printers = prusaPrinters().filter(({ name }) => all || prusaSample.includes(name));
  const byName = new Map(printers.map((one) => [one.name, one]));
  assert.deepEqual(prusaSample.filter((name) => !byName.has(name)), [], 'no such profiles');
  judge(context, [...byName.keys()], (name, donor) => sliceForPrusa(byName.get(name), model, donor));
});

test('Slic3r: files in its default settings become printers whose files pass', {
  skip: noSlic3r, // it comes with no printers, only with the firmwares that it knows
  timeout: 3_600_000,
}, (context) => {
  judge(context, ['reprap', 'smoothie', 'repetier'], (flavor, donor) => {
    run('slic3r', ['--gcode-flavor', flavor, '--output', donor, model]);
  });
});

test('CuraEngine: files for its printers become printers whose files pass', {
  skip: noCura,
  timeout: 4 * 3_600_000,
}, (context) => {
  judge(context, all ? curaPrinters() : curaSample, (name, donor) => sliceForCura(name, model, donor), bedOf);
});
