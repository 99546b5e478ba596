// Reads opened files, guesses their roles, and puts them into a plate.
import type { Engine } from 'sillon';
import { newFileShape, newShape } from '../model/defaults.js';
import { changeGround, filledWith, fillOf, groundOf, groundPictures, type Fill } from '../model/fills.js';
import { homeLight, lampFor, mostPictures } from '../model/lamp.js';
import { isFontFile } from '../model/layer-list.js';
import type { LayerValues } from '../model/layers.js';
import { isRoundKind, type Plate, type SourceFile } from '../model/plate.js';
import { StudioError, problemOf } from '../model/problem.js';
import type { FileNote, Opened, OpenedFiles, Role } from '../model/file-role.js';
import type { Light } from '../model/view.js';
import { isAnimated } from './animated.js';
import { coloursIn, coloursOf, isSvg } from './drawn.js';
import { checkDrawing } from './drawing-size.js';
import { allowedRoles, factsOf, guessRoles, type PictureFacts } from './guess.js';
import { enoughToKnow, kindOf, otherFormat, type Kind } from './kind.js';
import { filesOf } from './plate-project.js';
import { readable } from './readable.js';
import { printOf } from './sliced.js';
import { sourceFile, stemOf } from './source-file.js';

const mostBytes = { one: 64e6, project: 256e6, together: 256e6 };

export interface Found {
  /** The plate of a project; where there is one, the other fields are empty. */
  project: Plate | undefined;
  opened: Opened[];
  /** Reasons why some of the files cannot be used. */
  refused: StudioError[];
}

type OpeningEngine = Pick<Engine, 'decodePicture' | 'paintDrawing' | 'readShape' | 'readProject'>;

interface Read {
  source: SourceFile;
  kind: Kind;
  notes: readonly FileNote[];
}

const megabytes = (bytes: number): number => Math.ceil(bytes / 1e6);

/** Limits the size of all files together. @throws StudioError InvalidFile */
function checkTogether(files: readonly File[]): void {
  const together = files.reduce((sum, { size }) => sum + size, 0);
  if (together > mostBytes.together) {
    const most = megabytes(mostBytes.together);
    throw new StudioError('InvalidFile', {}, `the files have ${megabytes(together)} MB together; at most ${most} MB`);
  }
}

/** Limits the size of one file, which is larger for projects. @throws StudioError InvalidFile */
function checkSize({ name, size }: File): void {
  const most = /\.zip$/i.test(name) ? mostBytes.project : mostBytes.one;
  if (size > most) {
    throw new StudioError('InvalidFile', { name }, `${name} has ${megabytes(size)} MB; at most ${megabytes(most)} MB`);
  }
}

/** Reads a file, checks its size and recognises its kind.
 * @throws StudioError InvalidFile, UnknownFile, BodyHere, PrinterFileHere, BrowserPicture */
export async function readFile(given: File): Promise<Read> {
  checkSize(given);
  const file = await readable(given);
  let bytes: Uint8Array<ArrayBuffer>;
  try {
    bytes = new Uint8Array(await file.arrayBuffer());
  } catch (error) {
    // The file is a folder, or has been deleted since.
    throw new StudioError('InvalidFile', { name: file.name }, `${file.name}: ${problemOf(error).detail}`);
  }
  const { kind } = kindOf(bytes.subarray(0, enoughToKnow), file.name);
  const source = await sourceFile(file.name, bytes);
  if (kind === 'unknown') {
    if (/\.(stl|step|stp|obj|ply|amf)$/i.test(source.name)) throw new StudioError('BodyHere', { name: source.name });
    const ofPrinter = /\.(gcode|gco|g|bgcode|3mf|ini)$/i.test(source.name);
    const format = bytes.length === 0 ? 'empty' : otherFormat(bytes, source.name);
    throw new StudioError(ofPrinter ? 'PrinterFileHere' : 'UnknownFile', {
      name: source.name,
      ...(format === '' ? {} : { format }),
    });
  }
  if (kind === 'svg') checkDrawing(source.name, bytes);
  const own = file === given ? bytes : new Uint8Array(await given.arrayBuffer());
  return { source, kind, notes: kind === 'picture' && isAnimated(own) ? ['animated'] : [] };
}

// Figures of pictures, so that each is decoded once however often its role changes.
const known = new WeakMap<SourceFile, PictureFacts>();

/** Adds the file's name to an error of the engine. */
async function naming<Result>(name: string, promise: Promise<Result>): Promise<Result> {
  try {
    return await promise;
  } catch (error) {
    const { code, values, detail } = problemOf(error);
    throw code === 'InvalidFile' ? new StudioError(code, { ...values, name }, `${name}: ${detail}`) : error;
  }
}

/** Figures about a picture, which is decoded for them once. */
async function pictureFacts(source: SourceFile, engine: Pick<Engine, 'decodePicture'>): Promise<PictureFacts> {
  const before = known.get(source);
  if (before !== undefined) return before;
  const facts = factsOf(await naming(source.name, engine.decodePicture(source.bytes)));
  known.set(source, facts);
  return facts;
}

/** A picture in a form that can be seen, with its figures: white artwork is put on black. */
async function seenPicture(
  source: SourceFile,
  notes: readonly FileNote[],
  engine: Pick<Engine, 'decodePicture'>,
): Promise<{ source: SourceFile; notes: readonly FileNote[]; facts: PictureFacts }> {
  const facts = await pictureFacts(source, engine);
  if (!facts.whiteOnClear) return { source, notes, facts };
  const { onBlack } = await import('./white-artwork.js');
  const dark = await onBlack(source, await engine.decodePicture(source.bytes)).catch(() => undefined);
  if (dark === undefined) return { source, notes, facts };
  return { source: dark, notes: [...notes, 'white'], facts: await pictureFacts(dark, engine) };
}

export const isFont = ({ name }: File): boolean => isFontFile(name);

/** Result of `printOf` for a single file; '' for none or several. */
export const onePrint = (files: readonly File[]): ReturnType<typeof printOf> =>
  files[0] === undefined || files.length > 1 ? Promise.resolve('') : printOf(files[0]);

/** Reads files and guesses their roles.
 * @param plate  the plate that will use them
 * @throws StudioError where none of them can be used, TooManyFiles, BrokenProject; errors of the engine */
export async function identify(files: readonly File[], plate: Plate, engine: OpeningEngine): Promise<Found> {
  checkTogether(files);
  const refused: StudioError[] = [];
  /** Results for the files that can be used; the others are added to `refused`. */
  const each = async <From, To>(all: readonly From[], work: (one: From) => Promise<To>): Promise<To[]> => {
    const done: To[] = [];
    for (const one of all) {
      try {
        done.push(await work(one));
      } catch (error) {
        if (!(error instanceof StudioError)) throw error;
        refused.push(error);
      }
    }
    if (done.length === 0 && refused[0] !== undefined) throw refused[0];
    return done;
  };
  const all = await each(files, readFile);

  const projects = all.filter(({ kind }) => kind === 'zip' || kind === 'json');
  const [project] = projects;
  if (projects.length > 1) throw new StudioError('TooManyFiles');
  if (project !== undefined) {
    const { readProject } = await import('./project.js');
    const others = all.filter((one) => one !== project).map(({ source }) => source);
    return { project: await readProject(project.source, others, engine), opened: [], refused };
  }

  const guessed = await each(all, async ({ source, kind, notes }) => {
    const { name } = source;
    if (kind === 'font') throw new StudioError('UnknownFile', { name }); // only layers have letters in fonts of their own
    // A single drawing is read when it is used. Among others it is read here, so that a bad one does not spoil the
    // rest.
    if (kind === 'svg' && all.length > 1) await naming(name, engine.readShape({ file: source.bytes, unitless: 'px' }));
    return kind === 'svg'
      ? { source, kind, notes, name, facts: undefined, colours: (await coloursIn(source, engine)).length }
      : { kind, name, ...(await seenPicture(source, notes, engine)) };
  });
  const roles = guessRoles(guessed, plate);
  const opened = guessed.map(({ source, kind, notes }, k) => ({
    source,
    notes,
    role: roles[k] ?? 'none',
    roles: allowedRoles(kind === 'picture'),
  }));
  return { project: undefined, opened, refused };
}

// --- Into a plate ------------------------------------------------------------------------------------------------------

type Size = readonly [number, number];

const tenths = (length: number): number => Math.max(0.1, Math.round(10 * length) / 10);

/** Ratio of the sides above which a page is a strip. Strips are made as large as other pages by area and not by
 * length. */
const strip = 3;
const mostOfBed = 0.9; // share of the bed; the plate needs room around it, too

export const isStrip = ([wide, tall]: Size): boolean => Math.max(wide / tall, tall / wide) > strip;

/** The longer side of a page; for a strip, that of a page with the same area and the greatest ratio that is no
 * strip. */
const extentOf = ([wide, tall]: Size): number => Math.min(Math.max(wide, tall), Math.sqrt(strip * wide * tall));

/** A page in these proportions, as large as the plate was: equally long or, for a strip, by its area. It grows no
 * longer than the bed. */
function proportioned(plate: Plate, page: Size): Pick<Plate, 'width' | 'height'> {
  const [wide, tall] = page;
  const { width: before, height, printer } = plate;
  const { bedMin, bedMax } = printer;
  const room = ([0, 1] as const).map((k) => Math.max(before, height, mostOfBed * (bedMax[k] - bedMin[k])) / page[k]);
  const scale = Math.min(extentOf([before, height || before]) / extentOf(page), ...room);
  const width = tenths(wide * scale);
  return { width, height: (width * tall) / wide };
}

/** Tells whether a drawing states its size in a physical unit. Pixels say nothing about millimetres. */
export async function hasUnits({ bytes }: SourceFile): Promise<boolean> {
  const [root = ''] = /<(?:[\w-]{1,40}:)?svg\s[^>]*>/.exec(await bytes.slice(0, enoughToKnow).text()) ?? [];
  return /\s(?:width|height)\s*=\s*["']\s*[\d.eE+-]+\s*(?:mm|cm|in|pt|pc|q)\s*["']/i.test(root);
}

const smallest = 10; // [mm]; a smaller drawing was probably made in another unit

/** The drawing's own size where that can be printed, else one in its proportions. */
function drawn(plate: Plate, [width, height]: Size): Pick<Plate, 'width' | 'height'> {
  const { bedMin, bedMax } = plate.printer;
  const fits = width <= bedMax[0] - bedMin[0] && height <= bedMax[1] - bedMin[1] && Math.max(width, height) >= smallest;
  return fits ? { width, height } : proportioned(plate, [width, height]);
}

/** Fills of roles, and the values that each gives its fill. */
const fills: Partial<Record<Role, [Fill, Partial<LayerValues>]>> = {
  angle: ['map', { encoding: 'angle' }],
  rotation: ['map', { encoding: 'rotation' }],
  tangent: ['map', { encoding: 'tangent' }],
  tone: ['brightness', {}],
  edges: ['edges', {}],
  levels: ['levels', {}],
};

/** Fills the plate from a file, and keeps the choices made for a file with the same fill. */
function withFill(plate: Plate, fill: Fill, given: Partial<LayerValues>): Plate {
  const ground = groundOf(plate);
  return ground !== undefined && fillOf(ground) === fill ? changeGround(plate, given) : filledWith(plate, fill, given);
}

/** Gives built-in shapes the picture's proportions. A round shape can only be square, so it becomes a rectangle for
 * other pictures. */
function framed(plate: Plate, [wide, tall]: Size): Plate {
  const { shape } = plate;
  const page = proportioned(plate, [wide, tall]);
  if (shape.kind === 'file') return plate;
  const square = Math.abs(Math.log(wide / tall)) < 0.02;
  if (isRoundKind(shape.kind)) return square ? plate : { ...plate, ...page, shape: newShape('rectangle') };
  return { ...plate, ...page };
}

/** Puts a file to use in the plate.
 * @param size  the page [mm] for a shape, else the picture's pixels
 * @param light  the light on the screen, which pictures are solved for */
export function withFile(
  plate: Plate,
  file: SourceFile,
  role: Role,
  size: Size,
  light: Light = homeLight(plate, undefined),
): Plate {
  const { shape } = plate;
  switch (role) {
    case 'shape':
    case 'mask': {
      const next = newFileShape(file, shape.unitless);
      // The same shape again keeps the size that the visitor has given it.
      if (shape.kind === 'file' && shape.file === file) return plate;
      return { ...plate, shape: next, ...(role === 'shape' ? drawn(plate, size) : proportioned(plate, size)) };
    }
    case 'modes':
      return groundOf(plate) === undefined
        ? filledWith(plate, 'direction', { modeFile: file })
        : changeGround(plate, { modeFile: file });
    case 'none':
    case 'project':
    case 'colours':
      return plate;
    case 'lamp':
    case 'more': {
      const before = groundPictures(plate);
      const kept = role === 'more' ? before.filter((one) => one.file !== file).slice(0, mostPictures - 1) : [];
      const stands = role === 'lamp' ? before[0]?.lamp : undefined;
      const pictures = [...kept, { file, lamp: stands ?? lampFor(kept, light) }];
      return withFill(kept.length > 0 ? plate : framed(plate, size), 'picture', { pictures });
    }
    default: {
      const [fill, given] = fills[role] ?? [];
      return fill === undefined ? plate : withFill(framed(plate, size), fill, { ...given, file });
    }
  }
}

/** Parts of a plate that files change. A shape and its size are one part. */
const parts: readonly (readonly (keyof Plate)[])[] = [['name'], ['layers'], ['shape', 'width', 'height']];

/** Takes files out of the plate. Parts that the visitor has changed since then stay as they are. */
export function withoutFiles(plate: Plate, { before, made }: OpenedFiles): Plate {
  const untouched = parts.filter((part) => part.every((key) => plate[key] === made[key])).flat();
  return { ...plate, ...Object.fromEntries(untouched.map((key) => [key, before[key]])) };
}

type Tell = (problem: StudioError) => void;

/** Roles of pictures in which something is to be recognised. */
const seen: readonly Role[] = ['lamp', 'more', 'tone', 'edges', 'levels', 'colours'];

/** Size of an opened file: the page [mm] for a shape, else its pixels. Calls `tell` with what will not be seen of
 * it. */
async function sizeOf(
  plate: Plate,
  { source, role }: Opened,
  engine: OpeningEngine,
  tell: Tell | undefined,
): Promise<Size> {
  if (role === 'shape') {
    const { unitless } = plate.shape;
    const {
      page,
      texts = 0,
      images = 0,
      otherFont = false,
    } = await naming(source.name, engine.readShape({ file: source.bytes, unitless }));
    if (texts + images > 0) tell?.(new StudioError('LeftOut', { name: source.name }));
    if (otherFont) tell?.(new StudioError('OtherFont', { name: source.name }));
    if (unitless === 'mm' || (await hasUnits(source))) return page;
    const { width: wide, height: tall } = proportioned(plate, page);
    return [wide, tall];
  }
  const { width, height, oneTone } = await pictureFacts(source, engine);
  if (oneTone && seen.includes(role)) tell?.(new StudioError('OneTone', { name: source.name }));
  return [width, height];
}

/** Gives each flat colour of a file a direction. A drawing also becomes the shape. */
async function withColours(
  plate: Plate,
  opened: Opened,
  engine: OpeningEngine,
  tell: Tell | undefined,
): Promise<Plate> {
  const { source: file } = opened;
  const ground = groundOf(plate);
  const before = ground !== undefined && fillOf(ground) === 'colours' ? ground.colours : [];
  const drawn = isSvg(file);
  const size = await sizeOf(plate, drawn ? { ...opened, role: 'shape' } : opened, engine, tell);
  const made = drawn ? withFile(plate, file, 'shape', size) : framed(plate, size);
  return withFill(made, 'colours', { file, colours: await coloursOf(file, engine, before) });
}

/** Tells whether the plate is still named after one of its files, so nobody has given it a name. */
const isOfFile = (plate: Plate): boolean => filesOf(plate).some(({ name }) => stemOf(name) === plate.name);

/** Puts all files to use. Shapes come first, since pictures are laid over them.
 * @param tell  called with each part of a file that is not in the plate
 * @param light  the light on the screen
 * @throws errors of the engine */
export async function withFiles(
  plate: Plate,
  opened: readonly Opened[],
  engine: OpeningEngine,
  tell?: Tell,
  light?: Light,
): Promise<Plate> {
  const used = opened.filter(({ role }) => role !== 'none');
  const isShape = ({ role }: Opened): boolean => role === 'shape' || role === 'mask';
  let made = plate;
  for (const one of [...used.filter(isShape), ...used.filter((other) => !isShape(other))]) {
    made =
      one.role === 'colours'
        ? await withColours(made, one, engine, tell)
        : withFile(made, one.source, one.role, await sizeOf(made, one, engine, tell), light);
  }
  const pictured = used.find(({ role }) => role !== 'modes');
  const first = plate.name === '' ? used[0] : isOfFile(plate) ? pictured : undefined;
  return first === undefined ? made : { ...made, name: stemOf(first.source.name) };
}
