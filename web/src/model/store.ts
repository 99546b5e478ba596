// One object holds all that the page shows, and who draws hears of its changes once per turn. Of every change to the plate
// the plate before it is kept: plates share what did not change, so a step costs little.
import type { Plate } from './plate.js';

const mostSteps = 200;

/** A plate and what undo and redo go to, the nearest last. */
export interface Steps {
  past: readonly Plate[];
  plate: Plate;
  future: readonly Plate[];
}

export interface HasPlate {
  plate: Plate;
}

export type Listener<State> = (state: Readonly<State>, before: Readonly<State>) => void;

export class Store<State extends HasPlate> {
  #state: Readonly<State>;
  #told: Readonly<State>;
  #telling = false;
  readonly #listeners = new Set<Listener<State>>();
  #past: Plate[] = [];
  #future: Plate[] = [];
  #gesture: string | undefined;
  /** Before the gesture. */
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

  /** Everything but the plate; cannot be undone. */
  set(patch: Partial<Omit<State, 'plate'>>): void {
    this.#become({ ...this.#state, ...patch });
  }

  /** Changes the plate, as one step of undo. Changes with the same `gesture` that follow each other are one step, until
   * `settle`: a drag that is still going on. */
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

  /** Ends a gesture: what comes next is another step. */
  settle(): void {
    this.#gesture = undefined;
  }

  /** Takes back the gesture that goes on, as if it had never begun: what could be redone still can. */
  abandon(): void {
    if (this.#gesture !== undefined && this.#before !== undefined) this.restore(this.#before);
  }

  get steps(): Steps {
    return { past: [...this.#past], plate: this.#state.plate, future: [...this.#future] };
  }

  /** Another plate with the steps that led to it; those of the plate before are forgotten. */
  restore({ past, plate, future }: Steps): void {
    this.settle();
    this.#past = [...past];
    this.#future = [...future];
    this.#become({ ...this.#state, plate });
  }

  /** What was before the plate cannot be had back. */
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

  /** The listener is called once per turn in which anything changed. @returns what ends that. */
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
    queueMicrotask(() => {
      this.#tell();
    });
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
