// Files as other slicers write them for printers that come with them: PrusaSlicer, Slic3r and CuraEngine, where installed.
import { spawnSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';

const prusaProfiles = '/usr/share/PrusaSlicer/profiles';
const curaDefinitions = '/usr/share/cura/resources/definitions';

export function run(program, args, options = {}) {
  return spawnSync(program, args, { encoding: 'utf8', maxBuffer: 1 << 28, timeout: 300_000, ...options });
}
const missing = (program) => (run(program, ['--help']).error === undefined ? false : `skipped: ${program} is not installed`);

export const noPrusaSlicer =
  missing('prusa-slicer') || (!existsSync(prusaProfiles) && 'skipped: no profiles of PrusaSlicer');
export const noSlic3r = missing('slic3r');
export const noCura = missing('CuraEngine') || (!existsSync(curaDefinitions) && 'skipped: no definitions of Cura');

/** A cube of 12 mm, its lower corner at the origin, as an STL. */
export function cube() {
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

export function prusaPrinters() {
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

/** Slices for a printer of prusaPrinters(); a printer that the slicer refuses leaves no donor. */
export function sliceForPrusa({ bundle, printer }, model, donor) {
  const unquoted = (text) => (text ?? '').split(';')[0].replaceAll('"', '');
  const values = new Map([
    ...resolved(bundle, 'print', unquoted(printer.get('default_print_profile'))),
    ...resolved(bundle, 'filament', unquoted(printer.get('default_filament_profile'))),
    ...printer,
  ]);
  const config = join(dirname(donor), 'config.ini');
  const lines = [...values].filter(([key]) => !notConfig.test(key)).map(([key, value]) => `${key} = ${value}\n`);
  writeFileSync(config, lines.join(''));
  run('prusa-slicer', ['--load', config, '--export-gcode', '--output', donor, model]);
}

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
export function bedOf(name) {
  const { machine_width: width, machine_depth: depth, machine_center_is_zero: centred } = curaMachine(name).values;
  return centred === true || !(width > 0 && depth > 0) ? [] : ['--bed', `${width}x${depth}`];
}

/** Ids of the printers that Cura shows. */
export function curaPrinters() {
  return readdirSync(curaDefinitions)
    .map((file) => basename(file, '.def.json'))
    .filter((name) => curaMachine(name).metadata.visible === true);
}

/** Slices as Cura would; a printer that the engine refuses leaves no donor. */
export function sliceForCura(name, model, donor) {
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
  const search = `${curaDefinitions}:${curaDefinitions.replace('definitions', 'extruders')}`;
  const flags = Object.entries(settings).flatMap(([key, value]) => ['-s', `${key}=${value}`]);
  const printer = join(curaDefinitions, `${name}.def.json`);
  const made = run('CuraEngine', ['slice', '-j', printer, ...flags, '-e0', ...flags, '-l', model, '-o', donor], {
    env: { ...process.env, CURA_ENGINE_SEARCH_PATH: search },
  });
  if (made.status !== 0) return rmSync(donor, { force: true });
  // The frontend writes the machine's name above the engine's header.
  writeFileSync(donor, `;TARGET_MACHINE.NAME:${values.machine_name ?? metadata.name ?? name}\n${readFileSync(donor, 'utf8')}`);
}
