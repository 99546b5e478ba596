// Runs the engine in a worker of its own. The file imports only types, because bundlers copy it as it stands.
import type * as api from '../../sillon.js';
import type {
  Call,
  Failure,
  Files,
  FromWorker,
  Known,
  KnownFile,
  Path,
  ReadingFields,
  StartMessage,
  ToWorker,
} from '../protocol.js';

type Outcome<T> = { value: T; error?: undefined } | { value?: undefined; error: Failure };
type OnProgress = (stage: string, fraction: number) => void;
type Inputs = Record<string, Uint8Array | api.Picture>;
type CopiedBytes = Uint8Array<ArrayBuffer>;

/** Functions of wasm/bindings.hpp. */
interface SillonModule {
  start(threads: number, most: number, poll: (() => boolean) | null): Outcome<{ version: string; cancelFlag: number }>;
  generateToolpath(
    project: string,
    files: Inputs,
    measure: boolean,
    across: boolean,
    number: number,
    onProgress: OnProgress,
  ): Outcome<Omit<api.ToolpathResult, 'report'> & { report: string }>;
  writeGcode(
    toolpath: Path,
    below: Path | undefined,
    project: string,
    date: string,
    number: number,
    onChunk: (bytes: CopiedBytes) => boolean,
  ): Outcome<api.GcodeSummary>;
  writeBaseBody(shape: api.Shape, project: string, stl: boolean): Outcome<CopiedBytes>;
  writeSvg(toolpath: Path): Outcome<CopiedBytes>;
  writeView(toolpath: Path, colour: number[], slopeAlong: number, slopeAcross: number): Outcome<CopiedBytes>;
  renderPreview(
    toolpath: Path,
    width: number,
    light: [number, number],
    colour: [number, number, number],
    slopes: [number, number],
    lookOnly: boolean,
    onProgress: OnProgress,
  ): Outcome<CopiedBytes>;
  readShape(project: string, files: Inputs): Outcome<api.Shape>;
  placeLayers(project: string, files: Inputs): Outcome<api.PlacedLayer[]>;
  drawLayers(project: string, files: Inputs, onProgress: OnProgress): Outcome<api.DirectionRaster>;
  makeZones(
    project: string,
    files: Inputs,
    body: boolean,
    params: readonly number[],
    onProgress: OnProgress,
  ): Outcome<Omit<api.Zones, 'file'> & { file: CopiedBytes }>;
  linesOfDrawing(file: Uint8Array): Outcome<string[]>;
  decodePicture(file: Uint8Array, name: string): Outcome<api.Picture>;
  paintDrawing(files: Inputs, name: string): Outcome<api.Picture>;
  room(size: number): Outcome<Uint8Array>;
  keptNumbers(): Outcome<number[]>;
  readProject(json: string): Outcome<string>;
  writeProject(project: string): Outcome<string>;
  profiles(): Outcome<{ printers: PrinterText[]; filaments: PrinterText[] }>;
  importPrinter(name: string): Outcome<Omit<api.ImportedPrinter, 'printer'> & { project: string }>;
  checkGcode(project: string, number: number): Outcome<api.GcodeCheck>;
  examineBlock(block: string, project: string): Outcome<api.GcodeFinding[]>;
  packGcode(number: number): Outcome<CopiedBytes>;
  forgetPrint(): void;
  readPrint(): Outcome<undefined>;
  listSurfaces(onProgress: OnProgress): Outcome<api.SlicedFile>;
  printRelief(side: number, onProgress: OnProgress): Outcome<api.PrintRelief>;
  rebrush(
    project: string,
    files: Inputs,
    sides: string,
    fit: string,
    only: Float64Array,
    onProgress: OnProgress,
    onPiece: (bytes: CopiedBytes) => void,
  ): Outcome<Omit<api.Rebrushed, 'blob'>>;
  calibrate(
    kind: string,
    from: number | undefined,
    to: number | undefined,
    project: string,
    filament: api.ViewParams | undefined,
    date: string,
    pictureSide: number,
  ): Outcome<
    Omit<api.Calibration, 'blob' | 'picture' | 'setting'> & { bytes: CopiedBytes; png?: CopiedBytes; setting: string }
  >;
  readCoupon(
    picture: api.Picture,
    project: string,
    from: number | undefined,
    to: number | undefined,
    lampSize: number | undefined,
    lampElevation: number | undefined,
  ): Outcome<ReadCoupon>;
  joinReadings(readings: ReadingFields[], lampSize: number | undefined): Outcome<ReadCoupon>;
}

/** Reading with a file of one spool, 'measured'. */
type ReadCoupon = Omit<api.CouponReading, 'spool'> & { spools: string };

function withSpool({ spools, ...others }: ReadCoupon): api.CouponReading {
  const file = JSON.parse(spools) as { spools: Record<'measured', api.Spool> };
  return { ...others, spool: file.spools.measured };
}

/** A printer as the text of a project file. */
interface PrinterText {
  id: string;
  project: string;
}

/** The parts of the glue code's interface that are used here. */
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
  Worker: typeof Worker;
  createSillon?: Glue['default'];
}
const scope = globalThis as unknown as Scope;

const initialPages = 256; // the modules are linked with the same number
const progressEvery = 30; // [ms]
const aliveEvery = 1000; // [ms]
const pieceBytes = 4 * 2 ** 20;

const fatal: Failure['code'][] = ['OutOfMemory', 'Internal', 'Crashed']; // after these errors, the engine is not called again

let engine: SillonModule | undefined;
let mostKept = Infinity; // largest file that is not handed out in pieces [bytes]
let sharesLess = false; // true if threads share less memory than one thread would have
let mostPictures = 0; // limit on the samples of kept pictures [bytes]
let lastPost = 0;

function post(message: FromWorker): void {
  lastPost = performance.now();
  scope.postMessage(message, message.type === 'done' || message.type === 'piece' ? buffersOf(message) : []);
}

/** Returns the buffers in a value, which can be handed over without a copy. */
function buffersOf(value: unknown): ArrayBuffer[] {
  if (ArrayBuffer.isView(value)) return [value.buffer as ArrayBuffer];
  if (typeof value !== 'object' || value === null || value instanceof Blob) return [];
  return Object.values(value).flatMap(buffersOf);
}

// --- Stop --------------------------------------------------------------------------------------------------------------

let stopByte: Uint8Array | undefined; // 1 asks the running call to stop

const stopAsked = (): boolean => stopByte !== undefined && Atomics.load(stopByte, 0) !== 0;

/** Polls for a stop, in an engine with one thread, which calls it while it computes. */
function poll(): boolean {
  if (performance.now() - lastPost > aliveEvery) post({ type: 'alive' }); // some stages of large plates report no progress for long
  return stopAsked();
}

class Failed extends Error implements Failure {
  constructor(
    readonly code: Failure['code'],
    message: string,
    readonly reason: Failure['reason'] = '',
    readonly values: Failure['values'] = {},
  ) {
    super(message);
  }
}

/** Wraps other errors: traps, aborts, and JavaScript's own failures to allocate. */
function failed(problem: unknown, otherwise: Failure['code'], what: string): Failed {
  if (problem instanceof Failed) return problem;
  const text = String(problem);
  return /out of memory|OOM|allocat|typed array length/i.test(text)
    ? new Failed('OutOfMemory', `the engine ran out of memory: ${text}`)
    : new Failed(otherwise, `${what}: ${text}`);
}

// --- Start -------------------------------------------------------------------------------------------------------------

/** Compiles the module while it arrives, so that browsers can keep the compiled code for the next visit. If that
 * fails, it is fetched as a whole and examined: some servers do not give its type, and browsers do not tell other
 * reasons. */
async function compile(url: string): Promise<WebAssembly.Module> {
  return WebAssembly.compileStreaming(fetch(url)).catch(() => compileWhole(url));
}

/** Fetches the whole module and compiles it, with an error that tells what is wrong. */
async function compileWhole(url: string): Promise<WebAssembly.Module> {
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

/** Makes the glue code start its threads as modules. Before Emscripten 3.1.58 it starts them as classic scripts,
 * but Vite's development server adds an import to them, which only modules may have. Blobs stay classic, because
 * Chromium starts no modules from blobs in frames of opaque origin. */
function startThreadsAsModules(): void {
  scope.Worker = class extends scope.Worker {
    constructor(script: string | URL, options?: WorkerOptions) {
      super(script, String(script).startsWith('blob:') ? options : { type: 'module', ...options });
    }
  };
}

/** Loads the glue code of the engine. */
async function importGlue(url: string): Promise<Glue> {
  // Scripts that the page has kept contain the engine.
  const { createSillon } = scope;
  if (createSillon !== undefined) return { default: createSillon };
  try {
    return (await import(/* @vite-ignore */ /* webpackIgnore: true */ url)) as Glue;
  } catch (problem) {
    throw new Failed('LoadFailed', `${url} could not be loaded: ${String(problem)}`);
  }
}

/** Allocates memory for threads, as much as the system allows: phones refuse large maxima. @param wanted  [MiB] */
function sharedMemory(wanted: number): { memory: WebAssembly.Memory; mib: number } {
  for (const mib of [4096, 2048, 1024, 512, 256, 64].map((mib) => Math.min(mib, Math.floor(wanted)))) {
    try {
      return { memory: new WebAssembly.Memory({ initial: initialPages, maximum: 16 * mib, shared: true }), mib };
    } catch {
      continue;
    }
  }
  throw new Failed('OutOfMemory', 'the system gives no 64 MiB of memory that threads can share');
}

/** Limits the growth of the module's own memory, whose maximum is fixed when it is linked. The glue code takes a
 * failing growth for a lack of memory. */
function limitGrowth(exports: WebAssembly.Exports, most: number): void {
  for (const memory of Object.values(exports)) {
    if (!(memory instanceof WebAssembly.Memory)) continue;
    const grow = memory.grow.bind(memory);
    memory.grow = (pages) => {
      if (memory.buffer.byteLength + pages * 65536 > most * 2 ** 20) throw new RangeError('beyond the limit of memory');
      return grow(pages);
    };
  }
}

/** Starts the module, with its threads and its memory. */
async function start({
  threads,
  memory: most,
  script,
  wasm,
  threadScripts,
  compiled,
  stop,
}: StartMessage): Promise<void> {
  const { threadScript, mainScript } = threadScripts;
  if (threads > 1) startThreadsAsModules();
  mostKept = most * 2 ** 20;
  mostPictures = Math.min(128 * 2 ** 20, mostKept / 8);
  const [wasmModule, glue] = await Promise.all([
    compiled === undefined ? compile(wasm) : Promise.resolve(compiled),
    importGlue(script),
  ]);
  post({ type: 'loaded', compiled: wasmModule });

  const shared = threads > 1 ? sharedMemory(most) : undefined;
  const memory = shared?.memory;
  const instance = new Promise<SillonModule>((resolve, reject) => {
    const args: ModuleArguments = {
      instantiateWasm(imports, done) {
        WebAssembly.instantiate(wasmModule, imports).then((made) => {
          limitGrowth(made.exports, most);
          done(made, wasmModule);
        }, reject);
        return {}; // the exports arrive later
      },
      onAbort: reject,
      locateFile: (name) => (name.endsWith('.wasm') ? wasm : threadScript),
      print() {},
      printErr() {}, // errors are thrown as well
      mainScriptUrlOrBlob: mainScript,
    };
    if (memory !== undefined) Object.assign(args, { wasmMemory: memory, poolSize: threads - 1 });
    // The glue code throws an error of starting a thread at a place where only this handler sees it.
    scope.onerror = () => {
      reject(new Failed('LoadFailed', `${threadScript} could not be started as a thread`));
      return true; // handled here, so that the page does not hear of it
    };
    glue.default(args).then(resolve, reject);
  });
  const module = await instance.catch((problem: unknown) => {
    throw failed(problem, 'LoadFailed', `${script} and ${wasm} could not be started`);
  });
  scope.onerror = null;
  const bytes = (shared?.mib ?? most) * 2 ** 20;
  sharesLess = bytes < mostKept;
  const { version, cancelFlag } = valueOf(module.start(threads, bytes, memory === undefined ? poll : null));
  engine = module;
  stopByte = memory === undefined ? stop : new Uint8Array(memory.buffer, cancelFlag, 1);
  post({ type: 'started', version, stop: stopByte });
}

// --- Calls -------------------------------------------------------------------------------------------------------------

async function bytesOf(blob: Blob, name: string): Promise<Uint8Array> {
  try {
    return new Uint8Array(await blob.arrayBuffer());
  } catch (problem) {
    throw new Failed('InvalidFile', `${name} could not be read: ${String(problem)}`);
  }
}

/** Gets memory for a file. If threads share too little memory, the error is OutOfMemory, because the file is not at
 * fault. */
function roomFor(size: number, module: SillonModule): Uint8Array {
  const outcome = module.room(size);
  if (sharesLess && outcome.error?.code === 'TooLarge') outcome.error.code = 'OutOfMemory';
  return valueOf(outcome);
}

/** Returns the value of a call's part that the worker does not keep. */
function brought<T>({ number, value }: Known<T>): T {
  if (value === undefined) throw new Failed('Internal', `what has the number ${number} is not kept`);
  return value;
}

async function bytesIn(known: KnownFile): Promise<Uint8Array> {
  const file = brought(known);
  return file instanceof Blob ? bytesOf(file, 'file') : file;
}

/** Brings a file into the engine. A print may have 200 MB: it is copied in pieces and is never whole in JavaScript. */
async function bringIn(known: KnownFile, module: SillonModule): Promise<void> {
  const file = brought(known);
  if (!(file instanceof Blob)) {
    roomFor(file.length, module).set(file);
    return;
  }
  const room = roomFor(file.size, module);
  for (let at = 0; at < file.size; at += pieceBytes) {
    room.set(await bytesOf(file.slice(at, at + pieceBytes), 'file'), at);
  }
}

const sizeOf = (file: Blob | Uint8Array): number => (file instanceof Blob ? file.size : file.length);

/** Brings G-code into the module unless it is kept there. @returns its number; 0 if it was brought in */
async function gcodeIn(file: KnownFile, module: SillonModule): Promise<number> {
  if (file.value === undefined) return file.number;
  await bringIn(file, module);
  return 0;
}

let printInside = 0; // number of the print whose text the module keeps

/** Brings a print into the module, unless it is there: bringing and unpacking it takes as long as the calls
 * themselves. */
async function bringPrint(file: KnownFile, module: SillonModule): Promise<void> {
  if (file.value === undefined && file.number === printInside) return;
  printInside = 0;
  module.forgetPrint();
  await bringIn(file, module);
  valueOf(module.readPrint());
  printInside = file.number;
}

/** Pictures of the last calls, most recently used last. A user who changes a setting hands over the same files
 * again, and decoding one takes as long as making a small plate. */
const pictures = new Map<number, api.Picture>();

/** Returns the files of a call for the module, pictures decoded. */
async function inputsOf(files: Files, module: SillonModule): Promise<Inputs> {
  const inputs: Inputs = {};
  const before = new Map(pictures); // a new picture may push out one that this call needs
  for (const [name, known] of Object.entries(files)) {
    const kept = before.get(known.number);
    if (kept !== undefined) {
      inputs[name] = keep(known.number, kept);
      continue;
    }
    const given = brought(known);
    const file = given instanceof Blob ? await bytesOf(given, name) : given;
    inputs[name] = file instanceof Uint8Array ? decoded(file, name, known.number, module) : file;
    if (stopAsked()) throw new Failed('Cancelled', 'stopped');
  }
  return inputs;
}

/** Keeps a picture, and drops the least recently used ones beyond the limit. */
function keep(number: number, picture: api.Picture): api.Picture {
  if (number === 0) return picture;
  pictures.delete(number);
  pictures.set(number, picture);
  let size = 0;
  for (const { samples } of pictures.values()) size += samples.byteLength;
  for (const [oldest, { samples }] of pictures) {
    if (size <= mostPictures) break;
    pictures.delete(oldest);
    size -= samples.byteLength;
  }
  return picture;
}

/** Estimates an upper bound of the bytes of a file's samples: exact for a PNG, otherwise a guess from photographs. */
function samplesOf(bytes: Uint8Array): number {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const png = bytes.length > 24 && view.getUint32(0) === 0x89504e47;
  return 8 * (png ? view.getUint32(16) * view.getUint32(20) : 8 * bytes.length);
}

/** Decodes a picture. A file that is none, or too large to be kept, is returned as it is. */
function decoded(bytes: Uint8Array, name: string, number: number, module: SillonModule): Uint8Array | api.Picture {
  if (samplesOf(bytes) > mostPictures) return bytes;
  const { value: picture } = module.decodePicture(bytes, name);
  if (picture === undefined) return bytes; // a drawing, or broken; making the plate reports the error
  return keep(number, picture);
}

/** Returns the numbers for which the next call needs no value. */
const kept = (module: SillonModule): number[] => [
  ...valueOf(module.keptNumbers()),
  ...pictures.keys(),
  ...(printInside === 0 ? [] : [printInside]),
];

function valueOf<T>(outcome: Outcome<T>): T {
  if (outcome.error) {
    const { code, message, reason, values } = outcome.error;
    throw new Failed(code, message, reason, values);
  }
  return outcome.value;
}

const printerOf = (project: string): api.PrinterValues =>
  (JSON.parse(project) as { printer: api.PrinterValues }).printer;

/** Performs a call and returns its value. */
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
      const { project, measure, across, number } = call;
      const files = await inputsOf(call.files, module);
      const made = valueOf(module.generateToolpath(project, files, measure, across, number, onProgress));
      return { ...made, report: JSON.parse(made.report) as api.Report } satisfies api.ToolpathResult;
    }
    case 'writeGcode': {
      const { toolpath, below, project, date, number } = call;
      const pieces: CopiedBytes[] = [];
      let size = 0;
      const summary = valueOf(
        module.writeGcode(toolpath, below, project, date, number, (bytes) => {
          if (number === 0) {
            post({ type: 'piece', bytes });
          } else {
            size += bytes.length;
            if (size > mostKept) throw new Failed('OutOfMemory', `the file has more than ${mostKept / 2 ** 20} MiB`);
            pieces.push(bytes);
            if (performance.now() - lastPost > aliveEvery) post({ type: 'alive' });
          }
          return true;
        }),
      );
      return { blob: new Blob(pieces, { type: 'text/x-gcode' }), summary } satisfies api.Gcode;
    }
    case 'writeSvg':
      return new Blob([valueOf(module.writeSvg(call.toolpath))], { type: 'image/svg+xml' });
    case 'writeView': {
      const { colour, slopes } = call.params;
      const png = valueOf(module.writeView(call.toolpath, colour, slopes[0], slopes[1]));
      return new Blob([png], { type: 'image/png' });
    }
    case 'renderPreview': {
      const { width, panels, colour, slopes, lightAzimuth, lightElevation } = call.params;
      const light: [number, number] = [lightAzimuth, lightElevation];
      const png = valueOf(
        module.renderPreview(call.toolpath, width, light, colour, slopes, panels === 'look', onProgress),
      );
      return new Blob([png], { type: 'image/png' });
    }
    case 'readShape':
      return valueOf(module.readShape(call.project, await inputsOf(call.files, module)));
    case 'placeLayers':
      return valueOf(module.placeLayers(call.project, await inputsOf(call.files, module)));
    case 'drawLayers':
      return valueOf(module.drawLayers(call.project, await inputsOf(call.files, module), onProgress));
    case 'makeZones': {
      const files = await inputsOf(call.files, module);
      if (call.file !== undefined) await bringIn(call.file, module);
      const { height, most, least, layerHeight, face } = call;
      const body = call.file !== undefined;
      const params = [height, most, least, layerHeight, ...face];
      const made = valueOf(module.makeZones(call.project, files, body, params, onProgress));
      return { ...made, file: new Blob([made.file], { type: 'model/3mf' }) } satisfies api.Zones;
    }
    case 'linesOfDrawing':
      return valueOf(module.linesOfDrawing(await bytesIn(call.file)));
    case 'decodePicture':
      return valueOf(module.decodePicture(await bytesIn(call.file), 'file'));
    case 'paintDrawing':
      return valueOf(module.paintDrawing(await inputsOf(call.files, module), call.drawing));
    case 'readProject':
      return valueOf(module.readProject(call.project));
    case 'writeProject':
      return valueOf(module.writeProject(call.project));
    case 'profiles': {
      const { printers, filaments } = valueOf(module.profiles());
      const read = ({ id, project }: PrinterText): api.PrinterProfile => ({ id, printer: printerOf(project) });
      return { printers: printers.map(read), filaments: filaments.map(read) } satisfies api.Profiles;
    }
    case 'importPrinter': {
      await bringIn(call.file, module);
      const { project, ...others } = valueOf(module.importPrinter(call.printer));
      return { printer: printerOf(project), ...others } satisfies api.ImportedPrinter;
    }
    case 'checkGcode':
      return valueOf(module.checkGcode(call.project, await gcodeIn(call.file, module)));
    case 'examineBlock':
      return valueOf(module.examineBlock(call.block, call.project));
    case 'writeBaseBody': {
      const body = valueOf(module.writeBaseBody(call.shape, call.project, call.format === 'stl'));
      return new Blob([body], { type: `model/${call.format}` });
    }
    case 'packGcode':
      if (call.file.value !== undefined && sizeOf(call.file.value) === 0)
        throw new Failed('InvalidFile', 'file is empty; it must be G-code');
      return new Blob([valueOf(module.packGcode(await gcodeIn(call.file, module)))], { type: 'model/3mf' });
    case 'printRelief':
      await bringPrint(call.file, module);
      return valueOf(module.printRelief(call.side, onProgress));
    case 'listSurfaces':
      await bringPrint(call.file, module);
      return valueOf(module.listSurfaces(onProgress));
    case 'rebrush': {
      const files = await inputsOf(call.files, module);
      await bringPrint(call.file, module);
      const only = Float64Array.from(call.only);
      const pieces: Blob[] = []; // each piece leaves this worker's memory as soon as it exists
      const made = valueOf(
        module.rebrush(call.project, files, call.sides, call.fit, only, onProgress, (bytes) => {
          pieces.push(new Blob([bytes]));
        }),
      );
      return { blob: new Blob(pieces, { type: 'application/octet-stream' }), ...made } satisfies api.Rebrushed;
    }
    case 'calibrate': {
      const { kind, from, to, project, filament, date, pictureSide } = call;
      const made = valueOf(module.calibrate(kind, from, to, project, filament, date, pictureSide));
      const { bytes, png, setting, ...others } = made;
      return {
        blob: new Blob([bytes], { type: 'text/x-gcode' }),
        setting: setting.split(', '),
        ...others,
        ...(png !== undefined && { picture: new Blob([png], { type: 'image/png' }) }),
      } satisfies api.Calibration;
    }
    case 'readCoupon': {
      const { picture, project, from, to, lampSize, lampElevation } = call;
      return withSpool(valueOf(module.readCoupon(picture, project, from, to, lampSize, lampElevation)));
    }
    case 'joinReadings':
      return withSpool(valueOf(module.joinReadings(call.readings, call.lampSize)));
  }
}

/** Answers a message with `started`, `done` or `failed`. */
async function answer(message: ToWorker): Promise<void> {
  try {
    if (message.type === 'start') {
      await start(message);
    } else if (engine === undefined) {
      throw new Failed('Internal', 'a call came before the start');
    } else {
      const value = await perform(message.call, engine);
      post({ type: 'done', value, kept: kept(engine) });
    }
  } catch (problem) {
    const { code, message: text, reason, values } = failed(problem, 'Crashed', 'the engine stopped');
    const still = engine === undefined || fatal.includes(code) ? [] : kept(engine);
    post({ type: 'failed', code, message: text, reason, values, kept: still });
  }
}

scope.onmessage = ({ data }) => void answer(data);
