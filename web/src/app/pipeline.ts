// From a plate to what follows from it: directions, toolpath, places to look at, the file's summary.
import type { Gcode, GcodeCheck } from 'sillon';
import { coarseResolution, fineResolution, type DirectionRaster } from '../model/raster.js';
import type { Mark } from '../model/view.js';
import type { Room } from '../generators/room.js';
import type { Rasteriser } from '../generators/rasteriser.js';
import type { StudioEngine } from '../engine/studio-engine.js';
import { viewLook } from '../model/filaments.js';
import { engineInput } from '../model/input.js';
import { isOf, isRound, roomShape, sameDirections, sameSource } from '../model/result.js';
import { pageOf, type Plate } from '../model/plate.js';
import { isAbort, problemOf, StudioError, type Problem } from '../model/problem.js';
import type { PlateResult } from '../model/state.js';
import type { Store } from '../model/store.js';
import type { Shown } from '../studio/shown.js';

const summaryAfter = 400; // [ms] without a change

interface Drawn {
  plate: Plate;
  raster: DirectionRaster;
  coarse: boolean;
}

interface Written {
  plate: Plate;
  result: PlateResult;
  gcode: Gcode;
  check: GcodeCheck;
}

const sameFile = (a: Written, plate: Plate, result: PlateResult | undefined): boolean =>
  isOf(a.result, plate) && // a new plate stands beside the old result until its own is there
  a.result.toolpath.cycles === result?.toolpath.cycles &&
  a.plate.print === plate.print &&
  a.plate.printer === plate.printer;

export class Pipeline {
  #drawn: Drawn | undefined;
  #drawing: { plate: Plate; coarse: boolean; done: Promise<Problem | undefined> } | undefined;
  #written: Written | undefined;
  /** What went wrong and is told, until it goes well. */
  readonly #told: { drawing?: Problem | undefined; file?: Problem | undefined } = {};
  #cancels = 0;
  #marksWorker: Worker | undefined;
  #summaryTimer: ReturnType<typeof setTimeout> | undefined;
  #summary: AbortController | undefined;

  constructor(
    private readonly store: Store<Shown>,
    private readonly engine: StudioEngine,
    private readonly rasteriser: Rasteriser,
    /** Starts marks.worker.ts. */
    private readonly startMarks: () => Worker,
    /** What of the page is inside the shape. */
    private readonly room: (plate: Plate) => Promise<Room>,
  ) {}

  start(): void {
    this.store.subscribe((state, before) => {
      if (state.plate !== before.plate || state.live !== before.live) this.#follow(state);
    });
    this.#follow(this.store.state);
  }

  retry(): void {
    this.store.set({ cancelled: false, problem: undefined });
    const { plate } = this.store.state;
    if (this.#drawn !== undefined && sameDirections(this.#drawn.plate, plate)) this.engine.retry();
    else this.#follow(this.store.state);
  }

  cancel(): void {
    ++this.#cancels;
    this.engine.cancel();
    this.store.set({ cancelled: true, progress: undefined });
  }

  /** The whole, measured path of the plate as it is now, however newly that has changed. */
  async finished(): Promise<PlateResult> {
    await this.directions();
    return this.engine.finished();
  }

  /** Writes the plate as it is now. @param unwanted  ends it */
  async gcode(unwanted?: AbortSignal): Promise<Gcode> {
    const current = await this.finished();
    unwanted?.throwIfAborted(); // else it would stop the timer of the summary that follows it
    const { plate } = this.store.state;
    if (this.#written !== undefined && sameFile(this.#written, plate, current)) return this.#written.gcode;
    clearTimeout(this.#summaryTimer);
    const written = { plate, ...(await this.engine.gcode(plate, unwanted)) };
    this.#written = written;
    this.#tell('file', undefined);
    if (sameFile(written, this.store.state.plate, this.store.state.result))
      this.store.set({ summary: written.gcode.summary, check: written.check });
    return written.gcode;
  }

  async body(): Promise<Blob> {
    await this.directions();
    return this.engine.body(this.store.state.plate);
  }

  /** A body with zones of straight lines, as high as the print: other slicers make its G-code. */
  async zones(): Promise<Blob> {
    const raster = await this.directions();
    const { plate } = this.store.state;
    const { input } = engineInput({ plate, raster });
    const { base, layers, layerHeight, firstLayerHeight } = plate.print;
    const height = (base + layers - 1) * layerHeight + (firstLayerHeight || layerHeight);
    return (await (await this.engine.engine()).makeZones(input, { height, layerHeight })).file;
  }

  async svg(): Promise<Blob> {
    await this.directions();
    return this.engine.svg();
  }

  async view(): Promise<Blob> {
    await this.directions();
    return this.engine.view(viewLook(this.store.state.plate));
  }

  /** Directions of the plate as it is now, in full, which the engine has been told of.
   * @throws StudioError where they cannot be drawn, AbortError after a cancel */
  async directions(): Promise<DirectionRaster> {
    const cancels = this.#cancels;
    await Promise.resolve(); // by now a change of this turn is being followed
    for (;;) {
      const { plate } = this.store.state;
      const drawn = this.#drawn;
      if (drawn !== undefined && !drawn.coarse && sameDirections(drawn.plate, plate)) return drawn.raster;
      const problem = await this.#draw(plate, false);
      if (problem !== undefined) throw new StudioError(problem.code, problem.values, problem.detail);
      if (cancels !== this.#cancels) throw new DOMException('The job was cancelled', 'AbortError');
    }
  }

  onResult(result: PlateResult): void {
    const sameBeads = result.toolpath.cycles === this.store.state.result?.toolpath.cycles;
    this.store.set({ result, ...(sameBeads ? {} : { marks: [], mark: -1 }) });
    if (!result.coarse && !sameBeads) this.#findMarks(result);
    this.#summarise();
  }

  #follow({ plate, live }: Readonly<Shown>): void {
    this.store.set({ cancelled: false });
    this.#summarise();
    const drawn = this.#drawn;
    const fresh = drawn !== undefined && sameDirections(drawn.plate, plate) && (live || !drawn.coarse);
    if (fresh) {
      this.#tell('drawing', undefined);
      this.engine.update(plate, drawn.raster, { live });
    } else void this.#draw(plate, live);
  }

  /** @returns what went wrong; another plate that came first is no problem. */
  #draw(plate: Plate, live: boolean): Promise<Problem | undefined> {
    // Strokes are cheap on a raster that is there.
    const coarse = live && !(this.#drawn !== undefined && !this.#drawn.coarse && sameSource(this.#drawn.plate, plate));
    const going = this.#drawing;
    // Two who ask for the same must not cut each other off for ever.
    if (going !== undefined && going.coarse === coarse && sameDirections(going.plate, plate)) return going.done;
    const drawing = { plate, coarse, done: this.#rasterise(plate, coarse) };
    this.#drawing = drawing;
    void drawing.done.finally(() => {
      if (this.#drawing === drawing) this.#drawing = undefined;
    });
    return drawing.done;
  }

  async #rasterise(plate: Plate, coarse: boolean): Promise<Problem | undefined> {
    const cancels = this.#cancels;
    try {
      const raster = await this.rasteriser.rasterise({
        source: plate.directions,
        modes: plate.modes,
        strokes: plate.directions.kind === 'lamp' ? [] : plate.strokes, // the engine solves for them alone
        page: pageOf(plate),
        round: isRound(plate),
        room: roomShape(plate) === undefined ? undefined : await this.room(plate),
        resolution: coarse ? coarseResolution : fineResolution,
      });
      if (raster === undefined) return undefined;
      this.#drawn = { plate, raster, coarse };
      this.store.set({ directions: raster });
    } catch (error) {
      const problem = problemOf(error);
      if (!isAbort(error)) this.#tell('drawing', problem);
      return problem;
    }
    const now = this.store.state;
    if (sameDirections(now.plate, plate) && cancels === this.#cancels) this.#follow(now);
    return undefined;
  }

  #findMarks(result: PlateResult): void {
    this.#marksWorker?.terminate(); // what it looks through is stale
    const worker = this.startMarks();
    this.#marksWorker = worker;
    worker.onmessage = ({ data }: MessageEvent<Mark[]>) => {
      worker.terminate();
      this.store.set({ marks: data, mark: -1 });
    };
    worker.postMessage(result.toolpath);
  }

  /** Time, length and weight need the file to be written; it is kept for a download. */
  #summarise(): void {
    clearTimeout(this.#summaryTimer);
    this.#summary?.abort(); // the next plate need not wait for it
    const { plate, result, summary } = this.store.state;
    if (this.#written !== undefined && sameFile(this.#written, plate, result)) {
      this.#tell('file', undefined);
      this.store.set({ summary: this.#written.gcode.summary, check: this.#written.check });
      return;
    }
    if (summary !== undefined) this.store.set({ summary: undefined, check: undefined });
    if (result === undefined || result.coarse || !result.measured || !isOf(result, plate)) return;
    this.#summaryTimer = setTimeout(() => {
      const { state } = this.store;
      if (state.live || state.cancelled || state.result?.toolpath.cycles !== result.toolpath.cycles) return;
      this.#summary = new AbortController();
      this.gcode(this.#summary.signal).catch((error: unknown) => {
        if (!isAbort(error)) this.#tell('file', problemOf(error));
      });
    }, summaryAfter);
  }

  /** @param problem  undefined: it went well, and what was told of it is over */
  #tell(of: 'drawing' | 'file', problem: Problem | undefined): void {
    const before = this.#told[of];
    this.#told[of] = problem;
    if (problem !== undefined || (before !== undefined && before === this.store.state.problem))
      this.store.set({ problem });
  }
}
