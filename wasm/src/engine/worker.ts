// Runs the engine in a worker of its own. One file that imports only types, since bundlers copy it as it stands.
import type * as api from '../../sillon.js';
import type { Call, Failure, Files, FromWorker, StartMessage, ToWorker, Wanted } from '../protocol.js';

type Outcome<T> = { value: T; error?: undefined } | { error: Failure };
type OnProgress = (stage: string, fraction: number) => void;
type Inputs = Record<string, Uint8Array | api.Picture>;
type CopiedBytes = Uint8Array<ArrayBuffer>;

/** wasm/plates.cpp, wasm/files.cpp and wasm/rebrush.cpp: of each module its part, and wasm/call.cpp. */
interface SillonModule {
  start(threads: number, poll: (() => boolean) | null): Outcome<{ version: string; cancelFlag: number }>;
  generateToolpath(
    project: string,
    files: Inputs,
    measure: boolean,
    onProgress: OnProgress,
  ): Outcome<{ toolpath: api.Toolpath; report: string }>;
  writeGcode(
    toolpath: api.Toolpath,
    project: string,
    date: string,
    onChunk: (bytes: CopiedBytes) => boolean,
  ): Outcome<api.GcodeSummary>;
  writeBaseBody(shape: api.Shape, project: string, stl: boolean): Outcome<CopiedBytes>;
  writeSvg(toolpath: api.Toolpath): Outcome<CopiedBytes>;
  writeView(toolpath: api.Toolpath, colour: number[], slopeAlong: number, slopeAcross: number): Outcome<CopiedBytes>;
  renderPreview(
    toolpath: api.Toolpath,
    width: number,
    lightAzimuth: number,
    lightElevation: number,
    onProgress: OnProgress,
  ): Outcome<CopiedBytes>;
  readShape(project: string, files: Inputs): Outcome<api.Shape>;
  decodePicture(file: Uint8Array, name: string): Outcome<api.Picture>;
  readProject(project: string): Outcome<string>;
  profiles(): Outcome<{ printers: PrinterText[]; filaments: PrinterText[] }>;
  importPrinter(file: Uint8Array, name: string): Outcome<Omit<api.ImportedPrinter, 'printer'> & { project: string }>;
  checkGcode(file: Uint8Array, project: string): Outcome<api.GcodeCheck>;
  examineBlock(block: string, project: string): Outcome<api.GcodeFinding[]>;
  packGcode(file: Uint8Array): Outcome<CopiedBytes>;
  printRelief(file: Uint8Array, side: number): Outcome<api.PrintRelief>;
  listSurfaces(file: Uint8Array): Outcome<api.SlicedFile>;
  rebrush(
    file: Uint8Array,
    project: string,
    files: Inputs,
    sides: string,
    fit: string,
    only: Float64Array,
    onProgress: OnProgress,
  ): Outcome<Omit<api.Rebrushed, 'blob'> & { bytes: CopiedBytes }>;
}

/** A printer as the text of a project file. */
interface PrinterText {
  id: string;
  project: string;
}

/** The part of the glue code's interface that is used. */
interface ModuleArguments {
  instantiateWasm(
    imports: WebAssembly.Imports,
    done: (instance: WebAssembly.Instance, compiled: WebAssembly.Module) => void,
  ): object;
  onAbort(what: unknown): void;
  locateFile(name: string): string;
  print(text: string): void;
  printErr(text: string): void;
  mainScriptUrlOrBlob: string;
  wasmMemory?: WebAssembly.Memory;
  poolSize?: number;
}
interface Glue {
  default: (args: ModuleArguments) => Promise<SillonModule>;
}

interface Scope {
  onerror: (() => boolean) | null;
  onmessage: ((event: { data: ToWorker }) => void) | null;
  postMessage(message: FromWorker, transfer: ArrayBuffer[]): void;
}
const scope = globalThis as unknown as Scope;

const initialPages = 256; // as the modules are linked
const progressEvery = 30; // [ms]
const aliveEvery = 1000; // [ms]
const fetchEvery = 50; // [ms]; a fetch takes 1 to 3

let engine: SillonModule | undefined;
let lastPost = 0;

function post(message: FromWorker): void {
  lastPost = performance.now();
  scope.postMessage(message, message.type === 'done' || message.type === 'piece' ? buffersOf(message) : []);
}

/** What can be handed over without a copy. */
function buffersOf(value: unknown): ArrayBuffer[] {
  if (ArrayBuffer.isView(value)) return [value.buffer as ArrayBuffer];
  if (typeof value !== 'object' || value === null || value instanceof Blob) return [];
  return Object.values(value).flatMap(buffersOf);
}

// --- Stop --------------------------------------------------------------------------------------------------------------

let wanted: Wanted;
let lastFetch = 0;

/** Messages do not get into a worker that computes, but synchronous requests get out. */
function canFetch(url: string): boolean {
  try {
    const request = new XMLHttpRequest();
    request.open('GET', url, false);
    request.send();
    return true;
  } catch {
    return false;
  }
}

/** What a call begins with. An address that cannot be fetched now (policies may forbid it) tells nothing later. */
function want(by: Wanted): void {
  wanted = typeof by === 'string' && !canFetch(by) ? undefined : by;
  lastFetch = performance.now();
}

function stopAsked(): boolean {
  if (wanted === undefined) return false;
  if (typeof wanted !== 'string') return Atomics.load(wanted, 0) !== 0;
  const now = performance.now();
  if (now - lastFetch < fetchEvery) return false;
  const gone = !canFetch(wanted);
  lastFetch = performance.now();
  return gone;
}

class Failed extends Error implements Failure {
  constructor(
    readonly code: Failure['code'],
    message: string,
  ) {
    super(message);
  }
}

/** What else is thrown: traps, aborts, and JavaScript's own failures to allocate. */
function failed(problem: unknown, otherwise: Failure['code'], what: string): Failed {
  if (problem instanceof Failed) return problem;
  const text = String(problem);
  return /out of memory|OOM|allocat|typed array length/i.test(text)
    ? new Failed('OutOfMemory', `the engine ran out of memory: ${text}`)
    : new Failed(otherwise, `${what}: ${text}`);
}

// --- Start -------------------------------------------------------------------------------------------------------------

async function compile(url: string): Promise<WebAssembly.Module> {
  let response: Response;
  let bytes: Uint8Array<ArrayBuffer>;
  try {
    response = await fetch(url);
    bytes = new Uint8Array(await response.arrayBuffer());
  } catch (problem) {
    throw new Failed('LoadFailed', `${url} could not be fetched: ${String(problem)}`);
  }
  if (!response.ok) throw new Failed('LoadFailed', `${url} could not be fetched: status ${response.status}`);
  if (String(bytes.subarray(0, 4)) !== '0,97,115,109') {
    const type = response.headers.get('content-type') ?? 'of unknown type';
    throw new Failed('LoadFailed', `${url} is no WebAssembly: it came as ${type}, ${bytes.length} bytes`);
  }
  try {
    return await WebAssembly.compile(bytes);
  } catch (problem) {
    throw new Failed('LoadFailed', `${url} could not be compiled: ${String(problem)}`);
  }
}

async function importGlue(url: string): Promise<Glue> {
  try {
    return (await import(/* @vite-ignore */ /* webpackIgnore: true */ url)) as Glue;
  } catch (problem) {
    throw new Failed('LoadFailed', `${url} could not be loaded: ${String(problem)}`);
  }
}

/** As much as the system lets threads share: phones refuse large maxima. */
function sharedMemory(): WebAssembly.Memory {
  for (const mib of [1024, 512, 256, 64]) {
    try {
      return new WebAssembly.Memory({ initial: initialPages, maximum: 16 * mib, shared: true });
    } catch {
      continue;
    }
  }
  throw new Failed('OutOfMemory', 'the system gives no 64 MiB of memory that threads can share');
}

async function start({ threads, script, wasm, threadScript, compiled }: StartMessage): Promise<void> {
  const wasmModule = compiled ?? (await compile(wasm));
  const glue = await importGlue(script);
  post({ type: 'loaded', compiled: wasmModule });

  const memory = threads > 1 ? sharedMemory() : undefined;
  const instance = new Promise<SillonModule>((resolve, reject) => {
    const args: ModuleArguments = {
      instantiateWasm(imports, done) {
        WebAssembly.instantiate(wasmModule, imports).then((made) => {
          done(made, wasmModule);
        }, reject);
        return {}; // what it exports comes later
      },
      onAbort: reject,
      locateFile: (name) => (name.endsWith('.wasm') ? wasm : threadScript),
      print() {},
      printErr() {}, // what goes wrong is thrown as well
      mainScriptUrlOrBlob: script,
    };
    if (memory !== undefined) Object.assign(args, { wasmMemory: memory, poolSize: threads - 1 });
    // The glue code throws what keeps a thread from starting, where only this sees it.
    scope.onerror = () => {
      reject(new Failed('LoadFailed', `${threadScript} could not be started as a thread`));
      return true; // handled: the page need not hear of it
    };
    glue.default(args).then(resolve, reject);
  });
  const module = await instance.catch((problem: unknown) => {
    throw failed(problem, 'LoadFailed', `${script} and ${wasm} could not be started`);
  });
  scope.onerror = null;
  const { version, cancelFlag } = valueOf(module.start(threads, memory === undefined ? stopAsked : null));
  engine = module;
  post({
    type: 'started',
    version,
    cancelFlag: memory === undefined ? undefined : new Uint8Array(memory.buffer, cancelFlag, 1),
  });
}

// --- Calls -------------------------------------------------------------------------------------------------------------

async function bytesOf(blob: Blob, name: string): Promise<Uint8Array> {
  try {
    return new Uint8Array(await blob.arrayBuffer());
  } catch (problem) {
    throw new Failed('InvalidFile', `${name} could not be read: ${String(problem)}`);
  }
}

async function inputsOf(files: Files): Promise<Inputs> {
  const inputs: Inputs = {};
  for (const [name, file] of Object.entries(files)) {
    inputs[name] = file instanceof Blob ? await bytesOf(file, name) : file;
  }
  return inputs;
}

function valueOf<T>(outcome: Outcome<T>): T {
  if (outcome.error) throw new Failed(outcome.error.code, outcome.error.message);
  return outcome.value;
}

const printerOf = (project: string): api.PrinterValues =>
  (JSON.parse(project) as { printer: api.PrinterValues }).printer;

/** A project made of arguments: what is wrong in it is no file's fault. */
function completed(project: string, module: SillonModule): string {
  const outcome = module.readProject(project);
  if (outcome.error?.code === 'InvalidFile') outcome.error.code = 'InvalidArgument';
  return valueOf(outcome);
}

async function perform(call: Call, module: SillonModule): Promise<unknown> {
  let lastProgress = -Infinity;
  const onProgress: OnProgress = (stage, fraction) => {
    const now = performance.now();
    if (now - lastProgress < progressEvery) return;
    lastProgress = now;
    post({ type: 'progress', stage, fraction });
  };

  switch (call.name) {
    case 'generateToolpath': {
      completed(call.project, module);
      const files = await inputsOf(call.files);
      const made = valueOf(module.generateToolpath(call.project, files, call.measure, onProgress));
      return { toolpath: made.toolpath, report: JSON.parse(made.report) as api.Report } satisfies api.Plate;
    }
    case 'writeGcode': {
      completed(call.project, module);
      const kept: CopiedBytes[] = [];
      const summary = valueOf(
        module.writeGcode(call.toolpath, call.project, call.date, (bytes) => {
          if (call.inPieces) {
            post({ type: 'piece', bytes });
          } else {
            kept.push(bytes);
            if (performance.now() - lastPost > aliveEvery) post({ type: 'alive' });
          }
          return true;
        }),
      );
      return { blob: new Blob(kept, { type: 'text/x-gcode' }), summary } satisfies api.Gcode;
    }
    case 'writeSvg':
      return new Blob([valueOf(module.writeSvg(call.toolpath))], { type: 'image/svg+xml' });
    case 'writeView': {
      const { colour, slopes } = call.params;
      const png = valueOf(module.writeView(call.toolpath, colour, slopes[0], slopes[1]));
      return new Blob([png], { type: 'image/png' });
    }
    case 'renderPreview': {
      const { width, lightAzimuth, lightElevation } = call.params;
      const png = valueOf(module.renderPreview(call.toolpath, width, lightAzimuth, lightElevation, onProgress));
      return new Blob([png], { type: 'image/png' });
    }
    case 'readShape':
      completed(call.project, module);
      return valueOf(module.readShape(call.project, await inputsOf(call.files)));
    case 'decodePicture': {
      const bytes = call.file instanceof Blob ? await bytesOf(call.file, 'file') : call.file;
      return valueOf(module.decodePicture(bytes, 'file'));
    }
    case 'readProject':
      return valueOf(module.readProject(call.project));
    case 'writeProject':
      return completed(call.project, module);
    case 'profiles': {
      const { printers, filaments } = valueOf(module.profiles());
      const read = ({ id, project }: PrinterText): api.PrinterProfile => ({ id, printer: printerOf(project) });
      return { printers: printers.map(read), filaments: filaments.map(read) } satisfies api.Profiles;
    }
    case 'importPrinter': {
      const file = call.file instanceof Blob ? await bytesOf(call.file, 'file') : call.file;
      const { project, ...others } = valueOf(module.importPrinter(file, call.printer));
      return { printer: printerOf(project), ...others } satisfies api.ImportedPrinter;
    }
    case 'checkGcode': {
      if (call.project !== '') completed(call.project, module);
      const file = call.file instanceof Blob ? await bytesOf(call.file, 'file') : call.file;
      return valueOf(module.checkGcode(file, call.project));
    }
    case 'examineBlock':
      completed(call.project, module);
      return valueOf(module.examineBlock(call.block, call.project));
    case 'writeBaseBody': {
      const body = valueOf(module.writeBaseBody(call.shape, call.project, call.format === 'stl'));
      return new Blob([body], { type: `model/${call.format}` });
    }
    case 'packGcode': {
      const file = call.file instanceof Blob ? await bytesOf(call.file, 'file') : call.file;
      return new Blob([valueOf(module.packGcode(file))], { type: 'model/3mf' });
    }
    case 'printRelief': {
      const file = call.file instanceof Blob ? await bytesOf(call.file, 'file') : call.file;
      return valueOf(module.printRelief(file, call.side));
    }
    case 'listSurfaces': {
      const file = call.file instanceof Blob ? await bytesOf(call.file, 'file') : call.file;
      return valueOf(module.listSurfaces(file));
    }
    case 'rebrush': {
      completed(call.project, module);
      const file = call.file instanceof Blob ? await bytesOf(call.file, 'file') : call.file;
      const files = await inputsOf(call.files);
      const only = Float64Array.from(call.only);
      const made = valueOf(module.rebrush(file, call.project, files, call.sides, call.fit, only, onProgress));
      const { bytes, ...others } = made;
      return { blob: new Blob([bytes], { type: 'application/octet-stream' }), ...others } satisfies api.Rebrushed;
    }
  }
}

async function answer(message: ToWorker): Promise<void> {
  try {
    if (message.type === 'start') {
      await start(message);
    } else if (engine === undefined) {
      throw new Failed('Internal', 'a call came before the start');
    } else {
      want(message.wanted);
      post({ type: 'done', value: await perform(message.call, engine) });
    }
  } catch (problem) {
    const { code, message: text } = failed(problem, 'Crashed', 'the engine stopped');
    post({ type: 'failed', code, message: text });
  }
}

scope.onmessage = ({ data }) => void answer(data);
