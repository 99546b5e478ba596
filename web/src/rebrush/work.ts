// The work on a sliced print: it reads the file, lays beads by the user's choices, and saves the new file.
import type { Cycle, PrintRelief, Rebrushed, SlicedFile, SlicedSurface } from 'sillon';
import { download } from '../files/download.js';
import { smallPng, type DrawingEngine } from '../files/drawn.js';
import { readFile } from '../files/open.js';
import { objectNames } from '../files/print-names.js';
import { brushedName } from '../files/sliced.js';
import { sourceFile } from '../files/source-file.js';
import { r } from '../i18n/rebrush.js';
import { groundOf } from '../model/fills.js';
import { lampFor } from '../model/lamp.js';
import type { SourceFile } from '../model/plate.js';
import { isAbort, problemOf, StudioError, type Problem } from '../model/problem.js';
import { facesOf, howOf, lackOf, sides, type Face, type Side, type Wish } from '../model/rebrush.js';
import { TimeLeft } from '../model/time-left.js';
import type { Light } from '../model/view.js';
import type { Studio } from '../studio/studio.js';
import { left, offer } from './kept.js';

const mostBytes = 256e6; // most bytes of text that the engine reads
const reliefSide = 1600; // cells along the longer side: a few per bead on a print of 200 mm
const restAfter = 350; // [ms] without a change, after which beads are laid
const drawingSide = 1024; // [pixels] longer side of a drawing that becomes a picture

export interface Progress {
  fraction: number;
  secondsLeft: number | undefined;
}

interface Known {
  print?: SlicedFile | undefined;
  /** Names of the print's objects, in the order of their codes, for objectOf. */
  names: readonly string[];
  relief?: PrintRelief | undefined;
  faces: readonly Face[];
  /** Faces shown from above: bottoms if only they can be chosen, otherwise tops. */
  shown: readonly Face[];
  /** Result of the current choices. */
  done?: Rebrushed | undefined;
  /** Latest beads of each face. */
  laid: ReadonlyMap<number, readonly Cycle[]>;
  progress?: Progress | undefined;
  cancelled: boolean;
  problem?: Problem | undefined;
  /** Sentence about a saved file; empty: none was saved. */
  saved: string;
}

const nothing: Known = {
  names: [],
  faces: [],
  shown: [],
  laid: new Map(),
  cancelled: false,
  saved: '',
};
const begun: Progress = { fraction: 0, secondsLeft: undefined };

/** Turns a drawing into a picture for lamps. */
async function paintedPicture({ name, bytes }: SourceFile, engine: DrawingEngine): Promise<SourceFile> {
  const png = await smallPng(bytes, engine, drawingSide);
  return sourceFile(name, new Uint8Array(await png.arrayBuffer()));
}

export class PrintWork {
  known = nothing;
  wish: Wish;
  #file: File | undefined;
  #job = new AbortController();
  #rest: ReturnType<typeof setTimeout> | undefined;

  constructor(
    readonly studio: Studio,
    light: Light,
    private readonly changed: () => void,
  ) {
    const { plate } = studio.store.state;
    const ground = groundOf(plate);
    this.wish = {
      side: 'top',
      chosen: new Set(),
      way: 'angle',
      angle: ground?.kind === 'direction' ? ground.angle : 30,
      picture: undefined,
      lamp: lampFor([], light),
      spool: plate.pictures.spool,
      own: plate.spool,
      fit: 'face',
      strokes: [],
    };
  }

  #know(change: Partial<Known>): void {
    this.known = { ...this.known, ...change };
    this.changed();
  }

  /** Starts a job and aborts the previous one. @returns the signal of the new job */
  #begin(): AbortSignal {
    clearTimeout(this.#rest);
    this.#job.abort();
    this.#job = new AbortController();
    return this.#job.signal;
  }

  // --- The file -----------------------------------------------------------------------------------------------------------

  take(file: File): void {
    if (file === this.#file) return;
    this.leave();
    this.#file = file;
    void this.#read(file);
  }

  /** Leaves the print. Strokes take long to draw, so they are kept, and an offer leads back to them. */
  leave(): void {
    this.#begin();
    const file = this.#file;
    const keeps = file !== undefined && this.wish.strokes.length > 0;
    this.#keep(keeps, false);
    if (!keeps) return;
    left.set(file, this.wish);
    offer(this.studio, file);
  }

  /** Keeps the print and its choices with the plate, so that a reload does not lose them.
   * @param keeps  false: forgets them */
  #keep(keeps: boolean, open: boolean): void {
    const file = this.#file;
    this.studio.services.keepPrint(keeps && file !== undefined ? { file, wish: this.wish, open } : undefined);
  }

  /** Reads a print: its faces, its relief and the names of its objects. */
  async #read(file: File): Promise<void> {
    const signal = this.#begin();
    this.wish = { ...this.wish, strokes: [] };
    this.known = nothing;
    this.#know({ progress: begun });
    try {
      if (file.size > mostBytes) {
        throw new StudioError('TooLarge', { name: file.name, mb: Math.ceil(file.size / 1e6), most: mostBytes / 1e6 });
      }
      const engine = await this.studio.services.engine();
      // Both jobs run one after the other in one worker, which reads the file once. Each takes about half of the time.
      const told = (begin: number) => ({
        signal,
        onProgress: ({ fraction }: { fraction: number }): void => {
          if (!signal.aborted) this.#know({ progress: { ...begun, fraction: begin + fraction / 2 } });
        },
      });
      const print = await engine.listSurfaces(file, told(0));
      if (signal.aborted) return;
      // A print is usable even if its relief fails.
      const relief = await engine.printRelief(file, reliefSide, told(0.5)).catch(() => undefined);
      if (signal.aborted as boolean) return;
      const names = await objectNames(file);
      if (signal.aborted as boolean) return;
      const free = (side: Side): boolean => facesOf(print.surfaces, side).some((face) => face.left === '');
      const kept = left.get(file);
      this.#know({ print, names, relief, progress: undefined });
      this.wish = {
        ...this.wish,
        ...this.#all(kept?.side ?? (!free('top') && free('bottom') ? 'bottom' : 'top')),
        ...kept,
      };
      left.delete(file);
      this.#keep(true, true);
      if (this.wish.chosen.size > 0) void this.lay();
    } catch (error) {
      if (!signal.aborted)
        this.#know({ progress: undefined, ...(isAbort(error) ? {} : { problem: problemOf(error) }) });
    }
  }

  // --- Choices ------------------------------------------------------------------------------------------------------------

  free = (): Face[] => this.known.faces.filter((face) => face.left === '');

  /** Returns the chosen faces that stay as they were after beads were laid. */
  staying(): SlicedSurface[] {
    const made = this.known.done?.surfaces ?? []; // if all faces were requested, those that nobody could choose are listed, too
    return made.filter(({ replaced, index }) => !replaced && this.wish.chosen.has(index));
  }

  /** Returns the sides that the file has. */
  sides(): readonly Side[] {
    const has = (side: Side): boolean => this.known.print?.surfaces.some((surface) => surface.side === side) === true;
    return sides.filter((side) => (side === 'both' ? has('top') && has('bottom') : has(side)));
  }

  /** Chooses all faces of a side that can be replaced. */
  #all(side: Side): Pick<Wish, 'side' | 'chosen'> {
    const faces = facesOf(this.known.print?.surfaces ?? [], side);
    this.#know({ faces, shown: side === 'bottom' ? faces : faces.filter((face) => face.side === 'top') });
    return { side, chosen: new Set(this.free().map(({ index }) => index)) };
  }

  wantSide(side: Side): void {
    this.want(this.#all(side));
  }

  toggle(index: number): void {
    if (!this.free().some((face) => face.index === index)) return;
    const chosen = new Set(this.wish.chosen);
    if (!chosen.delete(index)) chosen.add(index);
    this.want({ chosen });
  }

  /** Uses a file as the picture. @throws StudioError if the engine cannot read it */
  async wantPicture(file: File, light: Light): Promise<void> {
    const [{ source, kind }, engine] = await Promise.all([readFile(file), this.studio.services.engine()]);
    const { name } = source;
    if (kind !== 'picture' && kind !== 'svg') throw new StudioError('UnknownFile', { name });
    try {
      await (kind === 'svg' ? engine.paintDrawing(source.bytes) : engine.decodePicture(source.bytes));
    } catch (error) {
      throw new StudioError('InvalidFile', { name }, problemOf(error).detail);
    }
    const picture = kind === 'picture' ? source : await paintedPicture(source, engine);
    this.want({ picture, way: 'picture', lamp: lampFor([], light) });
  }

  undoStroke(): void {
    this.want({ strokes: this.wish.strokes.slice(0, -1) });
  }

  /** Changes the choices; beads follow after a pause. */
  want(change: Partial<Wish>): void {
    this.#begin();
    this.wish = { ...this.wish, ...change };
    const lacks = lackOf(this.wish) !== '';
    const progress = lacks ? undefined : begun;
    this.#know({ done: undefined, progress, cancelled: false, problem: undefined, saved: '' });
    this.#keep(true, true);
    if (!lacks) this.#rest = setTimeout(() => void this.lay(), restAfter);
  }

  // --- Beads --------------------------------------------------------------------------------------------------------------

  /** Lays beads by the current choices. */
  async lay(): Promise<void> {
    const { wish, studio } = this;
    const { print } = this.known;
    const file = this.#file;
    if (file === undefined || print === undefined) return;
    const signal = this.#begin();
    this.#know({ done: undefined, progress: begun, cancelled: false, problem: undefined });
    const timeLeft = new TimeLeft(performance.now());
    try {
      const { plate } = studio.store.state;
      const engine = await studio.services.engine();
      if (signal.aborted) return;
      const how = howOf(wish, this.free(), plate, print.nozzle);
      const done = await engine.rebrush(file, how, {
        signal,
        onProgress: ({ fraction }) => {
          if (signal.aborted) return;
          this.#know({ progress: { fraction, secondsLeft: timeLeft.estimate(fraction, performance.now()) } });
        },
      });
      if (signal.aborted as boolean) return;
      const laid = new Map(done.surfaces.map(({ index, cycles }) => [index, cycles]));
      this.#know({ done, laid, progress: undefined });
    } catch (error) {
      if (!signal.aborted && !isAbort(error)) this.#know({ progress: undefined, problem: problemOf(error) });
    }
  }

  cancel = (): void => {
    this.#begin();
    this.#know({ progress: undefined, cancelled: true });
  };

  save = (): void => {
    const { done } = this.known;
    if (done === undefined || this.#file === undefined) return;
    const name = brushedName(this.#file.name);
    download(done.blob, name); // the file is the visitor's own: it is not handed to a surrounding page
    this.#know({ saved: r('saved', { name }) });
  };

  /** Runs an action and shows its failure beside the print. */
  async attempt(action: () => Promise<void>): Promise<void> {
    try {
      await action();
    } catch (error) {
      if (!isAbort(error)) this.#know({ problem: problemOf(error) });
    }
  }
}
