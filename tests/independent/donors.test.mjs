// Files of other slicers as donors: each printer profile that comes with PrusaSlicer, Slic3r and CuraEngine slices a cube,
// `sillon import` makes a printer of it, and what `sillon generate` writes for that printer passes `sillon check`.
// A few printers of each by default; all of them, in half an hour, with SILLON_DONORS=all. Missing slicers are named.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { after, test } from 'node:test';

import { nativeProgram } from '../../wasm/test/support/projects.js';

const prusaProfiles = '/usr/share/PrusaSlicer/profiles';
const curaDefinitions = '/usr/share/cura/resources/definitions';
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

function run(program, args, options = {}) {
  return spawnSync(program, args, { encoding: 'utf8', maxBuffer: 1 << 28, timeout: 300_000, ...options });
}
const missing = (program) => (run(program, ['--help']).error === undefined ? false : `skipped: ${program} is not installed`);

/** A cube of 12 mm, its lower corner at the origin, as an STL. */
function cube() {
  const size = 12;
  const corner = (k) => [k & 1, (k >> 1) & 1, k >> 2].map((one) => one * size).join(' ');
  const faces = ['0 2 3 0 3 1', '4 5 7 4 7 6', '0 1 5 0 5 4', '2 6 7 2 7 3', '0 4 6 0 6 2', '1 3 7 1 7 5'];
  const triangles = faces.flatMap((face) => {
    const corners = face.split(' ').map(Number);
    return [corners.slice(0, 3), corners.slice(3)];
  });
  const facet = (three) =>
    `facet normal 0 0 0\nouter loop\n${three.map((k) => `vertex ${corner(k)}\n`).join('')}endloop\nendfacet\n`;
  return `solid cube\n${triangles.map(facet).join('')}endsolid cube\n`;
}
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

// ---- PrusaSlicer

/** @returns {Map<string, Map<string, string>>} sections of a bundle by their names */
function readBundle(path) {
  const sections = new Map();
  let section = new Map();
  for (const line of readFileSync(path, 'utf8').split(/\r?\n/)) {
    const head = /^\[(.*)\]$/.exec(line);
    if (head !== null) sections.set(head[1], (section = new Map()));
    const pair = /^([a-z0-9_]+) = ?(.*)$/.exec(line);
    if (pair !== null && head === null) section.set(pair[1], pair[2]);
  }
  return sections;
}

function resolved(bundle, kind, name, depth = 0) {
  const own = bundle.get(`${kind}:${name}`);
  const values = new Map();
  if (own === undefined || depth > 32) return values;
  for (const parent of (own.get('inherits') ?? '').split(';').map((one) => one.trim())) {
    if (parent !== '') for (const [key, value] of resolved(bundle, kind, parent, depth + 1)) values.set(key, value);
  }
  for (const [key, value] of own) values.set(key, value);
  return values;
}

const notConfig = /^(inherits|renamed_from|compatible_|default_|family|alias|printer_variant)/;

function prusaPrinters() {
  const printers = [];
  for (const file of readdirSync(prusaProfiles).filter((name) => name.endsWith('.ini'))) {
    const bundle = readBundle(join(prusaProfiles, file));
    for (const section of bundle.keys()) {
      const name = /^printer:([^*].*)$/.exec(section)?.[1];
      if (name === undefined) continue;
      const printer = resolved(bundle, 'printer', name);
      if (printer.get('printer_technology') === 'SLA' || !printer.has('start_gcode')) continue;
      printers.push({ name, bundle, printer });
    }
  }
  return printers;
}

test('PrusaSlicer: files for its printers become printers whose files pass', {
  skip: missing('prusa-slicer') || (!existsSync(prusaProfiles) && 'skipped: no profiles of PrusaSlicer'),
  timeout: 4 * 3_600_000,
}, (context) => {
  const printers = prusaPrinters().filter(({ name }) => all || prusaSample.includes(name));
  const byName = new Map(printers.map((one) => [one.name, one]));
  assert.deepEqual(prusaSample.filter((name) => !byName.has(name)), [], 'no such profiles');
  judge(context, [...byName.keys()], (name, donor) => {
    const { bundle, printer } = byName.get(name);
    const unquoted = (text) => (text ?? '').split(';')[0].replaceAll('"', '');
    const values = new Map([
      ...resolved(bundle, 'print', unquoted(printer.get('default_print_profile'))),
      ...resolved(bundle, 'filament', unquoted(printer.get('default_filament_profile'))),
      ...printer,
    ]);
    const config = join(folder, 'config.ini');
    const lines = [...values].filter(([key]) => !notConfig.test(key)).map(([key, value]) => `${key} = ${value}\n`);
    writeFileSync(config, lines.join(''));
    run('prusa-slicer', ['--load', config, '--export-gcode', '--output', donor, model]);
  });
});

// ---- Slic3r, which comes with no printers: its own defaults, in the firmwares that it knows

test('Slic3r: files in its default settings become printers whose files pass', {
  skip: missing('slic3r'),
  timeout: 3_600_000,
}, (context) => {
  judge(context, ['reprap', 'smoothie', 'repetier'], (flavor, donor) => {
    run('slic3r', ['--gcode-flavor', flavor, '--output', donor, model]);
  });
});

// ---- CuraEngine

/** A definition's values with those it inherits: plain ones, as the engine itself reads them. */
function curaMachine(name, depth = 0) {
  const path = join(curaDefinitions, `${name}.def.json`);
  if (!existsSync(path) || depth > 16) return { values: {}, metadata: {} };
  const { inherits, overrides = {}, metadata = {} } = JSON.parse(readFileSync(path, 'utf8'));
  const below = inherits === undefined ? { values: {}, metadata: {} } : curaMachine(inherits, depth + 1);
  const values = { ...below.values };
  for (const [key, { value, default_value: otherwise }] of Object.entries(overrides)) {
    // A formula of numbers alone is a value too; others need Cura itself.
    const plain = typeof value === 'string' && !/^-?[\d.]+$|^(True|False)$/.test(value) ? undefined : value;
    const told = plain ?? otherwise;
    if (told !== undefined) values[key] = told;
  }
  return { values, metadata: { ...below.metadata, ...metadata } };
}

/** Cura's files do not hold the bed; their owner gives it. */
function bedOf(name) {
  const { machine_width: width, machine_depth: depth, machine_center_is_zero: centred } = curaMachine(name).values;
  return centred === true || !(width > 0 && depth > 0) ? [] : ['--bed', `${width}x${depth}`];
}

test('CuraEngine: files for its printers become printers whose files pass', {
  skip: missing('CuraEngine') || (!existsSync(curaDefinitions) && 'skipped: no definitions of Cura'),
  timeout: 4 * 3_600_000,
}, (context) => {
  const names = readdirSync(curaDefinitions)
    .map((file) => basename(file, '.def.json'))
    .filter((name) => (all ? curaMachine(name).metadata.visible === true : curaSample.includes(name)));
  const search = `${curaDefinitions}:${curaDefinitions.replace('definitions', 'extruders')}`;
  judge(context, names, (name, donor) => {
    const { values, metadata } = curaMachine(name);
    const temperatures = { material_print_temperature: 210, material_print_temperature_layer_0: 215, material_bed_temperature: 60 };
    Object.assign(temperatures, { material_bed_temperature_layer_0: 60, default_material_print_temperature: 210 });
    // What Cura does before it calls its engine: values into the block, heating where the block has none.
    const known = { speed_travel: 120, retraction_amount: 1, retraction_speed: 30, travel_speed: 120, ...values, ...temperatures };
    const fill = (text) => String(text).replaceAll(/\{([a-z_0-9]+)(?:, *\d+)?\}/g, (whole, key) => known[key] ?? 0);
    const filled = fill(values.machine_start_gcode ?? 'G28');
    const heats = /\bM(109|104)\b/.test(filled) ? '' : 'M104 S215\nM109 S215\n';
    const heatsBed = /\bM(140|190)\b/.test(filled) ? '' : 'M190 S60\n';
    const settings = {
      ...values,
      ...temperatures,
      machine_start_gcode: `${heatsBed}${heats}${filled}`,
      machine_end_gcode: fill(values.machine_end_gcode ?? 'M104 S0\nM140 S0\nM84'),
      mesh_position_x: values.machine_center_is_zero === true ? -6 : Number(values.machine_width ?? 200) / 2 - 6,
      mesh_position_y: values.machine_center_is_zero === true ? -6 : Number(values.machine_depth ?? 200) / 2 - 6,
      center_object: false,
      roofing_layer_count: 0,
      prime_tower_enable: false,
      adhesion_type: 'skirt',
    };
    const flags = Object.entries(settings).flatMap(([key, value]) => ['-s', `${key}=${value}`]);
    const printer = join(curaDefinitions, `${name}.def.json`);
    const made = run('CuraEngine', ['slice', '-j', printer, ...flags, '-e0', ...flags, '-l', model, '-o', donor], {
      env: { ...process.env, CURA_ENGINE_SEARCH_PATH: search },
    });
    if (made.status !== 0) return rmSync(donor, { force: true });
    // The frontend writes the machine's name above the engine's header.
    writeFileSync(donor, `;TARGET_MACHINE.NAME:${values.machine_name ?? metadata.name ?? name}\n${readFileSync(donor, 'utf8')}`);
  }, bedOf);
});
