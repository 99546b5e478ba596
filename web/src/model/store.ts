// Holds all state that the page shows, and tells listeners of changes once per turn. Each change of the plate keeps the
// plate before it; plates share what did not change, so a step costs little.
import type { Plate } from './plate.js';

const mostSteps = 200;

/** A plate and the steps of undo and redo, the nearest last. */
export interface Steps {
  past: readonly Plate[];
  plate: Plate;
  future: readonly Plate[];
}

export interface HasPlate {
  plate: Plate;
}

export type Listener<State> = (state: Readonly<State>, before: Readonly<State>) => void;

/** The state, its listeners and the steps of undo and redo. */
export class Store<State extends HasPlate> {
  #state: Readonly<State>;
  #told: Readonly<State>;
  #telling = false;
  readonly #listeners = new Set<Listener<State>>();
  #past: Plate[] = [];
  #future: Plate[] = [];
  #gesture: string | undefined;
  /** Steps from before the current gesture. */
  #before: Steps | undefined;

  constructor(state: State) {
    this.#state = state;
    this.#told = state;
  }

  get state(): Readonly<State> {
    return this.#state;
  }

  get canUndo(): boolean {
    return this.#past.length > 0;
  }

  get canRedo(): boolean {
    return this.#future.length > 0;
  }

  /** Changes any part of the state except the plate. Such changes cannot be undone. */
  set(patch: Partial<Omit<State, 'plate'>>): void {
    this.#become({ ...this.#state, ...patch });
  }

  /** Changes the plate as one undo step. Consecutive changes with the same `gesture`, such as those of a drag, stay
   * one step until `settle`. */
  change(change: (plate: Plate) => Plate, gesture?: string): void {
    const { plate } = this.#state;
    const next = change(plate);
    if (next === plate) return;
    const goesOn = gesture !== undefined && gesture === this.#gesture;
    if (!goesOn) {
      this.#before = { past: this.#past, plate, future: this.#future };
      this.#past = [...this.#past, plate].slice(-mostSteps);
    }
    this.#gesture = gesture;
    this.#future = [];
    this.#become({ ...this.#state, plate: next });
  }

  /** Ends a gesture, so that the next change is another step. */
  settle(): void {
    this.#gesture = undefined;
  }

  /** Takes back the current gesture as if it had never begun; what could be redone still can. */
  abandon(): void {
    if (this.#gesture !== undefined && this.#before !== undefined) this.restore(this.#before);
  }

  get steps(): Steps {
    return { past: [...this.#past], plate: this.#state.plate, future: [...this.#future] };
  }

  /** Shows another plate with its own steps, and drops those of the plate before. */
  restore({ past, plate, future }: Steps): void {
    this.settle();
    this.#past = [...past];
    this.#future = [...future];
    this.#become({ ...this.#state, plate });
  }

  /** Forgets all steps, so that nothing before the current plate can be restored. */
  forgetSteps(): void {
    this.settle();
    this.#past = [];
    this.#future = [];
  }

  undo(): void {
    this.#step(this.#past, this.#future);
  }

  redo(): void {
    this.#step(this.#future, this.#past);
  }

  /** Calls the listener once per turn in which anything changed. @returns a function that ends the subscription */
  subscribe(listener: Listener<State>): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  #step(from: Plate[], to: Plate[]): void {
    this.settle();
    const plate = from.pop();
    if (plate === undefined) return;
    to.push(this.#state.plate);
    this.#become({ ...this.#state, plate });
  }

  #become(state: Readonly<State>): void {
    this.#state = state;
    if (this.#telling) return;
    this.#telling = true;
    queueMicrotask(() => this.#tell());
  }

  #tell(): void {
    this.#telling = false;
    const before = this.#told;
    const state = this.#state;
    this.#told = state;
    for (const listener of [...this.#listeners]) {
      try {
        listener(state, before);
      } catch (error) {
        reportError(error); // a broken listener must not keep the others from drawing
      }
    }
  }
}
