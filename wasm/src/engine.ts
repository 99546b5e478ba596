// The engine as its users see it.
import type * as api from '../sillon.js';
import { invalid } from './errors.js';
import * as input from './input.js';
import type { Platform } from './platform.js';
import type { Call } from './protocol.js';
import { Queue } from './queue.js';

const mostAutoThreads = 8;

/** How many threads to start, and why not as many as were asked for. */
function plan(asked: 'auto' | 'off' | number, platform: Platform): { threads: number; reason: string } {
  const wanted = asked === 'off' ? 1 : asked === 'auto' ? Math.min(mostAutoThreads, platform.cores()) : asked;
  const obstacle = wanted > 1 ? platform.obstacleToThreads() : '';
  return { threads: obstacle === '' ? wanted : 1, reason: obstacle };
}

export async function startEngine(platform: Platform, options: unknown): Promise<api.Engine> {
  const { threads: asked, assetBase, idleTimeout } = input.engineOptions(options);
  const { threads, reason } = plan(asked, platform);
  const queue = new Queue(platform, platform.files(assetBase), idleTimeout, threads, reason);
  await queue.start();

  // Asynchronous functions turn what `input` throws into rejections. They run up to their first await when they are
  // called, so that calls enter the queue in order.
  const run = (call: Call, options: input.CallOptions): Promise<unknown> => queue.run(call, options);
  return {
    get info() {
      return queue.info;
    },

    async generateToolpath(plateInput, params, options) {
      const { measure = true, ...others } = input.callOptions(options, ['measure']);
      const { sections, files } = input.plate(plateInput);
      const project = input.projectText({
        ...sections,
        toolpath: input.section(params, 'params'),
      });
      return (await run({ name: 'generateToolpath', project, files, measure }, others)) as api.Plate;
    },

    async writeGcode(toolpath, printer, print, options) {
      const checked = input.callOptions(options, ['onChunk']);
      const { date, ...others } = input.section(print, 'print');
      const call: Call = {
        name: 'writeGcode',
        toolpath: input.toolpath(toolpath),
        project: input.projectText({ print: others, printer: input.section(printer, 'printer') }),
        date: input.date(date),
        inPieces: checked.onChunk !== undefined,
      };
      return (await run(call, checked)) as api.Gcode;
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
      const call: Call = { name: 'writeView', toolpath: input.toolpath(toolpath), params: input.viewParams(params) };
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
      const call: Call = { name: 'writeProject', project: input.projectText(input.project(project)) };
      return (await run(call, checked)) as string;
    },

    async presets(options) {
      return (await run({ name: 'presets' }, input.callOptions(options))) as api.Presets;
    },

    async importPrinter(file, name, options) {
      const checked = input.callOptions(options);
      const call: Call = { name: 'importPrinter', file: input.bytesFile(file), printer: input.printerName(name) };
      return (await run(call, checked)) as api.ImportedPrinter;
    },

    async checkGcode(file, printer, options) {
      const checked = input.callOptions(options);
      const project = printer === undefined ? '' : input.projectText({ printer: input.section(printer, 'printer') });
      return (await run({ name: 'checkGcode', file: input.bytesFile(file), project }, checked)) as api.GcodeCheck;
    },

    async packGcode(file, options) {
      const checked = input.callOptions(options);
      return (await run({ name: 'packGcode', file: input.bytesFile(file) }, checked)) as Blob;
    },

    dispose() {
      queue.dispose();
    },
  };
}
