// What all elements of the page have in common: they draw the state, and draw again when what they read has changed.
import { LitElement } from 'lit';
import { property } from 'lit/decorators.js';
import { problemOf } from '../model/problem.js';
import { controls } from './controls.js';
import type { Shown } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';

const longestRest = 16; // [s] between two tries

/** Ends when another try may go better: after a while, or when the network is back. */
const rest = (seconds: number): Promise<unknown> =>
  new Promise((resolve) => {
    setTimeout(resolve, 1000 * seconds);
    addEventListener('online', resolve, { once: true });
  });

/** A part of the page. */
interface Part {
  /** It is there, on its way, or not to be asked for again yet. */
  asked?: boolean;
  came?: unknown;
  failures: number;
  /** The notice of its failure. */
  notice?: number;
}

export abstract class StudioElement extends LitElement {
  static override styles = [controls];

  /** Parts of the state that `render` reads. */
  static reads: readonly (keyof Shown)[] = [];

  @property({ attribute: false }) studio!: Studio;

  #end: (() => void) | undefined;

  get state(): Readonly<Shown> {
    return this.studio.store.state;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    const { reads } = this.constructor as typeof StudioElement;
    this.#end = this.studio.store.subscribe((state, before) => {
      if (state.language !== before.language || reads.some((key) => state[key] !== before[key])) this.requestUpdate();
      this.onState(state, before);
    });
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#end?.();
  }

  readonly #parts = new Map<() => Promise<unknown>, Part>();

  /** Fetches a part of the page when it is first asked for, and draws again once it is there. A fetch that failed is told
   * until another went well: for as long as drawings ask for the part, after 1, 2, 4 ... 16 s, or when the network is back.
   * @param load  the same function for the same part each time
   * @param quiet  a failure is not told: there is something in its place
   * @returns what came; undefined: nothing yet */
  protected lazy = <T>(load: () => Promise<T>, quiet = false): T | undefined => {
    let part = this.#parts.get(load);
    if (part === undefined) this.#parts.set(load, (part = { failures: 0 }));
    if (!part.asked) void this.#fetch(load, part, quiet);
    return part.came as T | undefined;
  };

  async #fetch(load: () => Promise<unknown>, part: Part, quiet: boolean): Promise<void> {
    part.asked = true;
    try {
      part.came = await load();
      if (part.notice !== undefined) this.studio.dismiss(part.notice);
    } catch (error) {
      if (part.failures === 0 && !quiet) part.notice = this.studio.fail(problemOf(error));
      await rest(Math.min(2 ** part.failures++, longestRest));
      part.asked = false;
    }
    if (this.isConnected) this.requestUpdate();
  }

  /** After each change of the state, drawn or not. */
  protected onState(_state: Readonly<Shown>, _before: Readonly<Shown>): void {}
}
