// The tests' tasks, as a page of some site does them, or its worker, or a frame in it.
import { drawPlate, inputOf, makePlate } from '/support/plate.js';

/** More than a second of work. */
const large = [
  { shape: { builtin: 'rounded', size: [150, 150] }, layers: [{ kind: 'direction', angle: 30 }] },
  { spacing: 0.2 },
];
/** Minutes of work on any machine of today: longer than a test waits. */
const endless = [
  { shape: { builtin: 'rounded', size: [200, 200] }, layers: [{ kind: 'direction', angle: 30 }] },
  { spacing: 0.2, sweepsPerLevel: 1000, relaxationRounds: 100 },
];
const lettered = [
  {
    shape: { builtin: 'disc', size: [30, 30] },
    layers: [
      { kind: 'text', text: 'ANNA', textSize: 5, at: [15, 6] },
      { kind: 'code', text: 'x', size: [12, 12], at: [15, 18] },
    ],
  },
];
const small = [{ shape: { builtin: 'disc', size: [10, 10] } }, {}, { measure: false }];

const tasks = { plate, plates, plateInWorker, plateInFrame, coldPlate, abort, work, load, edit };

/** A task's value, or what is to be seen of its error: errors lose their fields on the way out of a page. */
globalThis.attempt = async (name, args) => {
  try {
    return { value: await tasks[name](args) };
  } catch ({ name, code, message, hint }) {
    return { error: { name, code, message, hint } };
  }
};

// A browser without remote control names the task in the page's address, and takes the outcome from that of the next page.
if (location.hash !== '') {
  const { task, args, relay } = JSON.parse(decodeURIComponent(location.hash.slice(1)));
  void globalThis.attempt(task, args).then((outcome) => {
    location.replace(`${relay}#${encodeURIComponent(JSON.stringify(outcome))}`);
  });
}

async function readFile(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: status ${response.status}`);
  return response.blob();
}

/** @param library  address of the package's entry */
async function start({ library = '/sillon/dist/index.js', options }) {
  const { createEngine } = await import(library);
  return createEngine(options);
}

async function plate({ library, options, project }) {
  const engine = await start({ library, options });
  try {
    const url = new URL(project, location.href);
    const json = await (await readFile(url)).text();
    const made = await makePlate(engine, json, (name) => readFile(new URL(name, url)));
    return { origin: self.origin, ...engine.info, ...made };
  } finally {
    engine.dispose();
  }
}

/** Draws several projects with one engine, one after the other. */
async function plates({ options, projects }) {
  const engine = await start({ options });
  try {
    const drawn = [];
    for (const project of projects) {
      const url = new URL(project, location.href);
      const json = await (await readFile(url)).text();
      drawn.push(await drawPlate(engine, json, (name) => readFile(new URL(name, url))));
    }
    return { ...engine.info, drawn };
  } finally {
    engine.dispose();
  }
}

/** Milliseconds since the page was asked for until its first plate. */
async function coldPlate({ options, project }) {
  const engine = await start({ options });
  const started = performance.now();
  const url = new URL(project, location.href);
  const description = await engine.readProject(await (await readFile(url)).text());
  const input = await inputOf(description, (name) => readFile(new URL(name, url)));
  await engine.generateToolpath(input, description.toolpath, { measure: false });
  const finished = performance.now();
  engine.dispose();
  return { started, finished };
}

/** Aborts two endless jobs; tells whether the first was rejected within the task that aborted it. Between them the engine
 * makes a small plate: had the first job gone on, that would have to wait for it. */
async function abort({ options }) {
  const engine = await start({ options });
  const controller = new AbortController();
  let running;
  const atWork = new Promise((resolve) => {
    const onProgress = ({ fraction }) => fraction > 0 && resolve();
    running = engine.generateToolpath(...endless, { measure: false, signal: controller.signal, onProgress });
  });
  await Promise.race([atWork, running]);

  let later = false;
  setTimeout(() => (later = true));
  controller.abort();
  const outcome = await running.then(
    () => 'finished',
    (problem) => problem.name,
  );
  const atOnce = !later;
  const { report } = await engine.generateToolpath(...small);

  // A job that nothing follows.
  const last = new AbortController();
  const unfinished = engine.generateToolpath(...endless, {
    measure: false,
    signal: last.signal,
    onProgress: () => last.abort(),
  });
  await unfinished.catch(() => undefined);
  globalThis.kept = engine;
  return { ...engine.info, outcome, atOnce, digest: report.digest };
}

/** A plate with letters and a code, by an engine that is kept and rests at once, and the scripts that it holds from then on. */
async function load({ options }) {
  const engine = await start({ options: { ...options, idleTimeout: 0 } });
  globalThis.kept = engine;
  const { report } = await engine.generateToolpath(...lettered);
  // By whoever holds them: the worker itself is no fetch.
  const holds = () =>
    performance
      .getEntriesByType('resource')
      .some(
        ({ initiatorType, name, responseEnd }) => initiatorType === 'fetch' && /worker\.js$/.test(name) && responseEnd,
      );
  while (!holds()) await new Promise((resolve) => setTimeout(resolve, 20));
  return { ...engine.info, digest: report.digest };
}

/** Ten hasty edits of it, each of which stops the one before; then a call that another worker starts for. */
async function edit() {
  const engine = globalThis.kept;
  for (let k = 0; k < 10; ++k) {
    const controller = new AbortController();
    const { signal } = controller;
    const onProgress = () => controller.abort();
    const stopped = engine.generateToolpath(...endless, { measure: false, signal, onProgress });
    const name = await stopped.then(String, (problem) => problem.name);
    if (name !== 'AbortError') throw new Error(`edit ${k}: ${name}`);
    await engine.generateToolpath(...small);
  }
  const { report } = await engine.generateToolpath(...lettered);
  const findings = await engine.examineBlock('G28');
  return { ...engine.info, digest: report.digest, findings: findings.length };
}

/** A large job, to its end. */
async function work({ options }) {
  const engine = await start({ options });
  const { toolpath, report } = await engine.generateToolpath(...large, { measure: false });
  const { summary } = await engine.writeGcode(toolpath);
  globalThis.kept = engine;
  return { points: report.points, bytes: summary.bytes };
}

/** `plate` in a worker that this page starts. */
async function plateInWorker(args) {
  const worker = new Worker(import.meta.url, { type: 'module' });
  const failed = new Promise((_, reject) => {
    worker.onerror = ({ message }) => reject(new Error(`the page's worker failed: ${message}`));
  });
  try {
    return await Promise.race([askPlate(worker, args), failed]);
  } finally {
    worker.terminate();
  }
}

/** `plate` in a sandboxed frame of this page. */
async function plateInFrame(args) {
  const frame = document.createElement('iframe');
  frame.sandbox = 'allow-scripts';
  frame.src = location.pathname;
  const loaded = new Promise((resolve) => (frame.onload = resolve));
  document.body.append(frame);
  await loaded;
  const plate = await askPlate(
    { postMessage: (message, transfer) => frame.contentWindow.postMessage(message, '*', transfer) },
    args,
  );
  frame.remove();
  return plate;
}

async function askPlate(target, args) {
  const { port1, port2 } = new MessageChannel();
  target.postMessage(args, [port2]);
  const { value, error } = await new Promise((resolve) => (port1.onmessage = ({ data }) => resolve(data)));
  if (error) throw error;
  return value;
}

addEventListener('message', async ({ data, ports: [port] }) => {
  port.postMessage(await globalThis.attempt('plate', data));
});
