// What all elements of the page have in common: they draw the state, and draw again when what they read has changed.
import { LitElement } from 'lit';
import { property } from 'lit/decorators.js';
import { controls } from '../style/controls.js';
import type { Shown } from './shown.js';
import type { Studio } from './studio.js';

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

  readonly #parts = new Map<() => Promise<unknown>, boolean>();

  /** Whether the elements of a part are known, which is fetched when it is first asked for; draws again once it is there.
   * @param load  always the same function for the same part */
  protected isHere(load: () => Promise<unknown>): boolean {
    const known = this.#parts.get(load);
    if (known !== undefined) return known;
    this.#parts.set(load, false);
    void this.studio.attempt(async () => {
      await load();
      this.#parts.set(load, true);
      this.requestUpdate();
    });
    return false;
  }

  /** After each change of the state, drawn or not. */
  protected onState(_state: Readonly<Shown>, _before: Readonly<Shown>): void {}
}
