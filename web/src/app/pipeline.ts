// Computes everything that follows from a plate: its toolpath, its marks, and the summary of its file.
import type { Gcode, GcodeCheck } from 'sillon';
import type { Mark } from '../model/view.js';
import type { StudioEngine } from '../engine/studio-engine.js';
import { viewLook } from '../model/filaments.js';
import { bodyInput } from '../model/body.js';
import { engineInput } from '../model/input.js';
import { isOf } from '../model/result.js';
import type { Plate } from '../model/plate.js';
import { isAbort, problemOf, type Problem } from '../model/problem.js';
import type { PlateResult } from '../model/state.js';
import type { Store } from '../model/store.js';
import type { Shown } from '../studio/shown.js';

const summaryAfter = 400; // [ms] without a change, after which the file is written

interface Written {
  plate: Plate;
  result: PlateResult;
  gcode: Gcode;
  check: GcodeCheck;
}

/** Tells whether a written file is still that of the plate. */
const sameFile = (a: Written, plate: Plate, result: PlateResult | undefined): boolean =>
  isOf(a.result, plate) && // a new plate stands beside the old result until its own is there
  a.result.toolpath.cycles === result?.toolpath.cycles &&
  a.plate.print === plate.print &&
  a.plate.printer === plate.printer;

export class Pipeline {
  #written: Written | undefined;
  /** Problem of the file that is shown, until a file succeeds. */
  #told: Problem | undefined;
  #marksWorker: Worker | undefined;
  #summaryTimer: ReturnType<typeof setTimeout> | undefined;
  #summary: AbortController | undefined;

  constructor(
    private readonly store: Store<Shown>,
    private readonly engine: StudioEngine,
    /** Starts marks.worker.ts. */
    private readonly startMarks: () => Worker,
  ) {}

  start(): void {
    this.store.subscribe((state, before) => {
      if (state.plate !== before.plate || state.live !== before.live) this.#follow(state);
    });
    this.#follow(this.store.state);
  }

  retry(): void {
    this.store.set({ cancelled: false, problem: undefined });
    this.engine.retry();
  }

  cancel(): void {
    this.engine.cancel();
    this.store.set({ cancelled: true, progress: undefined });
  }

  /** Returns the complete, measured path of the current plate, even if the plate has only just changed. */
  async finished(): Promise<PlateResult> {
    await this.#followed();
    return this.engine.finished();
  }

  /** Writes the G-code of the current plate. @param unwanted  ends it */
  async gcode(unwanted?: AbortSignal): Promise<Gcode> {
    const current = await this.finished();
    unwanted?.throwIfAborted(); // otherwise it would stop the timer of the next summary
    const { plate } = this.store.state;
    if (this.#written !== undefined && sameFile(this.#written, plate, current)) return this.#written.gcode;
    clearTimeout(this.#summaryTimer);
    const written = { plate, ...(await this.engine.gcode(plate, unwanted)) };
    this.#written = written;
    this.#tell(undefined);
    if (sameFile(written, this.store.state.plate, this.store.state.result))
      this.store.set({ summary: written.gcode.summary, check: written.check });
    return written.gcode;
  }

  async body(): Promise<Blob> {
    await this.#followed();
    return this.engine.body(this.store.state.plate);
  }

  /** Returns a body with zones of straight lines for other slicers:
   * the body under the plate, or a new one of the print's height.
   * @throws errors of bodyInput and of the engine */
  async zones(): Promise<Blob> {
    const { plate } = this.store.state;
    const { input } = engineInput(plate);
    const { base, layers, layerHeight, firstLayerHeight } = plate.print;
    const height = (base + layers - 1) * layerHeight + (firstLayerHeight || layerHeight);
    const engine = await this.engine.engine();
    return (await engine.makeZones(input, { ...(bodyInput(plate) ?? { height }), layerHeight })).file;
  }

  async svg(): Promise<Blob> {
    await this.#followed();
    return this.engine.svg();
  }

  async view(): Promise<Blob> {
    await this.#followed();
    return this.engine.view(viewLook(this.store.state.plate));
  }

  /** Resolves once the engine has been told of a change of this turn. */
  #followed = (): Promise<void> => Promise.resolve();

  onResult(result: PlateResult): void {
    const sameBeads = result.toolpath.cycles === this.store.state.result?.toolpath.cycles;
    this.store.set({ result, ...(sameBeads ? {} : { marks: [], mark: -1 }) });
    if (!result.coarse && !sameBeads) this.#findMarks(result);
    this.#summarise();
  }

  #follow({ plate, live }: Readonly<Shown>): void {
    this.store.set({ cancelled: false });
    this.#summarise();
    this.engine.update(plate, { live });
  }

  /** Searches the marks in a worker; a search that still runs is stopped. */
  #findMarks(result: PlateResult): void {
    this.#marksWorker?.terminate(); // it searches a stale toolpath
    const worker = this.startMarks();
    this.#marksWorker = worker;
    worker.onmessage = ({ data }: MessageEvent<Mark[]>) => {
      worker.terminate();
      this.store.set({ marks: data, mark: -1 });
    };
    worker.postMessage(result.toolpath);
  }

  /** Writes the file, which gives time, length and weight; it is kept for a download. */
  #summarise(): void {
    clearTimeout(this.#summaryTimer);
    this.#summary?.abort(); // the next plate must not wait for it
    const { plate, result, summary } = this.store.state;
    if (this.#written !== undefined && sameFile(this.#written, plate, result)) {
      this.#tell(undefined);
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
        if (!isAbort(error)) this.#tell(problemOf(error));
      });
    }, summaryAfter);
  }

  /** Shows or removes the problem of the file. @param problem  undefined: the file succeeded */
  #tell(problem: Problem | undefined): void {
    const before = this.#told;
    this.#told = problem;
    if (problem !== undefined || (before !== undefined && before === this.store.state.problem))
      this.store.set({ problem });
  }
}
