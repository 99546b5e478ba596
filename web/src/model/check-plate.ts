// What comes from elsewhere - a link, a project, storage - may have been written by anybody: it becomes a plate only as far
// as a control could have set it.
import type { RoundHole } from 'sillon';
import {
  fileKinds,
  generatorKinds,
  newColours,
  newFileDirections,
  newFileShape,
  newGenerator,
  newLampDirections,
  newPlate,
  newShape,
} from './defaults.js';
import { filaments } from './filaments.js';
import { builtInFonts } from './fonts.js';
import { mostColours } from './flat-colours.js';
import { mostPictures } from './lamp.js';
import { fieldsOf, flagIn, numberIn, oneOf, textIn, Unfit, type Fields, type FileFrom } from './check.js';
import { layersFrom } from './check-layers.js';
import type { DirectionSource, LampPicture, ModeSource, OwnSpool, Plate, ShapeSource, Stroke } from './plate.js';
import { shapeTable } from './setting-table.js';
import { accepts, settingsOf, type SectionName } from './settings.js';

// --- Parts of a plate --------------------------------------------------------------------------------------------------

export const nameFrom = (value: unknown): string => textIn(value, 'name', 200);
export const widthFrom = (value: unknown): number => numberIn(value, 'width', 0.1, 10000);
export const heightFrom = (value: unknown): number => numberIn(value, 'height', 0, 10000);

export const modeFrom = (value: unknown, where: string): ModeSource['mode'] =>
  oneOf(value, where, ['parallel', 'orthogonal', 'smoothest', 'constrained']);

type SpoolSides = OwnSpool['fine'];

function sidesFrom(value: unknown, where: string): SpoolSides {
  const sides = fieldsOf(value, where, ['nozzleSide', 'bedSide']);
  const slopes = (side: keyof SpoolSides): [number, number] => {
    const at = `${where}.${side}`;
    const pair = sides[side];
    if (!Array.isArray(pair) || pair.length !== 2) throw new Unfit(at, pair);
    return [numberIn(pair[0], at, 0.1, 45), numberIn(pair[1], at, 0.1, 45)];
  };
  return { nozzleSide: slopes('nozzleSide'), bedSide: slopes('bedSide') };
}

/** As the engine reads an entry of a file of spools. @param value  without the key */
export function spoolFrom(key: unknown, value: unknown, where = 'spool'): OwnSpool {
  const name = textIn(key, `${where}.key`, 40);
  if (!/^[\w-]+$/.test(name) || filaments.some((filament) => filament.key === name)) {
    throw new Unfit(`${where}.key`, name);
  }
  const { colour, fine, wide, source } = fieldsOf(value, where, ['colour', 'fine', 'wide', 'source']);
  const channels = Array.isArray(colour) && colour.length === 3 ? colour : [undefined];
  const rgb = channels.map((one) => (Number.isInteger(one) ? numberIn(one, `${where}.colour`, 0, 255) : NaN));
  if (rgb.some(Number.isNaN)) throw new Unfit(`${where}.colour`, colour);
  if (source !== undefined && typeof source !== 'string') throw new Unfit(`${where}.source`, source);
  return {
    key: name,
    colour: rgb as [number, number, number],
    fine: sidesFrom(fine, `${where}.fine`),
    ...(wide !== undefined && { wide: sidesFrom(wide, `${where}.wide`) }),
    ...(source !== undefined && { source }),
  };
}

/** Of a plate's data, or of a link's; undefined: none. */
export function plateSpoolFrom(value: unknown): { spool?: OwnSpool } {
  if (value === undefined) return {};
  const { key, ...entry } = fieldsOf(value, 'spool', ['key', 'colour', 'fine', 'wide', 'source']);
  return { spool: spoolFrom(key, entry) };
}

const [, ...builtins] = shapeTable.builtin.choices; // the first is none
const furthest = 10000; // [mm], as the engine has it

function holesFrom(value: unknown): RoundHole[] {
  if (!Array.isArray(value) || value.length > shapeTable.holes.most) throw new Unfit('shape.holes', value);
  return value.map((one: unknown, k) => {
    const where = `shape.holes[${k}]`;
    const { x, y, diameter } = fieldsOf(one, where, ['x', 'y', 'diameter']);
    return {
      x: numberIn(x, `${where}.x`, -furthest, furthest),
      y: numberIn(y, `${where}.y`, -furthest, furthest),
      diameter: numberIn(diameter, `${where}.diameter`, 0.5, furthest),
    };
  });
}

/** Fills what is left out with first values. @param fileFrom  undefined: files are not allowed */
export function shapeFrom(value: unknown, fileFrom?: FileFrom): ShapeSource {
  const keys = [
    'radius',
    'corners',
    'points',
    'inner',
    'offset',
    'holes',
    'text',
    'font',
    'unitless',
    'paint',
    'keepThin',
  ] as const;
  const fields = fieldsOf(value, 'shape', ['kind', ...(fileFrom === undefined ? [] : ['file']), ...keys]);
  const kind = oneOf(
    fields['kind'],
    'shape.kind',
    fileFrom === undefined ? builtins : ([...builtins, 'file'] as const),
  );
  if (kind !== 'file' && fields['file'] !== undefined) throw new Unfit('shape.file', fields['file']);
  const usual =
    kind === 'file' && fileFrom !== undefined
      ? newFileShape(fileFrom(fields['file'], 'shape.file'))
      : newShape(kind as 'disc');
  const given: Fields = { ...usual, ...fields };
  const number = (key: 'radius' | 'points' | 'inner' | 'offset'): number =>
    numberIn(given[key], `shape.${key}`, shapeTable[key].low, shapeTable[key].high);
  const points = number('points');
  if (!Number.isInteger(points)) throw new Unfit('shape.points', points);
  return {
    ...usual,
    radius: number('radius'),
    corners: oneOf(given['corners'], 'shape.corners', shapeTable.corners.choices),
    points,
    inner: number('inner'),
    offset: number('offset'),
    holes: holesFrom(given['holes']),
    text: textIn(given['text'], 'shape.text', longestText),
    font: oneOf(given['font'], 'shape.font', builtInFonts),
    unitless: oneOf(given['unitless'], 'shape.unitless', ['px', 'mm']),
    paint: oneOf(given['paint'], 'shape.paint', ['shown', 'ignore']),
    keepThin: flagIn(given['keepThin'], 'shape.keepThin'),
  };
}

/** Of every number of directions. Lengths are shares of the page. */
const ranges: Readonly<Record<string, [number, number]>> = {
  angle: [-360, 360],
  turns: [-1000, 1000],
  amplitude: [-360, 360],
  length: [0.001, 100],
  scale: [0.001, 100],
  seed: [0, Number.MAX_SAFE_INTEGER],
  size: [0.001, 10],
  letters: [-360, 360],
  ground: [-360, 360],
  dark: [-360, 360],
  light: [-360, 360],
  margin: [0, 100],
  from: [-360, 360],
  to: [-360, 360],
  contrast: [0.01, 100],
  smoothing: [0, 1],
  threshold: [0, 1],
};
const longestText = 2000;

/** A value like the one that directions of this kind begin with. */
function like(pattern: unknown, given: unknown, name: string): unknown {
  const where = `directions.${name}`;
  if (name === 'encoding') return oneOf(given, where, ['angle', 'rotation', 'tangent']);
  if (typeof pattern === 'string') return textIn(given, where, longestText);
  if (typeof pattern === 'boolean') return flagIn(given, where);
  if (Array.isArray(pattern)) {
    if (!Array.isArray(given) || given.length !== 2) throw new Unfit(where, given);
    return [numberIn(given[0], where, -10, 10), numberIn(given[1], where, -10, 10)];
  }
  const [min, max] = ranges[name] ?? [0, 0];
  return numberIn(given, where, min, max);
}

const includes = <Kind extends string>(kinds: readonly Kind[], kind: string): kind is Kind =>
  (kinds as readonly string[]).includes(kind);

function lampFrom(value: unknown, fileFrom: FileFrom): DirectionSource {
  const { pictures } = fieldsOf(value, 'directions', Object.keys(newLampDirections([])));
  if (!Array.isArray(pictures) || pictures.length < 1 || pictures.length > mostPictures) {
    throw new Unfit('directions.pictures', pictures);
  }
  const read = pictures.map((one: unknown, k): LampPicture => {
    const where = `directions.pictures[${k}]`;
    const { file, lamp } = fieldsOf(one, where, ['file', 'lamp']);
    if (lamp !== null && (!Array.isArray(lamp) || lamp.length !== 2)) throw new Unfit(`${where}.lamp`, lamp);
    const stands =
      lamp === null
        ? null
        : ([numberIn(lamp[0], `${where}.lamp`, -360, 360), numberIn(lamp[1], `${where}.lamp`, 1, 90)] as const);
    return { file: fileFrom(file, `${where}.file`), lamp: stands };
  });
  return newLampDirections(read);
}

function coloursFrom(value: unknown, fileFrom: FileFrom): DirectionSource {
  const { file, colours } = fieldsOf(value, 'directions', ['kind', 'file', 'colours']);
  if (!Array.isArray(colours) || colours.length > mostColours) throw new Unfit('directions.colours', colours);
  const read = colours.map((one: unknown, k) => {
    const where = `directions.colours[${k}]`;
    const { colour, angle } = fieldsOf(one, where, ['colour', 'angle']);
    if (typeof colour !== 'string' || !/^#[\da-f]{6}$/.test(colour)) throw new Unfit(`${where}.colour`, colour);
    return { colour, angle: numberIn(angle, `${where}.angle`, -360, 360) };
  });
  return newColours(fileFrom(file, 'directions.file'), read);
}

/** @param fileFrom  undefined: files are not allowed */
export function directionsFrom(value: unknown, fileFrom?: FileFrom): DirectionSource {
  const kinds =
    fileFrom === undefined ? generatorKinds : ([...generatorKinds, ...fileKinds, 'lamp', 'colours'] as const);
  const given = (value as Fields | null | undefined) ?? {};
  const kind = oneOf(given['kind'], 'directions.kind', kinds);
  if (kind === 'lamp') return lampFrom(value, fileFrom as FileFrom);
  if (kind === 'colours') return coloursFrom(value, fileFrom as FileFrom);
  const file = includes(fileKinds, kind) ? fileFrom?.(given['file'], 'directions.file') : undefined;
  const usual =
    includes(fileKinds, kind) && file !== undefined ? newFileDirections(kind, file) : newGenerator(kind as 'angle');
  const fields = fieldsOf(value, 'directions', Object.keys(usual));
  const read: Fields = {};
  for (const [name, pattern] of Object.entries(usual)) {
    read[name] = name === 'kind' || name === 'file' ? pattern : like(pattern, fields[name], name);
  }
  return read as unknown as DirectionSource;
}

function modesFrom(value: unknown, fileFrom: FileFrom): ModeSource {
  const { mode: given, file } = fieldsOf(value, 'modes', ['mode', 'file']);
  const mode = modeFrom(given, 'modes.mode');
  return file === undefined ? { mode } : { mode, file: fileFrom(file, 'modes.file') };
}

function strokeFrom(value: unknown, k: number): Stroke {
  const where = `strokes[${k}]`;
  const fields = fieldsOf(value, where, ['tool', 'points', 'radius', 'softness', 'mode']);
  const given = fields['points'];
  if (!Array.isArray(given) || given.length % 2 !== 0) throw new Unfit(`${where}.points`, given);
  const points = given.map((one) => numberIn(one, `${where}.points`, -1e6, 1e6)); // hands leave the page
  const stroke: Stroke = {
    tool: oneOf(fields['tool'], `${where}.tool`, ['comb', 'mode', 'erase'] as const),
    points,
    radius: numberIn(fields['radius'], `${where}.radius`, 0, 100),
    softness: numberIn(fields['softness'], `${where}.softness`, 0, 1),
  };
  return fields['mode'] === undefined ? stroke : { ...stroke, mode: modeFrom(fields['mode'], `${where}.mode`) };
}

function strokesFrom(value: unknown): Stroke[] {
  if (!Array.isArray(value)) throw new Unfit('strokes', value);
  return value.map(strokeFrom);
}

/** What is left out has its default: settings come with versions. */
function sectionFrom<Name extends SectionName>(
  section: Name,
  value: unknown,
  others: readonly string[] = [],
): Plate[Name] {
  const rows = settingsOf(section);
  const fields = fieldsOf(value, section, [...rows.map(({ key }) => key), ...others]);
  const read: Fields = {};
  for (const setting of rows) {
    const given = fields[setting.key];
    if (given === undefined) read[setting.key] = structuredClone(setting.default);
    else if (accepts(setting, given)) read[setting.key] = given;
    else throw new Unfit(setting.id, given);
  }
  for (const name of others)
    if (fields[name] !== undefined) read[name] = textIn(fields[name], `${section}.${name}`, 1024);
  return read as unknown as Plate[Name];
}

const printerFrom = (value: unknown): Plate['printer'] => sectionFrom('printer', value, ['profile', 'filament']);

/** A whole plate. @throws Unfit */
export function plateFrom(value: unknown, fileFrom: FileFrom): Plate {
  const fields = fieldsOf(value, '', [...Object.keys(newPlate()), 'brought', 'spool']);
  return {
    name: nameFrom(fields['name']),
    shape: shapeFrom(fields['shape'], fileFrom),
    width: widthFrom(fields['width']),
    height: heightFrom(fields['height']),
    directions: directionsFrom(fields['directions'], fileFrom),
    modes: modesFrom(fields['modes'], fileFrom),
    layers: layersFrom(fields['layers'] ?? [], fileFrom),
    strokes: strokesFrom(fields['strokes']),
    pictures: sectionFrom('pictures', fields['pictures'] ?? {}),
    toolpath: sectionFrom('toolpath', fields['toolpath']),
    print: sectionFrom('print', fields['print']),
    printer: printerFrom(fields['printer']),
    ...(fields['brought'] !== undefined && { brought: printerFrom(fields['brought']) }),
    ...plateSpoolFrom(fields['spool']),
  };
}
