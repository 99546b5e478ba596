// The only module that runs jobs on the engine. Only the newest plate counts: a preview during a drag, the whole path
// when the drag rests, then its measures. One job runs at a time; jobs that become stale are stopped.
import type { Engine, EngineInfo, Gcode, GcodeCheck, Toolpath, ViewParams } from 'sillon';
import { viewLook } from '../model/filaments.js';
import type { Plate } from '../model/plate.js';
import { isAbort, problemOf, StudioError, type Problem } from '../model/problem.js';
import type { PlateResult, Progress } from '../model/state.js';
import { Cost } from './coarse.js';
import { engineInput } from '../model/input.js';
import { platesFor } from '../model/lamp.js';
import { sameSolved, sameToolpath } from '../model/result.js';
import { TimeLeft } from '../model/time-left.js';

const restAfter = 250; // [ms] without an update, after which a drag counts as at rest

export interface EngineEvents {
  onResult(result: PlateResult): void;
  /** Reports progress; undefined: nothing runs. */
  onProgress(progress: Progress | undefined): void;
  /** Reports a problem; undefined: the last one is over. */
  onProblem(problem: Problem | undefined): void;
  onInfo(info: EngineInfo): void;
}

export interface EngineHost {
  /** Loads the engine: called when it is first needed, and again after a failure. */
  load(): Promise<Engine>;
  /** Returns the time [ms]. */
  now(): number;
}

type Kind = 'coarse' | 'full' | 'measured';
const order = ['none', 'coarse', 'full', 'measured'] as const;

interface Wanted {
  plate: Plate;
  live: boolean;
}

interface Done {
  plate: Plate;
  level: (typeof order)[number];
  result: PlateResult | undefined;
  problem: Problem | undefined;
}

interface Job {
  kind: Kind;
  /** Factor by which the spacing is widened. */
  factor: number;
  plate: Plate;
  /** Started during a drag. It is short, and would show nothing if it were stopped, so it may finish. */
  quick: boolean;
}

interface Running extends Job {
  control: AbortController;
}

interface Waiter {
  resolve(result: PlateResult): void;
  reject(error: unknown): void;
}

export class StudioEngine {
  #engine: Promise<Engine> | undefined;
  #loaded = false;
  #latest: Plate | undefined;
  /** Plate to make; undefined: none was requested, or the job was cancelled. */
  #wanted: Wanted | undefined;
  #running: Running | undefined;
  #done: Done | undefined;
  #rest: ReturnType<typeof setTimeout> | undefined;
  #waiters: Waiter[] = [];
  readonly #exports = new Set<AbortController>();
  readonly #cost = new Cost();
  #problem: Problem | undefined;

  constructor(
    private readonly host: EngineHost,
    private readonly events: EngineEvents,
  ) {}

  /** Requests the current plate. @param live  a drag goes on: a preview is enough */
  update(plate: Plate, { live = false }: { live?: boolean } = {}): void {
    this.#latest = plate;
    this.#wanted = { plate, live };
    clearTimeout(this.#rest);
    if (live) {
      this.#rest = setTimeout(() => this.#settle(), restAfter);
    }
    const running = this.#running;
    if (running !== undefined && !running.quick && !sameToolpath(running.plate, plate)) running.control.abort();
    this.#pump();
  }

  /** Stops all jobs, running or waiting; the next update, or `retry`, starts again. */
  cancel(): void {
    clearTimeout(this.#rest);
    this.#wanted = undefined;
    this.#running?.control.abort();
    for (const control of this.#exports) control.abort();
    this.#tellWaiters((waiter) => waiter.reject(aborted()));
  }

  /** Makes the latest plate again, after a problem or a cancel. */
  retry(): void {
    if (this.#latest === undefined) return;
    if (this.#done?.problem !== undefined) this.#done = undefined;
    this.#wanted = { plate: this.#latest, live: false };
    this.#pump();
  }

  /** Writes G-code of the last update's path, complete and measured.
   * @param plate  plate whose printer and print settings are used
   * @param unwanted  ends the job, because the engine makes no plate in the meantime
   * @throws SillonError, StudioError, AbortError */
  async gcode(plate: Plate, unwanted?: AbortSignal): Promise<{ gcode: Gcode; check: GcodeCheck; result: PlateResult }> {
    return this.#export(async (engine, result, signal) => {
      const below = await this.#below(engine, plate, signal);
      const gcode = await engine.writeGcode(inItsColour(result.toolpath, plate), plate.printer, plate.print, {
        ...below,
        signal,
      });
      return { gcode, check: await engine.checkGcode(gcode.blob, plate.printer, { signal }), result };
    }, unwanted);
  }

  /** Writes the base layers as a solid. @param plate  plate whose printer and layers are used */
  async body({ printer, print }: Plate): Promise<Blob> {
    return this.#export((engine, { toolpath }, signal) =>
      engine.writeBaseBody(toolpath.shape, printer, print, { signal }),
    );
  }

  async svg(): Promise<Blob> {
    return this.#export((engine, { toolpath }, signal) => engine.writeSvg(toolpath, { signal }));
  }

  /** Returns the path of the latest plate, complete and measured: its measures go into the G-code.
   * @throws SillonError, StudioError, AbortError */
  finished(): Promise<PlateResult> {
    if (this.#latest === undefined) return Promise.reject(new Error('no plate was asked for'));
    return new Promise((resolve, reject) => {
      this.#waiters.push({ resolve, reject });
      this.#wanted ??= { plate: this.#latest as Plate, live: false };
      this.#settle();
    });
  }

  /** Writes a file for <sillon-view>. @param look  look of the plate's filament */
  async view(look: ViewParams): Promise<Blob> {
    return this.#export((engine, { toolpath }, signal) => engine.writeView(toolpath, look, { signal }));
  }

  /** Returns the engine, for jobs that need neither the queue nor a plate: reading shapes, pictures and projects. */
  async engine(): Promise<Engine> {
    if (this.#engine === undefined) {
      const loading = this.host.load();
      this.#engine = loading;
      loading.then(
        (engine) => {
          this.#loaded = true;
          this.events.onInfo(engine.info);
        },
        () => {
          this.#engine = undefined;
        },
      );
    }
    return this.#engine;
  }

  // --- Choice of the next job ---------------------------------------------------------------------------------------------

  /** Ends a drag: the whole path follows. */
  #settle(): void {
    clearTimeout(this.#rest);
    if (this.#wanted !== undefined) this.#wanted = { ...this.#wanted, live: false };
    this.#pump();
  }

  /** Returns the next job for the wanted plate; undefined: all is done. */
  #nextJob(): Job | undefined {
    const wanted = this.#wanted;
    if (wanted === undefined) return undefined;
    const { plate } = wanted;
    const done = this.#done !== undefined && sameToolpath(this.#done.plate, plate) ? this.#done : undefined;
    if (done?.problem !== undefined) return undefined;
    const level = order.indexOf(done?.level ?? 'none');
    const corrected = platesFor(plate) > 1; // too slow for a preview that follows a drag
    if (wanted.live) {
      // Other directions are shown without beads.
      const made = this.#done?.result !== undefined && sameSolved(this.#done.plate, plate);
      const factor = level > 0 || !made ? undefined : this.#cost.factorFor(plate);
      if (factor === undefined) return undefined;
      return { kind: factor > 1 || corrected ? 'coarse' : 'full', factor, plate, quick: true };
    }
    if (corrected && level === 0) return { kind: 'coarse', factor: 1, plate, quick: false };
    // Corrections are made once, together with the measures, because the engine keeps only the last plate.
    if (!corrected && level < order.indexOf('full')) return { kind: 'full', factor: 1, plate, quick: false };
    if (level < order.indexOf('measured')) return { kind: 'measured', factor: 1, plate, quick: false };
    return undefined;
  }

  /** Starts the next job unless one is running. */
  #pump(): void {
    if (this.#running !== undefined) return;
    const job = this.#nextJob();
    if (job === undefined) {
      this.events.onProgress(undefined);
      this.#tellFinished();
      return;
    }
    const control = new AbortController();
    this.#running = { ...job, control };
    void this.#run(job, control.signal).finally(() => {
      this.#running = undefined;
      this.#pump();
    });
  }

  /** Runs a job and reports its result or its problem. */
  async #run(job: Job, signal: AbortSignal): Promise<void> {
    const { kind, plate: asked } = job;
    try {
      if (!this.#loaded) this.#tellProgress('loading', '', 0, undefined);
      const engine = await this.engine();
      if (signal.aborted) return;
      const result = await this.#make(engine, job, signal);
      // A change of printer or name during the job leaves the toolpath the same.
      const wanted = this.#wanted?.plate;
      const plate = wanted !== undefined && sameToolpath(wanted, asked) ? wanted : asked;
      this.#done = { plate: asked, level: kind, result: { ...result, plate }, problem: undefined };
      this.#tellProblem(undefined);
      this.events.onResult({ ...result, plate });
    } catch (error) {
      if (isAbort(error) || signal.aborted) return;
      const problem = problemOf(error);
      this.#done = { plate: asked, level: 'none', result: undefined, problem };
      // A problem of a plate that has been replaced would only confuse.
      if (this.#wanted !== undefined && sameToolpath(this.#wanted.plate, asked)) this.#tellProblem(problem);
    }
  }

  /** Makes the toolpath of a job. */
  async #make(engine: Engine, { kind, quick, factor, plate }: Job, signal: AbortSignal): Promise<PlateResult> {
    const begin = this.host.now();
    const timeLeft = new TimeLeft(begin);
    const measure = kind === 'measured';
    // The beads are the same as before, so `cycles` is kept: views that compare it need not upload them again.
    const made = this.#done;
    const same = measure && made?.level === 'full' && sameToolpath(made.plate, plate);
    const before = same ? made.result?.toolpath : undefined;
    const job = before === undefined ? 'making' : 'measuring';
    if (!quick) this.#tellProgress(job, '', 0, undefined);
    const { input, params } = engineInput(plate, kind === 'coarse' ? { factor } : undefined);
    const { toolpath, report, conflict } = await engine.generateToolpath(input, params, {
      measure,
      signal,
      onProgress: ({ stage, fraction }) => {
        if (quick || signal.aborted) return;
        this.#tellProgress(job, stage, fraction, timeLeft.estimate(fraction, this.host.now()));
      },
    });
    if (!measure) this.#cost.learn(plate, factor, this.host.now() - begin);
    return {
      plate,
      toolpath: before === undefined ? toolpath : { ...toolpath, cycles: before.cycles, shape: before.shape },
      report,
      conflict,
      coarse: kind === 'coarse',
      measured: measure,
    };
  }

  // --- Exports --------------------------------------------------------------------------------------------------------------

  /** Writes a file of the latest plate once its path is complete; `unwanted` or `cancel` ends it. */
  async #export<Result>(
    write: (engine: Engine, result: PlateResult, signal: AbortSignal) => Promise<Result>,
    unwanted?: AbortSignal,
  ): Promise<Result> {
    const control = new AbortController();
    const { signal } = control;
    if (unwanted?.aborted === true) control.abort();
    unwanted?.addEventListener('abort', () => control.abort());
    this.#exports.add(control);
    try {
      const result = await this.finished();
      const engine = await this.engine();
      if (signal.aborted) throw aborted();
      if (this.#running === undefined) this.#tellProgress('writing', '', 0, undefined);
      return await write(engine, result, signal);
    } finally {
      this.#exports.delete(control);
      if (this.#running === undefined) this.events.onProgress(undefined);
    }
  }

  /** Returns the path of the layer below, if the print asks for one. */
  async #below(engine: Engine, { print }: Plate, signal: AbortSignal): Promise<{ below?: Toolpath }> {
    if (print.basePattern !== 'across' || print.base === 0 || this.#done === undefined) return {};
    const { input, params } = engineInput(this.#done.plate);
    return { below: (await engine.generateToolpath(input, params, { across: true, signal })).toolpath };
  }

  /** Settles the waiters once nothing is left to do for the wanted plate. */
  #tellFinished(): void {
    const done = this.#done;
    if (this.#wanted === undefined || this.#wanted.live || done === undefined) return;
    const { result, problem } = done;
    this.#tellWaiters((waiter) => {
      if (problem !== undefined) waiter.reject(new StudioError(problem.code, problem.values, problem.detail));
      else if (result !== undefined) waiter.resolve(result);
    });
  }

  #tellWaiters(tell: (waiter: Waiter) => void): void {
    const waiters = this.#waiters;
    this.#waiters = [];
    waiters.forEach(tell);
  }

  // --- Progress and problems ------------------------------------------------------------------------------------------------

  #tellProgress(job: Progress['job'], stage: string, fraction: number, secondsLeft: number | undefined): void {
    this.events.onProgress({ job, stage, fraction, secondsLeft });
  }

  #tellProblem(problem: Problem | undefined): void {
    if (problem === this.#problem) return;
    this.#problem = problem;
    this.events.onProblem(problem);
  }
}

/** Sets the colour of the plate's own spool; the engine knows only the measured spools. */
const inItsColour = (toolpath: Toolpath, plate: Plate): Toolpath =>
  toolpath.look === undefined || plate.spool === undefined
    ? toolpath
    : { ...toolpath, look: { ...toolpath.look, colour: viewLook(plate).colour } };

const aborted = (): DOMException => new DOMException('The job was cancelled', 'AbortError');
