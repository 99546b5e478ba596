// The engine's interface for its users.
import type * as api from '../sillon.js';
import { invalid } from './errors.js';
import * as input from './input.js';
import type { Platform } from './platform.js';
import { beads, gcodes, memoryOf, newNumber } from './known.js';
import type { Call, Files } from './protocol.js';
import { Queue, type Threads } from './queue.js';
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
  const run = (call: Call, options: input.CallOptions): Promise<unknown> => plates.run(call, options);
  /** Runs a call in the worker that has its file already, if that worker is idle. */
  const runOnGcode = (call: GcodeCall, options: input.CallOptions): Promise<unknown> =>
    (plates.has(call.file.number) ? plates : aside).run(call, options);
  const runAside = (call: Call, options: input.CallOptions): Promise<unknown> => aside.run(call, options);
  const texts = new Texts(platform, assets, async (file) => {
    const call: Call = { name: 'linesOfDrawing', file: { number: 0, value: file } };
    return (await runAside(call, input.callOptions(undefined))) as string[];
  });
  const make = async (call: PlateCall, options: input.CallOptions): Promise<api.ToolpathResult> => {
    const number = newNumber();
    const made = (await run({ ...call, name: 'generateToolpath', number }, options)) as api.ToolpathResult;
    const { cycles } = made.toolpath;
    beads.mark(cycles, number, memoryOf(cycles));
    return made;
  };
  return {
    get info() {
      return plates.info;
    },

    async generateToolpath(plateInput, params, options) {
      const { measure = true, across = false, ...others } = input.callOptions(options, ['measure', 'across']);
      const { sections, files } = input.plate(plateInput);
      if (needsTexts(sections, files)) await texts.addTo(files, sections);
      const project = input.projectText({
        ...sections,
        toolpath: input.section(params, 'params'),
      });
      return make({ project, files, measure: measure && !across, across }, others);
    },

    async warm(options) {
      // Browsers optimise code after it has run for a while: some thirty beads are enough, and take no longer than they
      // save.
      const { sections, files } = input.plate({
        shape: { builtin: 'disc', size: [12, 12] },
        layers: [{ kind: 'direction', angle: 30 }],
      });
      const project = input.projectText(sections);
      await make({ project, files, measure: true, across: false }, input.callOptions(options));
    },

    async writeGcode(toolpath, printer, print, options) {
      const { below, ...checked } = input.callOptions(options, ['onChunk', 'below']);
      const { date, ...others } = input.section(print, 'print');
      const call: Call = {
        name: 'writeGcode',
        toolpath: input.toolpath(toolpath),
        below: below === undefined ? undefined : input.toolpath(below, 'below'),
        project: input.projectText({ print: others, printer: input.section(printer, 'printer') }),
        date: input.date(date),
        number: checked.onChunk === undefined ? newNumber() : 0,
      };
      const written = (await run(call, checked)) as api.Gcode;
      if (call.number !== 0) gcodes.mark(written.blob, call.number);
      return written;
    },

    async writeBaseBody(shape, printer, print, options) {
      const checked = input.callOptions(options, ['format']);
      const call: Call = {
        name: 'writeBaseBody',
        shape: input.shape(shape, 'shape'),
        project: input.projectText({
          print: { ...input.section(print, 'print'), date: undefined },
          printer: input.section(printer, 'printer'),
        }),
        format: input.bodyFormat(checked.format),
      };
      return (await run(call, checked)) as Blob;
    },

    async writeSvg(toolpath, options) {
      const checked = input.callOptions(options);
      return (await run({ name: 'writeSvg', toolpath: input.toolpath(toolpath) }, checked)) as Blob;
    },

    async writeView(toolpath, params, options) {
      const checked = input.callOptions(options);
      const call: Call = {
        name: 'writeView',
        toolpath: input.toolpath(toolpath),
        params: input.viewParams(params),
      };
      return (await run(call, checked)) as Blob;
    },

    async renderPreview(toolpath, params, options) {
      const checked = input.callOptions(options);
      const call: Call = {
        name: 'renderPreview',
        toolpath: input.toolpath(toolpath),
        params: input.previewParams(params),
      };
      return (await run(call, checked)) as Blob;
    },

    async readShape(shape, layers, options) {
      const checked = input.callOptions(options);
      const { sections, files } = input.plate({ shape, layers });
      if (needsTexts(sections, files)) await texts.addTo(files, sections);
      return (await runAside({ name: 'readShape', project: input.projectText(sections), files }, checked)) as api.Shape;
    },

    async placeLayers(plateInput, params, options) {
      const checked = input.callOptions(options);
      const { sections, files } = input.plate(plateInput);
      await texts.addTo(files, sections);
      const project = input.projectText({ ...sections, toolpath: input.section(params, 'params') });
      const call: Call = { name: 'placeLayers', project, files };
      return (await runAside(call, checked)) as api.PlacedLayer[];
    },

    async drawLayers(plateInput, params, options) {
      const checked = input.callOptions(options);
      const { sections, files } = input.plate(plateInput);
      if (needsTexts(sections, files)) await texts.addTo(files, sections);
      const project = input.projectText({ ...sections, toolpath: input.section(params, 'params') });
      return (await runAside({ name: 'drawLayers', project, files }, checked)) as api.DirectionRaster;
    },

    async makeZones(plateInput, how, options) {
      const checked = input.callOptions(options);
      const { sections, files } = input.plate(plateInput);
      if (needsTexts(sections, files)) await texts.addTo(files, sections);
      const call: Call = {
        name: 'makeZones',
        project: input.projectText(sections),
        files,
        ...input.zoneOptions(how),
      };
      return (await runAside(call, checked)) as api.Zones;
    },

    async decodePicture(file, options) {
      const checked = input.callOptions(options);
      return (await run({ name: 'decodePicture', file: input.bytesFile(file) }, checked)) as api.Picture;
    },

    async paintDrawing(file, options) {
      const checked = input.callOptions(options);
      const drawing = 'layers[0].file'; // letters of drawings are searched where layers have drawings
      const files: Files = { [drawing]: input.bytesFile(file) };
      const sections = { layers: [{ kind: 'tones' }] };
      if (needsTexts(sections, files)) await texts.addTo(files, sections);
      return (await runAside({ name: 'paintDrawing', files, drawing }, checked)) as api.Picture;
    },

    async readProject(json, options) {
      const checked = input.callOptions(options);
      const text = (await run({ name: 'readProject', project: input.projectJson(json) }, checked)) as string;
      const project = JSON.parse(text) as api.Project;
      const { seed } = project.toolpath;
      if (!Number.isSafeInteger(seed)) {
        throw invalid(`toolpath.seed is ${seed}; in JavaScript it must be 0 to ${Number.MAX_SAFE_INTEGER}`);
      }
      return project;
    },

    async writeProject(project, options) {
      const checked = input.callOptions(options);
      const call: Call = { name: 'writeProject', project: input.projectText(input.project(project)) };
      return (await run(call, checked)) as string;
    },

    async profiles(options) {
      return (await run({ name: 'profiles' }, input.callOptions(options))) as api.Profiles;
    },

    async importPrinter(file, name, options) {
      const checked = input.callOptions(options);
      const call: Call = { name: 'importPrinter', file: input.bytesFile(file), printer: input.printerName(name) };
      return (await runAside(call, checked)) as api.ImportedPrinter;
    },

    async checkGcode(file, printer, options) {
      const checked = input.callOptions(options);
      const project = printer === undefined ? '' : input.projectText({ printer: input.section(printer, 'printer') });
      return (await runOnGcode({ name: 'checkGcode', file: input.gcode(file), project }, checked)) as api.GcodeCheck;
    },

    async examineBlock(block, flavor, options) {
      const checked = input.callOptions(options);
      const printer = flavor === undefined ? {} : { flavor };
      const project = input.projectText({ printer: input.section(printer, 'printer') });
      const call: Call = { name: 'examineBlock', block: input.blockText(block), project };
      return (await runAside(call, checked)) as api.GcodeFinding[];
    },

    async packGcode(file, options) {
      const checked = input.callOptions(options);
      return (await runOnGcode({ name: 'packGcode', file: input.gcode(file) }, checked)) as Blob;
    },

    async listSurfaces(file, options) {
      const call: Call = { name: 'listSurfaces', file: input.print(file) };
      return (await runAside(call, input.callOptions(options))) as api.SlicedFile;
    },

    async printRelief(file, side, options) {
      const checked = input.callOptions(options);
      const call: Call = { name: 'printRelief', file: input.print(file), side: input.cells(side) };
      return (await runAside(call, checked)) as api.PrintRelief;
    },

    async rebrush(file, how, options) {
      const checked = input.callOptions(options);
      const { sides, fit, only, sections, files: given } = input.rebrushOptions(how);
      if (needsTexts(sections, given)) await texts.addTo(given, sections);
      const call: Call = {
        name: 'rebrush',
        file: input.print(file),
        project: input.projectText(sections),
        files: given,
        sides,
        fit,
        only,
      };
      return (await runAside(call, checked)) as api.Rebrushed;
    },

    async calibrate(kind, request, options) {
      const checked = input.callOptions(options);
      const { project, ...others } = input.calibration(request);
      const call: Call = {
        name: 'calibrate',
        kind: input.calibrationKind(kind),
        project: input.projectText(project),
        ...others,
      };
      return (await runAside(call, checked)) as api.Calibration;
    },

    async readCoupon(photograph, request, options) {
      const checked = input.callOptions(options);
      const { project, ...others } = input.couponRequest(request);
      const call: Call = {
        name: 'readCoupon',
        picture: input.pixels(photograph, 'photograph'),
        project: input.projectText(project),
        ...others,
      };
      return (await runAside(call, checked)) as api.CouponReading;
    },

    async joinReadings(readings, request, options) {
      const checked = input.callOptions(options);
      const { lampSize } = input.couponRequest(request);
      const call: Call = { name: 'joinReadings', readings: input.couponReadings(readings), lampSize };
      return (await runAside(call, checked)) as api.CouponReading;
    },

    dispose() {
      plates.dispose();
      aside.dispose();
    },
  };
}
