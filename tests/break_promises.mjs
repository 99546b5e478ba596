// Breaks what docs/internals/promises.md promises, one line of tests/promises.mjs at a time, and requires that the test
// that the line names fails. It works on the last commit, in a checkout below build/.
//   node tests/break_promises.mjs [--list] [--native] [WORDS ...]
// --native takes only lines whose tests need neither the npm package nor the studio. With words it takes only lines whose
// promise, test or file has one of them.
import { spawnSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { breaks, testFile } from './promises.mjs';

const root = fileURLToPath(new URL('..', import.meta.url));
const scratch = join(root, 'build/promises');
const longest = 20 * 60e3; // [ms] of one command; a test that hangs has noticed something

/** Runs a command in the checkout. @returns true where it ends with 0; its words are in `said` otherwise */
let said = '';
function run(command, ...args) {
  const { status, stdout, stderr } = spawnSync(command, args, {
    cwd: scratch,
    encoding: 'utf8',
    timeout: longest,
    maxBuffer: 1e9,
  });
  said = `${stdout}\n${stderr}`;
  return status === 0;
}

function must(...command) {
  if (!run(...command)) throw new Error(`${command.join(' ')}\n${said}`);
}

const isNative = ({ test }) => /(_test|\.sh)$/.test(test);

/** Commands that build what a test needs, and the one that runs it, or only one case of it. */
function plan({ test, only }) {
  const file = testFile(test);
  const build = (...targets) => ['cmake', '--build', '--preset', 'release', '--target', ...targets];
  if (test.endsWith('_test')) {
    const program = { 'pipeline/memory_test': 'memory_test', 'cli/cli_test': 'cli_test' }[test] ?? test.replace('/', '_');
    const target = program.replace('pipeline_published', 'published');
    return { builds: [build(target)], runs: [`build/release/tests/${target}`, ...(only ? [`-tc=${only.replaceAll(',', '?')}`] : [])] };
  }
  if (test.endsWith('.sh')) {
    const library = test.includes('library');
    return { builds: library ? [build('sillon')] : [], runs: [file, ...(library ? ['build/release/core/libsillon.a'] : [])] };
  }
  const node = ['node', '--test', ...(only ? [`--test-name-pattern=${only.replace(/[.*+?^${}()|[\]\\]/g, '\\$&')}`] : [])];
  if (test.endsWith('.ts')) {
    const made = `web/build/unit/${file.replace('.ts', '.js')}`;
    return { builds: [['npx', 'tsc', '--project', 'web/tsconfig.unit.json', '--incremental']], runs: [...node, made] };
  }
  const npm = (workspace) => ['npm', 'run', 'build', '--workspace', workspace];
  if (file.startsWith('wasm/')) return { builds: [build('sillon'), npm('wasm')], runs: [...node, file] };
  if (test === 'serve.test.js') return { builds: [], runs: [...node, file] };
  if (file.startsWith('web/')) return { builds: [build('sillon'), npm('wasm'), npm('web')], runs: [...node, file] };
  return { builds: [build('sillon', 'stages', 'sillon_bench')], runs: [...node, file] };
}

/** Checks out the last commit, with the packages and the engine of this checkout. */
function prepare(native) {
  const git = (folder, ...args) => spawnSync('git', ['-C', folder, ...args], { encoding: 'utf8' });
  const commit = git(root, 'rev-parse', 'HEAD').stdout.trim();
  if (!existsSync(join(scratch, '.git'))) git(root, 'worktree', 'add', '--quiet', '--force', '--detach', scratch, commit);
  const { status, stderr } = git(scratch, 'checkout', '--quiet', '--force', '--detach', commit);
  if (status !== 0) throw new Error(stderr);
  const harfbuzz = readdirSync(join(root, 'build')).find((name) => /^harfbuzz-[\d.]+$/.test(name));
  must('cmake', '--preset', 'release', ...(harfbuzz ? [`-DSILLON_HARFBUZZ=${join(root, 'build', harfbuzz)}`] : []));
  if (native) return;
  // Packages are links, but for our own two, which must be those of the checkout.
  const packages = join(scratch, 'node_modules');
  mkdirSync(packages, { recursive: true });
  for (const name of readdirSync(join(root, 'node_modules'))) {
    if (existsSync(join(packages, name))) continue;
    const own = { sillon: '../wasm', 'sillon-studio': '../web' }[name];
    symlinkSync(own ?? join(root, 'node_modules', name), join(packages, name));
  }
  if (!existsSync(join(scratch, 'wasm/dist/engine'))) cpSync(join(root, 'wasm/dist'), join(scratch, 'wasm/dist'), { recursive: true });
}

/** Builds that hold, by their commands: compilers of TypeScript take long to see that nothing has changed. */
const done = new Set();
const built = ({ builds }) =>
  builds.every((command) => done.has(command.join(' ')) || (run(...command) && done.add(command.join(' '))));

/** Makes one break, and takes it back. @returns what came of it; 'fails' is what should */
function tryBreak({ file, text, broken }, steps) {
  const path = join(scratch, file);
  const whole = readFileSync(path, 'utf8');
  writeFileSync(path, whole.replace(text, () => broken));
  done.clear();
  try {
    if (!built(steps)) return 'DOES NOT BUILD';
    return run(...steps.runs) ? 'UNNOTICED' : 'fails';
  } finally {
    writeFileSync(path, whole);
    done.clear();
  }
}

const options = process.argv.slice(2);
const words = options.filter((word) => !word.startsWith('--'));
const native = options.includes('--native');
const chosen = breaks.filter(
  (line) =>
    (!native || isNative(line)) &&
    (words.length === 0 || words.some((word) => [line.promise, line.test, line.file].join('\n').includes(word))),
);
if (chosen.length === 0) throw new Error(`no line of tests/promises.mjs has ${words.join(', ')}`);
const shown = ({ promise, test, file }) => `${promise.slice(0, 48).padEnd(48)}  ${test.padEnd(36)}  ${file}`;
if (options.includes('--list')) {
  for (const line of chosen) console.log(shown(line));
  process.exit();
}
prepare(chosen.every(isNative));
const seconds = (begin) => `${Math.round((Date.now() - begin) / 1000)} s`.padStart(6);
const tell = (came, begin, what) => {
  console.log(`${came.padEnd(14)} ${seconds(begin)}  ${what}`);
  if (came === 'passes' || came === 'fails') return;
  process.exitCode = 1;
  console.log(said.trim().split('\n').slice(-20).join('\n'));
};

// A test that fails anyhow notices nothing.
const whole = new Map();
for (const line of chosen) {
  const steps = plan(line);
  const name = steps.runs.join(' ');
  if (whole.has(name)) continue;
  const begin = Date.now();
  const ran = built(steps) && run(...steps.runs) && !/test cases: +0 |^# pass 0$/m.test(said);
  whole.set(name, ran);
  tell(whole.get(name) ? 'passes' : 'FAILS UNBROKEN', begin, name);
}
for (const line of chosen) {
  const steps = plan(line);
  const begin = Date.now();
  if (whole.get(steps.runs.join(' '))) tell(tryBreak(line, steps), begin, shown(line));
}
