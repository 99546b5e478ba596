// Checks values from users and copies them, so that users may change them while their call waits. The engine itself
// checks everything that a project file can contain; this module checks the rest, which JSON cannot express.
import type * as api from '../sillon.js';
import { SillonError, invalid } from './errors.js';
import { calibrationKinds } from './facts.js';
import { beads, gcodes, memoryOf, pictures, prints } from './known.js';
import type { Files, KnownFile, Path, ReadingFields } from './protocol.js';

type Fields = Record<string, unknown>;

export interface EngineSettings {
  threads: 'auto' | 'off' | number;
  assetBase: string | URL | undefined;
  idleTimeout: number;
  /** Limit of memory [MiB]. */
  memory: number;
}

export type CallOptions = api.GenerateOptions & api.GcodeOptions & api.BodyOptions;

const fileKinds = 'SVG text, bytes (an ArrayBuffer or a view of one), a Blob or a Picture';
const fileHint = 'An ImageData becomes { width, height, channels: 4, samples: data }.';
const maxDepth = 64; // the same limit as for project files

// --- Words for messages --------------------------------------------------------------------------------------------------

/** Returns the built-in kind of an object, even if it comes from another frame. */
const kindOf = (value: unknown): string => Object.prototype.toString.call(value).slice(8, -1);

/** Describes a value for a message. */
function describe(value: unknown): string {
  if (typeof value === 'string') return JSON.stringify(value.length > 60 ? `${value.slice(0, 60)}...` : value);
  if (typeof value === 'bigint') return 'a bigint';
  if (typeof value === 'function') return 'a function';
  if (typeof value === 'symbol') return 'a symbol';
  if (Array.isArray(value)) return 'a list';
  if (typeof value === 'object' && value !== null)
    return kindOf(value) === 'Object' ? 'an object' : `of type ${kindOf(value)}`;
  return String(value);
}

const mustBe = (path: string, value: unknown, what: string, hint?: string): SillonError =>
  invalid(`${path} is ${describe(value)}; it must be ${what}`, hint);

const below = (path: string, key: string): string => (path === '' ? key : `${path}.${key}`);

// --- Plain values ----------------------------------------------------------------------------------------------------------

function fieldsOf(value: unknown, path: string): Fields {
  if (kindOf(value) !== 'Object') throw mustBe(path, value, 'an object');
  return value as Fields;
}

/** Treats undefined as an empty object. */
const optionalFields = (value: unknown, path: string): Fields => (value === undefined ? {} : fieldsOf(value, path));

function refuseUnknown(fields: Fields, path: string, known: readonly string[]): void {
  for (const [key, value] of Object.entries(fields)) {
    if (value !== undefined && !known.includes(key)) {
      throw invalid(`unknown key ${describe(below(path, key))}; known are ${known.join(', ')}`);
    }
  }
}

function finite(value: unknown, path: string): number {
  if (typeof value !== 'number' || !Number.isFinite(value)) throw mustBe(path, value, 'a finite number');
  return value;
}

/** The engine would cut larger numbers to 32 bits. @param what  numbers that the engine accepts */
function whole(value: unknown, path: string, what: string): number {
  if (!Number.isInteger(value) || Math.abs(value as number) >= 2 ** 31) throw mustBe(path, value, what);
  return value as number;
}

function pair(value: unknown, path: string): [number, number] {
  if (!Array.isArray(value) || value.length !== 2) throw mustBe(path, value, 'a list of two numbers');
  return [finite(value[0], `${path}[0]`), finite(value[1], `${path}[1]`)];
}

function listOf<T>(value: unknown, path: string, item: (value: unknown, path: string) => T): T[] {
  if (!Array.isArray(value)) throw mustBe(path, value, 'a list');
  return Array.from(value, (one, k) => item(one, `${path}[${k}]`));
}

function text(value: unknown, path: string): string {
  if (typeof value !== 'string') throw mustBe(path, value, 'text');
  if (/\p{Surrogate}/u.test(value)) throw invalid(`${path} holds half a character; it must be Unicode text`);
  return value;
}

/** Copies a value as JSON can express it; undefined fields are left out. */
function plain(value: unknown, path: string, depth = 0): unknown {
  if (depth > maxDepth) throw invalid(`${path} lies deeper than ${maxDepth} levels, or holds itself`);
  if (value === null || typeof value === 'boolean') return value;
  if (typeof value === 'string') return text(value, path);
  if (typeof value === 'number') {
    if (Number.isInteger(value) && !Number.isSafeInteger(value)) {
      throw mustBe(path, value, `a number up to ${Number.MAX_SAFE_INTEGER}`);
    }
    return finite(value, path);
  }
  if (Array.isArray(value)) return listOf(value, path, (one, at) => plain(one, at, depth + 1));
  if (kindOf(value) !== 'Object') throw mustBe(path, value, 'what a project file can hold');
  return Object.fromEntries(
    Object.entries(value as Fields)
      .filter(([, one]) => one !== undefined)
      .map(([key, one]) => [key, plain(one, below(path, key), depth + 1)]),
  );
}

// --- Bytes -----------------------------------------------------------------------------------------------------------------

/** Copies a buffer; explains a failure. */
function copied<T>(path: string, copy: () => T): T {
  try {
    return copy();
  } catch (problem) {
    if (problem instanceof RangeError) throw new SillonError('OutOfMemory', `there is no memory for a copy of ${path}`);
    throw invalid(
      `${path} lies in a buffer that was transferred away`,
      'Hand over a buffer that still holds its data.',
    );
  }
}

function numbers<Kind extends 'Float32Array' | 'Float64Array'>(
  value: unknown,
  path: string,
  kind: Kind,
): InstanceType<(typeof globalThis)[Kind]> {
  if (kindOf(value) !== kind) throw mustBe(path, value, `a ${kind}`);
  const array = value as InstanceType<(typeof globalThis)[Kind]>;
  return copied(path, () => array.slice() as typeof array);
}

/** Checks and copies a Picture. */
function picture(value: Fields, path: string): api.Picture {
  refuseUnknown(value, path, ['width', 'height', 'channels', 'samples']);
  const samples = value['samples'];
  if (!['Uint8Array', 'Uint8ClampedArray', 'Uint16Array'].includes(kindOf(samples))) {
    throw mustBe(`${path}.samples`, samples, 'a Uint8Array, Uint8ClampedArray or Uint16Array', fileHint);
  }
  return {
    width: finite(value['width'], `${path}.width`),
    height: finite(value['height'], `${path}.height`),
    channels: finite(value['channels'], `${path}.channels`) as api.Picture['channels'],
    // A constructor copies; a slice of Node's Buffer would not.
    samples: copied(path, () => {
      const given = samples as api.Picture['samples'];
      return kindOf(given) === 'Uint16Array' ? new Uint16Array(given) : new Uint8Array(given);
    }),
  };
}

/** Copies bytes; a Blob needs no copy. Returns undefined for any other value. */
function bytes(value: unknown, path: string): Uint8Array<ArrayBuffer> | Blob | undefined {
  if (ArrayBuffer.isView(value)) {
    return copied(path, () => new Uint8Array(value.buffer, value.byteOffset, value.byteLength).slice());
  }
  const kind = kindOf(value);
  if (kind === 'ArrayBuffer' || kind === 'SharedArrayBuffer') {
    return copied(path, () => new Uint8Array(value as ArrayBuffer).slice());
  }
  return kind === 'Blob' || kind === 'File' ? (value as Blob) : undefined;
}

/** Fields that accept a drawing as text. */
const drawings = /^(shape\.file|layers\[\d+\]\.(file|maskFile))$/;

/** Checks the content of a file field. */
function file(value: unknown, path: string): Files[string] {
  if (typeof value === 'string') {
    if (drawings.test(path) && /^\uFEFF?\s*(<|$)/.test(value))
      return { number: 0, value: new TextEncoder().encode(value) };
    const what = drawings.test(path) ? fileKinds : fileKinds.replace('SVG text, ', '');
    throw mustBe(path, value, what, 'Hand over the content of files.');
  }
  const content = bytes(value, path);
  if (content !== undefined) {
    const memory = content instanceof Blob ? undefined : () => [content];
    return { number: pictures.numberOf(value as object, memory), value: content };
  }
  if (kindOf(value) === 'Object') return { number: 0, value: picture(value as Fields, path) };
  throw mustBe(path, value, fileKinds, fileHint);
}

// --- Arguments of the calls ------------------------------------------------------------------------------------------------

/** Checks the options of createEngine, and fills in defaults. */
export function engineOptions(value: unknown): EngineSettings {
  const options = optionalFields(value, 'options');
  refuseUnknown(options, 'options', ['threads', 'assetBase', 'idleTimeout', 'memory']);
  const { threads = 'auto', assetBase, idleTimeout = 10_000, memory = 3072 } = options;
  const counted = typeof threads === 'number' && Number.isInteger(threads) && threads >= 1 && threads <= 64;
  if (threads !== 'auto' && threads !== 'off' && !counted) {
    throw mustBe('threads', threads, '"auto", "off" or a whole number from 1 to 64');
  }
  if (assetBase !== undefined && typeof assetBase !== 'string' && kindOf(assetBase) !== 'URL') {
    throw mustBe('assetBase', assetBase, 'text or a URL');
  }
  if (typeof idleTimeout !== 'number' || !(idleTimeout >= 0)) {
    throw mustBe('idleTimeout', idleTimeout, 'a number of milliseconds, 0 or more');
  }
  if (typeof memory !== 'number' || !(memory >= 64 && memory <= 4096)) {
    throw mustBe('memory', memory, 'a number of MiB from 64 to 4096');
  }
  return { threads, assetBase: assetBase as string | URL | undefined, idleTimeout, memory };
}

/** Checks the options of preparePlate. Sections of a project are checked by the calls that use them. */
export function prepareOptions(upload: unknown, value: unknown) {
  const options = optionalFields(value, 'options');
  refuseUnknown(options, 'options', [
    ...['toolpath', 'printer', 'print', 'filament', 'posterSide', 'signal', 'limits', 'assetBase'],
  ]);
  const limits = optionalFields(options.limits, 'limits');
  refuseUnknown(limits, 'limits', ['seconds', 'memory', 'threads']);
  const { seconds = 60, memory = 512, threads = 'off' } = limits;
  if (typeof seconds !== 'number' || !(seconds > 0 && seconds <= 1e6)) {
    throw mustBe('limits.seconds', seconds, 'a number above 0, at most 1000000');
  }
  const { posterSide = 640 } = options;
  if (!Number.isInteger(posterSide) || (posterSide as number) < 16 || (posterSide as number) > 1024) {
    throw mustBe('posterSide', posterSide, 'a whole number from 16 to 1024');
  }
  const { signal } = callOptions({ signal: options.signal });
  const { toolpath, printer = {}, print = {}, assetBase } = options as api.PrepareOptions;
  return {
    plate: { ...fieldsOf(upload, 'upload'), printer, print } as api.PlateInput,
    toolpath,
    printer,
    print,
    filament: viewParams(options.filament),
    posterSide: posterSide as number,
    signal,
    seconds,
    engine: { threads, memory, assetBase } as api.EngineOptions, // checked by createEngine
  };
}

/** @param special  further options that the call accepts. */
export function callOptions(
  value: unknown,
  special: readonly ('measure' | 'across' | 'onChunk' | 'below' | 'format')[] = [],
): CallOptions {
  const options = optionalFields(value, 'options');
  refuseUnknown(options, 'options', ['signal', 'onProgress', ...special]);
  const { signal, onProgress, onChunk, measure, across } = options;
  if (signal !== undefined && kindOf(signal) !== 'AbortSignal') throw mustBe('signal', signal, 'an AbortSignal');
  for (const [name, callback] of Object.entries({ onProgress, onChunk })) {
    if (callback !== undefined && typeof callback !== 'function') throw mustBe(name, callback, 'a function');
  }
  for (const [name, flag] of Object.entries({ measure, across })) {
    if (flag !== undefined && typeof flag !== 'boolean') throw mustBe(name, flag, 'true or false');
  }
  return options;
}

/** Formats a project file from the sections that are given. */
export function projectText(sections: Fields): string {
  return JSON.stringify({ sillon: 1, ...(plain(sections, '') as Fields) });
}

export { optionalFields as section };

export const project = (value: unknown): Fields => fieldsOf(value, 'project');

export const printerName = (value: unknown): string => (value === undefined ? '' : text(value, 'name'));

export const blockText = (value: unknown): string => text(value, 'block');

export const projectJson = (value: unknown): string => text(value, 'json');

/** Takes the files of a layer, of one of its pictures, or of a shape. Each file is named after its field. */
function named(value: unknown, path: string, files: Files): Fields {
  const fields = { ...fieldsOf(value, path) };
  for (const key of ['file', 'maskFile', 'modeFile', 'font']) {
    const content = fields[key];
    const none = content === undefined || (content === '' && path !== 'shape'); // layers have files of no name
    if (none || (key === 'font' && typeof content === 'string')) continue;
    files[`${path}.${key}`] = file(content, `${path}.${key}`);
    fields[key] = `${path}.${key}`;
  }
  const { pictures } = fields;
  if (pictures === undefined) return fields;
  return { ...fields, pictures: listOf(pictures, `${path}.pictures`, (one, at) => named(one, at, files)) };
}

/** Takes the sections of a plate and their files, which are named after their fields. */
export function plate(value: unknown): { sections: Fields; files: Files } {
  const { shape, layers, pictures, printer, print, ...others } = fieldsOf(value, 'input');
  refuseUnknown(others, '', ['shape', 'layers', 'pictures', 'printer', 'print']);
  const files: Files = {};
  const given: Fields = {
    shape: shape === undefined ? shape : named(shape, 'shape', files),
    layers: layers === undefined ? layers : listOf(layers, 'layers', (one, path) => named(one, path, files)),
    pictures: pictures === undefined ? pictures : fieldsOf(pictures, 'pictures'),
    printer: printer === undefined ? printer : fieldsOf(printer, 'printer'),
    print: print === undefined ? print : { ...fieldsOf(print, 'print'), date: undefined },
  };
  const sections = Object.fromEntries(Object.entries(given).filter(([, part]) => part !== undefined));
  return { sections, files };
}

/** Checks the options of makeZones, and fills in defaults. */
export function zoneOptions(value: unknown) {
  const given = optionalFields(value, 'how');
  const body = given['body'] === undefined ? undefined : bytesFile(given['body'], undefined, 'how.body');
  const face = given['face'] === undefined ? [] : listOf(given['face'], 'how.face', finite);
  // A face needs a body.
  refuseUnknown(given, 'how', [...(body ? ['face'] : []), 'body', 'height', 'most', 'least', 'layerHeight']);
  if (face.length % 3 !== 0) throw mustBe('how.face', face, 'three numbers');
  const number = (key: string, usual: number): number =>
    given[key] === undefined ? usual : finite(given[key], `how.${key}`);
  return {
    file: body,
    height: number('height', 2),
    most: whole(number('most', 6), 'how.most', 'a whole number from 2 to 12'),
    least: number('least', 3),
    layerHeight: number('layerHeight', 0.2),
    face,
  };
}

/** Checks an index in a list. */
function place(value: unknown, path: string): number {
  if (whole(value, path, 'a whole number from 0') < 0) throw mustBe(path, value, 'a whole number from 0');
  return value as number;
}

/** Checks the options of rebrush: sections of a project and their files. */
export function rebrushOptions(value: unknown) {
  const given = optionalFields(value, 'how');
  refuseUnknown(given, 'how', ['layers', 'pictures', 'toolpath', 'sides', 'fit', 'only']);
  const { layers, pictures, toolpath, sides = 'top', fit = 'face' } = given;
  if (sides !== 'top' && sides !== 'bottom' && sides !== 'both') {
    throw mustBe('how.sides', sides, '"top", "bottom" or "both"');
  }
  if (fit !== 'face' && fit !== 'object' && fit !== 'bed' && fit !== 'all') {
    throw mustBe('how.fit', fit, '"face", "object", "bed" or "all"');
  }
  const only = given['only'] === undefined ? [] : listOf(given['only'], 'how.only', place);
  if (given['only'] !== undefined && only.length === 0) throw invalid('how.only is empty; it must name a surface');
  const { sections, files } = plate({ layers, pictures });
  // A bead along the border would frame the pictures in tones that they do not have.
  const lowest = (sections['layers'] as Fields[] | undefined)?.[0];
  const border = lowest?.['kind'] === 'picture' ? { perimeterMode: 'soft' } : {};
  const params = { ...border, ...optionalFields(toolpath, 'how.toolpath') };
  return { sides, fit, only, sections: { ...sections, toolpath: params }, files } as const;
}

export function calibrationKind(value: unknown): api.CalibrationKind {
  const found = calibrationKinds.find((kind) => kind === value);
  if (found === undefined) throw mustBe('kind', value, `one of ${calibrationKinds.join(', ')}`);
  return found;
}

const optionalNumber = (value: unknown, path: string): number | undefined =>
  value === undefined ? undefined : finite(value, path);

/** Reads the common fields of both calls about calibration prints: the project, and the range of values. */
function calibrated(given: Fields) {
  const print = { ...optionalFields(given['print'], 'request.print'), date: undefined };
  return {
    project: { print, printer: optionalFields(given['printer'], 'request.printer') },
    from: optionalNumber(given['from'], 'request.from'),
    to: optionalNumber(given['to'], 'request.to'),
  };
}

/** Checks the request of calibrate. */
export function calibration(value: unknown) {
  const given = optionalFields(value, 'request');
  refuseUnknown(given, 'request', ['printer', 'print', 'toolpath', 'from', 'to', 'filament', 'pictureSide']);
  const { pictureSide = 0, filament } = given;
  const side = pictureSide as number;
  if (!Number.isInteger(side) || (side !== 0 && (side < 64 || side > 1024))) {
    throw mustBe('request.pictureSide', side, '0 or a whole number from 64 to 1024');
  }
  const { project, ...range } = calibrated(given);
  return {
    project: { ...project, toolpath: optionalFields(given['toolpath'], 'request.toolpath') },
    ...range,
    filament: filament === undefined ? undefined : viewParams(filament),
    date: date(optionalFields(given['print'], 'request.print')['date']),
    pictureSide: side,
  };
}

/** Checks the request of readCoupon and joinReadings. */
export function couponRequest(value: unknown) {
  const given = optionalFields(value, 'request');
  refuseUnknown(given, 'request', ['printer', 'print', 'from', 'to', 'lampSize', 'lampElevation']);
  return {
    ...calibrated(given),
    lampSize: optionalNumber(given['lampSize'], 'request.lampSize'),
    lampElevation: optionalNumber(given['lampElevation'], 'request.lampElevation'),
  };
}

function measured(value: unknown, path: string): api.Measured {
  const given = fieldsOf(value, path);
  return { value: finite(given['value'], `${path}.value`), error: finite(given['error'], `${path}.error`) };
}

/** Checks results of readCoupon. */
export function couponReadings(value: unknown): ReadingFields[] {
  const readings = listOf(value, 'readings', (one, path) => {
    const given = fieldsOf(one, path);
    const bar = (key: string): api.Measured => measured(given[key], `${path}.${key}`);
    const number = (key: string): number => finite(given[key], `${path}.${key}`);
    const colour = fieldsOf(given['spool'], `${path}.spool`)['colour'];
    const [red, green, blue, ...more] = listOf(colour, `${path}.spool.colour`, finite);
    if (red === undefined || green === undefined || blue === undefined || more.length > 0) {
      throw mustBe(`${path}.spool.colour`, colour, 'a list of three numbers');
    }
    return {
      along: bar('along'),
      across: bar('across'),
      flow: given['flow'] === null ? null : bar('flow'),
      allDiscsClosed: given['allDiscsClosed'] === true,
      noDiscClosed: given['noDiscClosed'] === true,
      width: bar('width'),
      widthAsked: number('widthAsked'),
      azimuth: bar('azimuth'),
      elevation: bar('elevation'),
      tilt: number('tilt'),
      pixelsPerMm: number('pixelsPerMm'),
      blur: number('blur'),
      colour: [red, green, blue] satisfies api.Spool['colour'],
    };
  });
  if (readings.length === 0) throw mustBe('readings', value, 'a list of at least one reading');
  return readings;
}

/** Checks a decoded picture. */
export function pixels(value: unknown, path: string): api.Picture {
  if (kindOf(value) !== 'Object') throw mustBe(path, value, 'a Picture', 'decodePicture reads files.');
  return picture(value as Fields, path);
}

/** Checks bytes in any form. @param numberOf  returns the number of a Blob that the worker may keep */
export function bytesFile(value: unknown, numberOf: (file: Blob) => number = () => 0, path = 'file'): KnownFile {
  const content = bytes(value, path);
  if (content === undefined)
    throw mustBe(path, value, fileKinds.replace('SVG text, ', '').replace(' or a Picture', ''));
  return { number: content instanceof Uint8Array ? 0 : numberOf(content), value: content };
}

export const print = (value: unknown): KnownFile => bytesFile(value, (file) => prints.numberOf(file));

/** Takes G-code. Only files that the engine itself has written are kept. */
export const gcode = (value: unknown): KnownFile => bytesFile(value, (file) => gcodes.find(file));

/** Formats a date as "2026-11-21 at 07:30:00 UTC". */
export function date(value: unknown = new Date()): string {
  if (kindOf(value) !== 'Date' || Number.isNaN((value as Date).getTime())) {
    throw mustBe('print.date', value, 'a Date with a time');
  }
  return (value as Date)
    .toISOString()
    .replace('T', ' at ')
    .replace(/\.\d+Z$/, ' UTC');
}

/** Checks the parameters of renderPreview, and fills in defaults. */
export function previewParams(value: unknown): api.PreviewParams {
  const params = optionalFields(value, 'params');
  refuseUnknown(params, '', ['width', 'panels', 'colour', 'slopes', 'lightAzimuth', 'lightElevation']);
  const { panels = 'both', colour = [24, 78, 168], slopes = [2.36, 17.32] } = params;
  if (panels !== 'both' && panels !== 'look') throw mustBe('panels', panels, '"both" or "look"');
  const { width = panels === 'look' ? 1024 : 1600, lightAzimuth = 60, lightElevation = 35 } = params;
  return {
    width: whole(width, 'width', `a whole number from 16 to ${panels === 'look' ? 1024 : 16384}`),
    panels,
    colour: rgb(colour, 'colour'),
    slopes: pair(slopes, 'slopes'),
    lightAzimuth: finite(lightAzimuth, 'lightAzimuth'),
    lightElevation: finite(lightElevation, 'lightElevation'),
  };
}

/** Checks the cells of the longer side of a relief. */
export const cells = (value: unknown = 1024): number => whole(value, 'side', 'a whole number from 16 to 4096');

export function viewParams(value: unknown): api.ViewParams {
  const params = optionalFields(value, 'params');
  refuseUnknown(params, '', ['colour', 'slopes']);
  const { colour = [201, 148, 46], slopes = [8.93, 15.6] } = params;
  return { colour: rgb(colour, 'colour'), slopes: pair(slopes, 'slopes') };
}

/** Checks the types of a toolpath; the engine checks its values. */
export function toolpath(value: unknown, path = 'toolpath'): Path {
  const { spacing, cycles, shape: filled, notes, look: seen } = fieldsOf(value, path);
  return {
    ...(seen === undefined ? {} : { look: look(seen, `${path}.look`) }),
    shape: shape(filled, `${path}.shape`),
    spacing: finite(spacing, `${path}.spacing`),
    cycles: knownCycles(cycles, `${path}.cycles`),
    notes: listOf(notes, `${path}.notes`, text),
  };
}

/** Returns cycles that the worker may keep; they are copied only if they have to travel. */
function knownCycles(value: unknown, path: string): Path['cycles'] {
  const copy = (): api.Cycle[] => listOf(value, path, cycle);
  const list = value as api.Cycle[];
  const number = Array.isArray(value) ? beads.find(list, memoryOf(list)) : 0;
  if (number === 0) {
    const cycles = copy();
    return { number: beads.numberOf(list, memoryOf(list)), value: cycles };
  }
  return {
    number,
    get value() {
      return copy();
    },
  };
}

/** Checks a toolpath's look. */
function look(value: unknown, path: string): api.Look {
  const { colour, slopes, lampSize, lamps } = fieldsOf(value, path);
  const standing = listOf(lamps, `${path}.lamps`, pair);
  if (standing.length === 0) throw invalid(`${path}.lamps is empty; it must have at least one lamp`);
  return {
    colour: rgb(colour, `${path}.colour`),
    slopes: pair(slopes, `${path}.slopes`),
    lampSize: finite(lampSize, `${path}.lampSize`),
    lamps: standing,
  };
}

/** Checks a colour; the engine would truncate other values to 8 bits. */
function rgb(value: unknown, path: string): [number, number, number] {
  const channels = listOf(value, path, finite);
  if (channels.length !== 3 || !channels.every((one) => Number.isInteger(one) && one >= 0 && one <= 255)) {
    throw mustBe(path, value, 'three whole numbers from 0 to 255');
  }
  return channels as [number, number, number];
}

/** Checks the types of a shape; the engine checks its values. */
export function shape(value: unknown, path: string): api.Shape {
  const { page, paths } = fieldsOf(value, path);
  return { page: pair(page, `${path}.page`), paths: listOf(paths, `${path}.paths`, filledPath) };
}

export function bodyFormat(value: unknown = '3mf'): 'stl' | '3mf' {
  if (value !== 'stl' && value !== '3mf') throw mustBe('format', value, '"stl" or "3mf"');
  return value;
}

/** Checks and copies a cycle. */
function cycle(value: unknown, path: string): api.Cycle {
  const fields = fieldsOf(value, path);
  const points = numbers(fields['points'], `${path}.points`, 'Float32Array');
  const widths = numbers(fields['widths'], `${path}.widths`, 'Float32Array');
  if (points.length !== 2 * widths.length) {
    throw invalid(
      `${path} has ${points.length} coordinates and ${widths.length} widths; it must have two for each width`,
    );
  }
  return { points, widths };
}

/** Checks and copies a path of a shape. */
function filledPath(value: unknown, path: string): api.Shape['paths'][number] {
  const { fillRule, rings } = fieldsOf(value, path);
  if (fillRule !== 'nonzero' && fillRule !== 'evenodd') {
    throw mustBe(`${path}.fillRule`, fillRule, '"nonzero" or "evenodd"');
  }
  return {
    fillRule,
    rings: listOf(rings, `${path}.rings`, (ring, at) => {
      const flat = numbers(ring, at, 'Float64Array');
      if (flat.length % 2 !== 0) throw invalid(`${at} has ${flat.length} coordinates; it must have two for each point`);
      return flat;
    }),
  };
}
