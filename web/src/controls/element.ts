// What all elements of the page have in common: they draw the state, and draw again when what they read has changed.
import { LitElement } from 'lit';
import { property } from 'lit/decorators.js';
import { controls } from './controls.js';
import type { Shown } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';

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

  readonly #parts = new Map<() => Promise<unknown>, 'fetched' | 'there'>();

  /** Fetches a part of the page when it is first asked for, and draws again once it is there.
   * A fetch that failed is told, and repeated at the next drawing.
   * @param load  the same function for the same part each time
   * @returns true once the part's elements are known */
  protected lazy(load: () => Promise<unknown>): boolean {
    const state = this.#parts.get(load);
    if (state === undefined) {
      this.#parts.set(load, 'fetched');
      void this.studio.attempt(async () => {
        try {
          await load();
          this.#parts.set(load, 'there');
          this.requestUpdate();
        } catch (error) {
          this.#parts.delete(load);
          throw error;
        }
      });
    }
    return state === 'there';
  }

  /** After each change of the state, drawn or not. */
  protected onState(_state: Readonly<Shown>, _before: Readonly<Shown>): void {}
}
