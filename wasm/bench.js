// Figures of the engine beside those of the native program, taken in turn so that a busy machine is fair to both.
// Prints; asserts nothing.   ./dev bench wasm [PROJECT.json]
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { brotliCompressSync, gzipSync } from 'node:zlib';

import { createEngine } from 'sillon';

import { nativeProgram, openProject, publishedScenes, root } from './test/support/projects.js';

const rounds = 9;
const wave = join(publishedScenes, 'wave.json');
const brain = join(publishedScenes, 'brain.json');
const path = process.argv[2] ?? (existsSync(wave) ? wave : join(root, 'examples/noise.json'));

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const inMs = (seconds) => `${(1000 * seconds).toFixed(0).padStart(5)} ms`;

function nativeSeconds(threads, folder) {
  const report = join(folder, 'report.json');
  const args = ['generate', path, '--threads', String(threads), '--report', report, '--quiet'];
  execFileSync(nativeProgram, args);
  return JSON.parse(readFileSync(report, 'utf8')).time.total;
}

async function engineSeconds(engine, { input, project }) {
  const begin = performance.now();
  const { report } = await engine.generateToolpath(input, project.toolpath, { measure: false });
  return { stages: report.time.total, call: (performance.now() - begin) / 1000 };
}

const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
console.log(`${basename(path)}, medians of ${rounds} runs, warm`);
console.log('threads   native   engine    ratio   whole call, files read and result handed over');
for (const threads of [1, 2]) {
  const engine = await createEngine({ threads: threads === 1 ? 'off' : threads });
  const opened = await openProject(engine, path);
  const native = [];
  const stages = [];
  const calls = [];
  await engineSeconds(engine, opened);
  for (let k = 0; k < rounds; ++k) {
    native.push(nativeSeconds(threads, folder));
    const { input, project } = opened;
    const bridge = project.toolpath.spacing + k / 1e4; // another each time, so that the engine keeps nothing
    const seconds = await engineSeconds(engine, { input, project: { toolpath: { ...project.toolpath, bridge } } });
    stages.push(seconds.stages);
    calls.push(seconds.call);
  }
  const ratio = (median(stages) / median(native)).toFixed(2);
  console.log(
    `${threads} (${engine.info.variant})  ${inMs(median(native))} ${inMs(median(stages))}  ${ratio.padStart(7)}   ${inMs(median(calls))}`,
  );
  engine.dispose();
}
rmSync(folder, { recursive: true });

// What a slider does: each round another shape parameter, so that nothing is kept, then one that the waves depend on,
// then one that only the path depends on.
const live = existsSync(brain) ? brain : join(root, 'examples/logo.json');
console.log(`\n${basename(live)}, medians of ${rounds} edits, stages`);
console.log('threads   all anew   waves anew   path anew');
for (const threads of [1, 2]) {
  const engine = await createEngine({ threads: threads === 1 ? 'off' : threads });
  const { input, project } = await openProject(engine, live);
  const toolpath = { ...project.toolpath, bridge: 0.5 };
  const rows = [[], [], []];
  for (let k = 0; k < rounds + 1; ++k) {
    for (const [row, edit] of ['bridge', 'borderWeight', 'widthBalance'].entries()) {
      toolpath[edit] = 0.5 + k / 1000;
      const seconds = await engineSeconds(engine, { input, project: { toolpath } });
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
