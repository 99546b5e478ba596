// The engine's interface for its users.
import type * as api from '../sillon.js';
import { invalid } from './errors.js';
import * as input from './input.js';
import type { Platform } from './platform.js';
import { beads, gcodes, memoryOf, newNumber } from './known.js';
import type { Call, Files } from './protocol.js';
import { Queue, type Threads, type ValueOf } from './queue.js';
import { Texts, needsTexts } from './texts.js';

const mostAutoThreads = 8;

/** Decides the number of threads, and gives a reason if it is smaller than asked for. */
function plan(asked: 'auto' | 'off' | number, platform: Platform): Threads {
  const wanted = asked === 'off' ? 1 : asked === 'auto' ? Math.min(mostAutoThreads, platform.cores()) : asked;
  const obstacle = wanted > 1 ? platform.obstacleToThreads() : '';
  if (obstacle === '') return { threads: wanted, reason: '', reasonCode: '' };
  return { threads: 1, reason: obstacle, reasonCode: 'NotIsolated' };
}

const mostThreadsAside = 2;

type PlateCall = Omit<Extract<Call, { name: 'generateToolpath' }>, 'name' | 'number'>;
type GcodeCall = Extract<Call, { name: 'checkGcode' | 'packGcode' }>;

/** Starts an engine with a worker for plates and, once needed, a second one for all other calls. */
export async function startEngine(platform: Platform, options: unknown): Promise<api.Engine> {
  const { threads: asked, assetBase, idleTimeout, memory } = input.engineOptions(options);
  const assets = platform.files(assetBase);
  const threads = plan(asked, platform);
  const plates = new Queue(platform, assets, idleTimeout, memory, threads);
  await plates.start();
  // A worker of its own for calls that need no plate, so that none of them waits for one. Its first call starts it.
  const few = { ...threads, threads: Math.min(mostThreadsAside, threads.threads) };
  const aside = new Queue(platform, assets, idleTimeout, memory, few, plates);

  // Asynchronous functions turn errors thrown by `input` into rejections. They run up to their first await when they
  // are called, so that calls enter the queue in order.
  const runAside: Queue['run'] = (call, options) => aside.run(call, options);
  const run: Queue['run'] = (call, options) => plates.run(call, options);
  /** Runs a call in the worker that has its file already, if that worker is idle. */
  const runOnGcode = <C extends GcodeCall>(call: C, options: input.CallOptions): Promise<ValueOf<C['name']>> =>
    (plates.has(call.file.number) ? plates : aside).run(call, options);
  const texts = new Texts(platform, assets, (file) =>
    runAside({ name: 'linesOfDrawing', file: { number: 0, value: file } }, {}),
  );

  /** Calls `use` with a plate's project and files: at once, or as soon as its letters are there.
   * @param more  further sections of the project */
  const withPlate = <Value>(
    given: unknown,
    more: Record<string, unknown>,
    use: (project: string, files: Files) => Promise<Value>,
  ): Promise<Value> => {
    const { sections, files } = input.plate(given);
    const project = input.projectText({ ...sections, ...more });
    return needsTexts(sections, files)
      ? texts.addTo(files, sections).then(() => use(project, files))
      : use(project, files);
  };
  const make = async (call: PlateCall, options: input.CallOptions): Promise<api.ToolpathResult> => {
    const number = newNumber();
    const made = await run({ ...call, name: 'generateToolpath', number }, options);
    const { cycles } = made.toolpath;
    beads.mark(cycles, number, memoryOf(cycles));
    return made;
  };
  return {
    get info() {
      return plates.info;
    },

    async generateToolpath(plate, params, options) {
      const { measure = true, across = false, ...others } = input.callOptions(options, ['measure', 'across']);
      return withPlate(plate, { toolpath: input.section(params, 'params') }, (project, files) =>
        make({ project, files, measure: measure && !across, across }, others),
      );
    },

    async warm(options) {
      const checked = input.callOptions(options);
      // Browsers optimise code after it has run for a while: some thirty beads are enough, and take no longer than they
      // save.
      const plate = { shape: { builtin: 'disc', size: [12, 12] }, layers: [{ kind: 'direction', angle: 30 }] };
      await withPlate(plate, {}, (project, files) => make({ project, files, measure: true, across: false }, checked));
    },

    async writeGcode(toolpath, printer, print, options) {
      const { below, ...checked } = input.callOptions(options, ['onChunk', 'below']);
      const { date, ...others } = input.section(print, 'print');
      const number = checked.onChunk === undefined ? newNumber() : 0;
      const call: Call = {
        name: 'writeGcode',
        toolpath: input.toolpath(toolpath),
        below: below === undefined ? undefined : input.toolpath(below, 'below'),
        project: input.projectText({ print: others, printer: input.section(printer, 'printer') }),
        date: input.date(date),
        number,
      };
      const written = await run(call, checked);
      if (number !== 0) gcodes.mark(written.blob, number);
      return written;
    },

    async writeBaseBody(given, printer, print, options) {
      const checked = input.callOptions(options, ['format']);
      const project = input.projectText({
        print: { ...input.section(print, 'print'), date: undefined },
        printer: input.section(printer, 'printer'),
      });
      const [shape, format] = [input.shape(given, 'shape'), input.bodyFormat(checked.format)];
      return run({ name: 'writeBaseBody', shape, project, format }, checked);
    },

    async writeSvg(toolpath, options) {
      return run({ name: 'writeSvg', toolpath: input.toolpath(toolpath) }, input.callOptions(options));
    },

    async writeView(given, params, options) {
      const toolpath = input.toolpath(given);
      return run({ name: 'writeView', toolpath, params: input.viewParams(params) }, input.callOptions(options));
    },

    async renderPreview(given, params, options) {
      const toolpath = input.toolpath(given);
      return run({ name: 'renderPreview', toolpath, params: input.previewParams(params) }, input.callOptions(options));
    },

    async readShape(shape, layers, options) {
      const checked = input.callOptions(options);
      return withPlate({ shape, layers }, {}, (project, files) =>
        runAside({ name: 'readShape', project, files }, checked),
      );
    },

    async placeLayers(plate, params, options) {
      const checked = input.callOptions(options);
      return withPlate(plate, { toolpath: input.section(params, 'params') }, (project, files) =>
        runAside({ name: 'placeLayers', project, files }, checked),
      );
    },

    async drawLayers(plate, params, options) {
      const checked = input.callOptions(options);
      return withPlate(plate, { toolpath: input.section(params, 'params') }, (project, files) =>
        runAside({ name: 'drawLayers', project, files }, checked),
      );
    },

    async makeZones(plate, how, options) {
      const checked = input.callOptions(options);
      const zones = input.zoneOptions(how);
      return withPlate(plate, {}, (project, files) =>
        runAside({ name: 'makeZones', project, files, ...zones }, checked),
      );
    },

    async decodePicture(file, options) {
      return run({ name: 'decodePicture', file: input.bytesFile(file) }, input.callOptions(options));
    },

    async paintDrawing(file, options) {
      const checked = input.callOptions(options);
      const drawing = 'layers[0].file'; // letters of drawings are searched where layers have drawings
      const files: Files = { [drawing]: input.bytesFile(file) };
      const sections = { layers: [{ kind: 'tones' }] };
      if (needsTexts(sections, files)) await texts.addTo(files, sections);
      return runAside({ name: 'paintDrawing', files, drawing }, checked);
    },

    async readProject(json, options) {
      const text = await run({ name: 'readProject', project: input.projectJson(json) }, input.callOptions(options));
      const project = JSON.parse(text) as api.Project;
      const { seed } = project.toolpath;
      if (!Number.isSafeInteger(seed)) {
        throw invalid(`toolpath.seed is ${seed}; in JavaScript it must be 0 to ${Number.MAX_SAFE_INTEGER}`);
      }
      return project;
    },

    async writeProject(given, options) {
      const project = input.projectText(input.project(given));
      return run({ name: 'writeProject', project }, input.callOptions(options));
    },

    async profiles(options) {
      return run({ name: 'profiles' }, input.callOptions(options));
    },

    async importPrinter(given, name, options) {
      const [file, printer] = [input.bytesFile(given), input.printerName(name)];
      return runAside({ name: 'importPrinter', file, printer }, input.callOptions(options));
    },

    async checkGcode(given, printer, options) {
      const project = printer === undefined ? '' : input.projectText({ printer: input.section(printer, 'printer') });
      return runOnGcode({ name: 'checkGcode', file: input.gcode(given), project }, input.callOptions(options));
    },

    async examineBlock(given, flavor, options) {
      const printer = flavor === undefined ? {} : { flavor };
      const project = input.projectText({ printer: input.section(printer, 'printer') });
      return runAside({ name: 'examineBlock', block: input.blockText(given), project }, input.callOptions(options));
    },

    async packGcode(file, options) {
      return runOnGcode({ name: 'packGcode', file: input.gcode(file) }, input.callOptions(options));
    },

    async listSurfaces(file, options) {
      return runAside({ name: 'listSurfaces', file: input.print(file) }, input.callOptions(options));
    },

    async printRelief(given, cells, options) {
      const [file, side] = [input.print(given), input.cells(cells)];
      return runAside({ name: 'printRelief', file, side }, input.callOptions(options));
    },

    async rebrush(given, how, options) {
      const checked = input.callOptions(options);
      const { sections, files, ...others } = input.rebrushOptions(how);
      if (needsTexts(sections, files)) await texts.addTo(files, sections);
      const [file, project] = [input.print(given), input.projectText(sections)];
      return runAside({ name: 'rebrush', file, project, files, ...others }, checked);
    },

    async calibrate(given, request, options) {
      const { project, ...others } = input.calibration(request);
      const kind = input.calibrationKind(given);
      const call = { name: 'calibrate', kind, project: input.projectText(project), ...others } as const;
      return runAside(call, input.callOptions(options));
    },

    async readCoupon(photograph, request, options) {
      const { project, ...others } = input.couponRequest(request);
      const picture = input.pixels(photograph, 'photograph');
      const call = { name: 'readCoupon', picture, project: input.projectText(project), ...others } as const;
      return runAside(call, input.callOptions(options));
    },

    async joinReadings(given, request, options) {
      const { lampSize } = input.couponRequest(request);
      const readings = input.couponReadings(given);
      return runAside({ name: 'joinReadings', readings, lampSize }, input.callOptions(options));
    },

    dispose() {
      plates.dispose();
      aside.dispose();
    },
  };
}
