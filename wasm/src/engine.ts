// The engine as its users see it.
import type * as api from '../sillon.js';
import { invalid } from './errors.js';
import * as input from './input.js';
import type { Platform } from './platform.js';
import type { CalibrateCall, FileCall, PhotoCall, PlateCall, Print, RebrushCall } from './protocol.js';
import { Queue, type Threads } from './queue.js';

const mostAutoThreads = 8;

/** How many threads to start, and why not as many as were asked for. */
function plan(asked: 'auto' | 'off' | number, platform: Platform): Threads {
  const wanted = asked === 'off' ? 1 : asked === 'auto' ? Math.min(mostAutoThreads, platform.cores()) : asked;
  const obstacle = wanted > 1 ? platform.obstacleToThreads() : '';
  if (obstacle === '') return { threads: wanted, reason: '', reasonCode: '' };
  return { threads: 1, reason: obstacle, reasonCode: 'NotIsolated' };
}

const oneThread: Threads = { threads: 1, reason: '', reasonCode: '' };

export async function startEngine(platform: Platform, options: unknown): Promise<api.Engine> {
  const { threads: asked, assetBase, idleTimeout, memory } = input.engineOptions(options);
  const assets = platform.files(assetBase);
  const plates = new Queue(platform, assets, idleTimeout, memory, plan(asked, platform));
  await plates.start();
  // Workers of their own, started by their first calls.
  const files = new Queue(platform, { ...assets, st: assets.files }, idleTimeout, memory, oneThread);
  const prints = new Queue(platform, { ...assets, st: assets.rebrush }, idleTimeout, memory, oneThread);
  const calibrations = new Queue(platform, { ...assets, st: assets.calibrate }, idleTimeout, memory, oneThread);
  const photographs = new Queue(platform, { ...assets, st: assets.photo }, idleTimeout, memory, oneThread);

  // Asynchronous functions turn what `input` throws into rejections. They run up to their first await when they are
  // called, so that calls enter the queue in order.
  const run = (call: PlateCall, options: input.CallOptions): Promise<unknown> => plates.run(call, options);
  const numbers = new WeakMap<Blob, number>();
  let lastNumber = 0;
  const printOf = (given: unknown): Print => {
    const file = input.bytesFile(given);
    if (!(file instanceof Blob)) return { file, number: 0 };
    const number = numbers.get(file) ?? ++lastNumber;
    numbers.set(file, number);
    return { file, number };
  };
  const runOnFile = (call: FileCall, options: input.CallOptions): Promise<unknown> => files.run(call, options);
  return {
    get info() {
      return plates.info;
    },

    async generateToolpath(plateInput, params, options) {
      const { measure = true, across = false, ...others } = input.callOptions(options, ['measure', 'across']);
      const { sections, files } = input.plate(plateInput);
      const project = input.projectText({
        ...sections,
        toolpath: input.section(params, 'params'),
      });
      return (await run(
        { name: 'generateToolpath', project, files, measure: measure && !across, across },
        others,
      )) as api.ToolpathResult;
    },

    async warm(options) {
      // Browsers compile for speed what has run for a while: some thirty beads are enough, and take no longer than they save.
      const { sections, files } = input.plate({
        shape: { builtin: 'disc', size: [12, 12] },
        directions: { angle: 30 },
      });
      const project = input.projectText(sections);
      await run({ name: 'generateToolpath', project, files, measure: true, across: false }, input.callOptions(options));
    },

    async writeGcode(toolpath, printer, print, options) {
      const { below, ...checked } = input.callOptions(options, ['onChunk', 'below']);
      const { date, ...others } = input.section(print, 'print');
      const call: FileCall = {
        name: 'writeGcode',
        toolpath: input.toolpath(toolpath),
        below: below === undefined ? undefined : input.toolpath(below, 'below'),
        project: input.projectText({ print: others, printer: input.section(printer, 'printer') }),
        date: input.date(date),
        inPieces: checked.onChunk !== undefined,
      };
      return (await runOnFile(call, checked)) as api.Gcode;
    },

    async writeBaseBody(shape, printer, print, options) {
      const checked = input.callOptions(options, ['format']);
      const call: FileCall = {
        name: 'writeBaseBody',
        shape: input.shape(shape, 'shape'),
        project: input.projectText({
          print: { ...input.section(print, 'print'), date: undefined },
          printer: input.section(printer, 'printer'),
        }),
        format: input.bodyFormat(checked.format),
      };
      return (await runOnFile(call, checked)) as Blob;
    },

    async writeSvg(toolpath, options) {
      const checked = input.callOptions(options);
      return (await runOnFile({ name: 'writeSvg', toolpath: input.toolpath(toolpath) }, checked)) as Blob;
    },

    async writeView(toolpath, params, options) {
      const checked = input.callOptions(options);
      const call: FileCall = {
        name: 'writeView',
        toolpath: input.toolpath(toolpath),
        params: input.viewParams(params),
      };
      return (await runOnFile(call, checked)) as Blob;
    },

    async renderPreview(toolpath, params, options) {
      const checked = input.callOptions(options);
      const call: FileCall = {
        name: 'renderPreview',
        toolpath: input.toolpath(toolpath),
        params: input.previewParams(params),
      };
      return (await runOnFile(call, checked)) as Blob;
    },

    async readShape(shape, directions, options) {
      const checked = input.callOptions(options);
      const { sections, files } = input.plate({ shape, directions });
      return (await run({ name: 'readShape', project: input.projectText(sections), files }, checked)) as api.Shape;
    },

    async decodePicture(file, options) {
      const checked = input.callOptions(options);
      return (await run({ name: 'decodePicture', file: input.bytesFile(file) }, checked)) as api.Picture;
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
      const call: PlateCall = { name: 'writeProject', project: input.projectText(input.project(project)) };
      return (await run(call, checked)) as string;
    },

    async profiles(options) {
      return (await run({ name: 'profiles' }, input.callOptions(options))) as api.Profiles;
    },

    async importPrinter(file, name, options) {
      const checked = input.callOptions(options);
      const call: FileCall = { name: 'importPrinter', file: input.bytesFile(file), printer: input.printerName(name) };
      return (await runOnFile(call, checked)) as api.ImportedPrinter;
    },

    async checkGcode(file, printer, options) {
      const checked = input.callOptions(options);
      const project = printer === undefined ? '' : input.projectText({ printer: input.section(printer, 'printer') });
      return (await runOnFile({ name: 'checkGcode', file: input.bytesFile(file), project }, checked)) as api.GcodeCheck;
    },

    async examineBlock(block, flavor, options) {
      const checked = input.callOptions(options);
      const printer = flavor === undefined ? {} : { flavor };
      const project = input.projectText({ printer: input.section(printer, 'printer') });
      const call: FileCall = { name: 'examineBlock', block: input.blockText(block), project };
      return (await runOnFile(call, checked)) as api.GcodeFinding[];
    },

    async packGcode(file, options) {
      const checked = input.callOptions(options);
      return (await runOnFile({ name: 'packGcode', file: input.bytesFile(file) }, checked)) as Blob;
    },

    async listSurfaces(file, options) {
      const call: RebrushCall = { name: 'listSurfaces', print: printOf(file) };
      return (await prints.run(call, input.callOptions(options))) as api.SlicedFile;
    },

    async printRelief(file, side, options) {
      const checked = input.callOptions(options);
      const call: RebrushCall = { name: 'printRelief', print: printOf(file), side: input.cells(side) };
      return (await prints.run(call, checked)) as api.PrintRelief;
    },

    async rebrush(file, how, options) {
      const checked = input.callOptions(options);
      const { sides, fit, only, sections, files: given } = input.rebrushOptions(how);
      const call: RebrushCall = {
        name: 'rebrush',
        print: printOf(file),
        project: input.projectText(sections),
        files: given,
        sides,
        fit,
        only,
      };
      return (await prints.run(call, checked)) as api.Rebrushed;
    },

    async calibrate(kind, request, options) {
      const checked = input.callOptions(options);
      const { project, ...others } = input.calibration(request);
      const call: CalibrateCall = {
        name: 'calibrate',
        kind: input.calibrationKind(kind),
        project: input.projectText(project),
        ...others,
      };
      return (await calibrations.run(call, checked)) as api.Calibration;
    },

    async readCoupon(photograph, request, options) {
      const checked = input.callOptions(options);
      const { project, ...others } = input.couponRequest(request);
      const call: PhotoCall = {
        name: 'readCoupon',
        picture: input.pixels(photograph, 'photograph'),
        project: input.projectText(project),
        ...others,
      };
      return (await photographs.run(call, checked)) as api.CouponReading;
    },

    async joinReadings(readings, request, options) {
      const checked = input.callOptions(options);
      const { lampSize } = input.couponRequest(request);
      const call: PhotoCall = { name: 'joinReadings', readings: input.couponReadings(readings), lampSize };
      return (await photographs.run(call, checked)) as api.CouponReading;
    },

    dispose() {
      plates.dispose();
      files.dispose();
      prints.dispose();
      calibrations.dispose();
      photographs.dispose();
    },
  };
}
