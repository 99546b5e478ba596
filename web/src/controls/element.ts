// Base class of all elements of the page: they draw the state, and draw again when a part that they read has changed.
import { LitElement, type CSSResultGroup, type CSSResultOrNative } from 'lit';
import { property } from 'lit/decorators.js';
import { problemOf } from '../model/problem.js';
import { controls } from './controls.js';
import type { Shown } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';

const longestRest = 16; // [s] longest pause between two attempts

/** Resolves when another attempt may succeed: after a while, or when the network is back. */
const rest = (seconds: number): Promise<unknown> =>
  new Promise((resolve) => {
    setTimeout(resolve, 1000 * seconds);
    addEventListener('online', resolve, { once: true });
  });

/** State of a part of the page that is loaded on demand. */
interface Part {
  /** The part is loaded, on its way, or must not be requested again yet. */
  asked?: boolean;
  came?: unknown;
  failures: number;
  /** Id of the notice about its failure. */
  notice?: number;
}

export abstract class StudioElement extends LitElement {
  /** Puts the styles that all elements share before an element's own. */
  protected static override finalizeStyles(own: CSSResultGroup = []): CSSResultOrNative[] {
    return super.finalizeStyles([controls, own]);
  }

  /** Parts of the state that `render` reads. */
  static reads: readonly (keyof Shown)[] = [];

  @property({ attribute: false }) studio!: Studio;

  #end: (() => void) | undefined;
  #away = new AbortController();

  get state(): Readonly<Shown> {
    return this.studio.store.state;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    const { reads } = this.constructor as typeof StudioElement;
    this.#away = new AbortController();
    this.#end = this.studio.store.subscribe((state, before) => {
      if (state.language !== before.language || reads.some((key) => state[key] !== before[key])) this.requestUpdate();
      this.onState(state, before);
    });
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#end?.();
    this.#away.abort();
  }

  /** Listens to an event of the window as long as the element is in the page. @param capture  before the page below */
  protected listen<Type extends keyof WindowEventMap>(
    type: Type,
    run: (event: WindowEventMap[Type]) => void,
    capture = false,
  ): void {
    addEventListener(type, run, { signal: this.#away.signal, capture });
  }

  readonly #parts = new Map<() => Promise<unknown>, Part>();

  /** Loads a part of the page on first use, and draws again once it is there. A failure is shown until another
   * attempt succeeds; as long as drawings ask for the part, attempts follow after 1, 2, 4 ... 16 s, or when the
   * network is back.
   * @param load  the same function each time for the same part
   * @param quiet  no notice of a failure: something stands in for the part
   * @returns the loaded part; undefined: not there yet */
  protected lazy = <T>(load: () => Promise<T>, quiet = false): T | undefined => {
    let part = this.#parts.get(load);
    if (part === undefined) this.#parts.set(load, (part = { failures: 0 }));
    if (!part.asked) void this.#fetch(load, part, quiet);
    return part.came as T | undefined;
  };

  /** Loads a part, reports a failure, and waits before another attempt is allowed. */
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

  /** Called after each change of the state, drawn or not. */
  protected onState(_state: Readonly<Shown>, _before: Readonly<Shown>): void {}
}
