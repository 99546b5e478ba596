// Uses of the package that the compiler must accept, and, where marked, must refuse.
import {
  createEngine,
  preparePlate,
  SillonError,
  type DeepPartial,
  type Engine,
  type ErrorCode,
  type Gcode,
  type InputFile,
  type ToolpathResult,
  type Project,
  type Toolpath,
} from 'sillon';

const engine: Engine = await createEngine();
await createEngine({ threads: 'auto' });
await createEngine({ threads: 4, assetBase: '/engine', idleTimeout: Infinity });
await createEngine({ threads: 'off', assetBase: new URL('https://example.org/engine/') });
// @ts-expect-error no such word
await createEngine({ threads: 'on' });
// @ts-expect-error no such option
await createEngine({ thread: 4 });

const { version, variant, threads, reason, reasonCode } = engine.info;
const told: [string, 'mt' | 'st', number, string] = [version, variant, threads, reason];
// @ts-expect-error no such code
const given: boolean = reasonCode === 'Tired';
// @ts-expect-error told, not asked
engine.info = engine.info;

// Shapes
declare const file: File;
declare const image: ImageData;
const controller = new AbortController();
const plate: ToolpathResult = await engine.generateToolpath(
  {
    shape: { file, pageWidth: 60, unitless: 'mm' },
    layers: [{ kind: 'map', file, encoding: 'tangent', modeFile: file }],
  },
  { spacing: 0.45, perimeterMode: 'soft', bridge: null },
  {
    signal: controller.signal,
    onProgress: ({ stage, fraction }) => [stage.length, fraction.toFixed(2)],
    measure: false,
  },
);
await engine.generateToolpath({
  shape: { builtin: 'disc', size: [30, 30] },
  layers: [{ kind: 'direction', angle: 30 }],
});
await engine.generateToolpath({ shape: { size: [30, 0] }, layers: [{ kind: 'map', file, mode: 'parallel' }] });
await engine.generateToolpath({ layers: [{ kind: 'picture', pictures: [{ file, lamp: [60, 45] }, { file }] }] });
await engine.generateToolpath({});
// @ts-expect-error an input is needed
await engine.generateToolpath();
// @ts-expect-error no such shape
await engine.generateToolpath({ shape: { builtin: 'cloud', size: [1, 1] } });
// @ts-expect-error a pair
await engine.generateToolpath({ shape: { builtin: 'disc', size: [1, 2, 3] } });
// @ts-expect-error no such section
await engine.generateToolpath({ shape: { builtin: 'disc' }, toolpath: {} });
// @ts-expect-error the lowest layer says it
await engine.generateToolpath({ directions: { angle: 30 } });
// @ts-expect-error the lowest layer has them
await engine.generateToolpath({ pictures: { files: [{ file }] } });
// @ts-expect-error no such kind
await engine.generateToolpath({ layers: [{ kind: 'qr', text: 'x' }] });
// @ts-expect-error a layer has a kind
await engine.generateToolpath({ layers: [{ angle: 30 }] });
// @ts-expect-error misspelt
await engine.generateToolpath({}, { spacin: 1 });
// @ts-expect-error a number
await engine.generateToolpath({}, { spacing: '0.4' });
// @ts-expect-error only for G-code
await engine.generateToolpath({}, {}, { onChunk: () => undefined });

// Files
const files: InputFile[] = [
  '<svg/>',
  new ArrayBuffer(1),
  new Uint8Array(1),
  new DataView(new ArrayBuffer(1)),
  new Blob([]),
  file,
  { width: image.width, height: image.height, channels: 4, samples: image.data },
  { width: 1, height: 1, channels: 1, samples: new Uint16Array(1) },
];
// @ts-expect-error its pixels, not itself
files.push(image);
// @ts-expect-error whole numbers only
files.push({ width: 1, height: 1, channels: 1, samples: new Float32Array(1) });
// @ts-expect-error a path is no file
files.push(new URL('file:///leaf.svg'));

// Results
const toolpath: Toolpath = plate.toolpath;
const xs: number[] = toolpath.cycles.flatMap(({ points, widths }) => [...points.subarray(0, 2), ...widths]);
const measured: number | undefined = plate.report.coverage;
// @ts-expect-error only where it was measured
const coverage: number = plate.report.coverage;
structuredClone(plate, { transfer: toolpath.cycles.map(({ points }) => points.buffer as ArrayBuffer) });

const gcode: Gcode = await engine.writeGcode(
  toolpath,
  { name: 'Bench', flavor: 'klipper', bedMax: [250, 210] },
  { layers: 2, place: null, date: new Date(0) },
  { onChunk: (chunk) => chunk.byteLength },
);
const text: string = await gcode.blob.text();
const warnings: string[] = gcode.summary.warnings.map(({ code, values, message }) =>
  code === 'FillRatio' ? `${values.percent} %` : message,
);
// @ts-expect-error no such warning
if (gcode.summary.warnings[0]?.code === 'Sunburn') console.log('?');
// @ts-expect-error no such dialect
await engine.writeGcode(toolpath, { flavor: 'smoothie' });
// @ts-expect-error a Date
await engine.writeGcode(toolpath, {}, { date: '2026-11-21' });
// @ts-expect-error a toolpath, not a plate
await engine.writeGcode(plate);

const blobs: Blob[] = [
  await engine.writeSvg(toolpath),
  await engine.writeBaseBody(toolpath.shape, { profile: 'prusa-mk4s' }, { base: 3 }, { format: 'stl' }),
  await engine.writeView(toolpath, { colour: [1, 2, 3] }),
  await engine.renderPreview(toolpath, { width: 800 }),
  await engine.renderPreview(toolpath, { panels: 'look', colour: [1, 2, 3] }),
];
const { page, paths } = await engine.readShape({ file }, [{ kind: 'direction', angle: 0 }]);
const { width, height, angle, mode } = await engine.drawLayers({ layers: [{ kind: 'pattern' }] }, { spacing: 0.5 });
const field: [number, number, Uint16Array, Uint8Array] = [width, height, angle, mode];
const { file: body, zones } = await engine.makeZones({}, { body: file, most: 4, least: 2, layerHeight: 0.1 });
const turns: number[] = zones.map(({ degrees, areaMm2 }) => degrees * areaMm2 * body.size);
// @ts-expect-error no such setting
await engine.makeZones({}, { zones: 4 });
const brushed = await engine.rebrush(file, { layers: [{ kind: 'text', text: 'A' }], pictures: { corrections: 0 } });
const numbers: number[] = brushed.surfaces.flatMap(({ pictures }) => pictures.map(({ layer }) => layer));
// @ts-expect-error the lowest layer says it
await engine.rebrush(file, { directions: { angle: 30 } });
const { samples } = await engine.decodePicture(file);
const { channels } = await engine.paintDrawing(file);
const project: Project = await engine.readProject('{}');
const changes: DeepPartial<Project> = { toolpath: { spacing: 0.5 }, print: { place: [1, 2] } };
const json: string = await engine.writeProject({ ...project, ...changes });
// @ts-expect-error the whole pair
await engine.writeProject({ print: { place: [1] } });

const made = await preparePlate({ shape: { file } }, { printer: { profile: 'prusa-mk4s' }, limits: { memory: 256 } });
const figures: [number, number, Blob, Blob, Blob] = [made.grams, made.minutes, made.poster, made.view, made.gcode];
// @ts-expect-error no such limit
await preparePlate({}, { limits: { minutes: 1 } });

// Errors
try {
  engine.dispose();
} catch (error) {
  if (error instanceof SillonError) {
    const code: ErrorCode = error.code;
    const hint: string = error.hint;
    console.error(code, hint, error.message, error.stack);
    if (error.reason === 'OverBedEdge') console.error(error.values.left);
    // @ts-expect-error no such reason
    if (error.reason === 'TooPretty') console.error(error);
    // @ts-expect-error no such code
    if (error.code === 'Cancelled') console.error(error);
    // @ts-expect-error told, not asked
    error.code = 'Internal';
  }
}
console.log(
  told,
  given,
  xs,
  measured,
  coverage,
  text,
  warnings,
  blobs,
  page,
  paths,
  samples,
  json,
  figures,
  field,
  turns,
  numbers,
);
