// Figures of the engine beside those of a native program that stays, as the engine does, taken in turn so that a busy machine is
// fair to both. Prints; asserts nothing.   ./dev bench wasm [PROJECT.json]
// SILLON_OTHER_ENGINE=FOLDER: beside them those of engine files that another compiler made.
import { spawn } from 'node:child_process';
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { basename, join } from 'node:path';
import { createInterface } from 'node:readline';
import { brotliCompressSync, gzipSync } from 'node:zlib';

import { createEngine } from 'sillon';

import { openProject, root } from './test/support/projects.js';

const rounds = 9;
const warmUps = 3;
const path = process.argv[2] ?? join(root, 'examples/paper/wave.json');
const brain = join(root, 'examples/paper/brain.json');
const other = process.env.SILLON_OTHER_ENGINE;

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const inMs = (seconds) => `${(1000 * seconds).toFixed(0).padStart(5)} ms`;

/** A native program that makes a plate whenever it is told to. */
function startNative(threads) {
  const program = spawn(join(root, 'build/release/sillon_bench'), ['turns', path, String(threads)], {
    stdio: ['pipe', 'pipe', 'inherit'],
  });
  const lines = createInterface({ input: program.stdout })[Symbol.asyncIterator]();
  return {
    async plate() {
      program.stdin.write('.');
      const [stages, processor] = (await lines.next()).value.split(' ').map(Number);
      return { stages, processor };
    },
    dispose: () => program.stdin.end(),
  };
}

/** Processor time is that of all threads of this program, which waits meanwhile. */
async function enginePlate(engine, { input, project }) {
  const begin = performance.now();
  const before = process.cpuUsage();
  const { report } = await engine.generateToolpath(input, project.toolpath, { measure: false });
  const { user, system } = process.cpuUsage(before);
  return {
    stages: report.time.total,
    call: (performance.now() - begin) / 1000,
    processor: (user + system) / 1e6,
  };
}

console.log(`${basename(path)}, medians of ${rounds} runs, all warm: the native program makes plate after plate, too`);
console.log('threads        native   engine    ratio   whole call   processor time   ratio');
for (const threads of [1, 2]) {
  const options = { threads: threads === 1 ? 'off' : threads };
  const native = startNative(threads);
  const engines = [{ name: '', engine: await createEngine(options) }];
  if (other !== undefined) {
    engines.push({ name: ' other', engine: await createEngine({ ...options, assetBase: other }) });
  }
  const opened = await openProject(engines[0].engine, path);
  const runs = { native: [], engines: engines.map(() => []) };
  for (let k = 0; k < warmUps + rounds; ++k) {
    const { input, project } = opened;
    const bridge = project.toolpath.spacing + k / 1e4; // another each time, so that the engine keeps nothing
    runs.native.push(await native.plate());
    for (const [e, { engine }] of engines.entries()) {
      runs.engines[e].push(
        await enginePlate(engine, { input, project: { toolpath: { ...project.toolpath, bridge } } }),
      );
    }
  }
  const of = (list, key) => median(list.slice(warmUps).map((run) => run[key]));
  const ratio = (list, key) => (of(list, key) / of(runs.native, key)).toFixed(2).padStart(5);
  for (const [e, { name, engine }] of engines.entries()) {
    const made = runs.engines[e];
    console.log(
      `${threads} (${engine.info.variant}${name})`.padEnd(12),
      `${inMs(of(runs.native, 'stages'))} ${inMs(of(made, 'stages'))}    ${ratio(made, 'stages')}     ${inMs(of(made, 'call'))}`,
      `  ${inMs(of(runs.native, 'processor'))} ${inMs(of(made, 'processor'))}  ${ratio(made, 'processor')}`,
    );
    engine.dispose();
  }
  native.dispose();
}

// What a slider does: each round another shape parameter, so that nothing is kept, then one that the waves depend on,
// then one that only the path depends on.
console.log(`\n${basename(brain)}, medians of ${rounds} edits, stages`);
console.log('threads   all anew   waves anew   path anew');
for (const threads of [1, 2]) {
  const engine = await createEngine({ threads: threads === 1 ? 'off' : threads });
  const { input, project } = await openProject(engine, brain);
  const toolpath = { ...project.toolpath, bridge: 0.5 };
  const rows = [[], [], []];
  for (let k = 0; k < rounds + 1; ++k) {
    for (const [row, edit] of ['bridge', 'borderWeight', 'widthBalance'].entries()) {
      toolpath[edit] = 0.5 + k / 1000;
      const seconds = await enginePlate(engine, { input, project: { toolpath } });
      if (k > 0) rows[row].push(seconds.stages);
    }
  }
  console.log(`${threads} (${engine.info.variant})   ${rows.map((row) => inMs(median(row))).join('     ')}`);
  engine.dispose();
}

console.log('\nsizes                      raw     gzip   brotli');
const dist = join(root, 'wasm/dist');
for (const name of readdirSync(dist, { recursive: true }).sort()) {
  if (!statSync(join(dist, name)).isFile()) continue;
  const bytes = readFileSync(join(dist, name));
  const kb = (size) => `${(size / 1024).toFixed(1).padStart(6)} KB`;
  console.log(
    name.padEnd(22),
    kb(bytes.length),
    kb(gzipSync(bytes, { level: 9 }).length),
    kb(brotliCompressSync(bytes).length),
  );
}
