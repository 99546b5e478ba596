// Moves the light over the plate by itself: it sways, circles, or turns from one picture's lamp to the next.
import { homeLight, lampsOf, shownPictures } from '../model/lamp.js';
import type { Light } from '../model/view.js';
import { Aim, between, lightUnder, near, swayed, swayPeriod, turned } from '../views/light.js';
import type { Shown } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';

const leap = 15; // [degrees] from its target; nearer, a turning lamp jumps onto it
const flipEach = 2600; // [ms] for each picture while the lamp turns
const crossing = 0.3; // share of that time in which the lamp moves; larger: two pictures overlap for longer
const swayFor = 90_000; // [ms] without any activity, after which the light rests
const longestStep = 50; // [ms] for one frame: the light does not leap after a pause

export class MovingLight {
  /** A pointer floats above the plate. */
  #hovered = false;
  readonly #aim = new Aim();
  #lastTouch = performance.now();
  #lastFrame = 0;
  #flipBegan = 0;
  readonly #calm = matchMedia('(prefers-reduced-motion: reduce)');

  constructor(
    private readonly studio: Studio,
    /** Tells whether drawing is slow, as without a graphics card:
     * the light then stands still unless it is asked to move. */
    private readonly isSlow: () => boolean,
  ) {}

  /** Notes activity of the user. @returns true if the light was at rest */
  touch(): boolean {
    const rested = this.#rests(performance.now());
    this.#lastTouch = performance.now();
    return rested;
  }

  /** Takes the pointer's place, ±1 at the edges and y up; undefined: it has left, or draws. */
  hover(place: readonly [number, number] | undefined): void {
    const now = performance.now();
    const { lightMode, view, tool, flipping, plate } = this.#state;
    const left = this.#hovered && place === undefined;
    const aimed = left ? this.#aim.leave(now) : undefined;
    this.#hovered = place !== undefined;
    if (lightMode !== 'pointer' || view !== 'appearance' || tool !== 'pan') return;
    if (place !== undefined && this.#leads()) {
      const light = lightUnder(...place);
      this.#aim.move(light, now);
      this.studio.store.set({ light });
    } else if (left && shownPictures(plate).length > 0 && !flipping) {
      this.studio.store.set({ aimed });
    }
  }

  /** Moves the light to its place at this time.
   * @returns time until its next move [ms]; 0: next frame; undefined: none */
  move(now: number): number | undefined {
    const { lightMode, view, light, aimed, tool, flipping, lampHeld } = this.#state;
    // It stands still under a brush, so that the effect of a stroke
    // can be seen, and under a pointer that wants to take the lamp.
    if (view !== 'appearance' || document.hidden || tool !== 'pan' || lampHeld) return undefined;
    const resting = this.#rests(now) || this.#calm.matches;
    const orbits = lightMode === 'orbit' && !this.#calm.matches;
    const free = lightMode === 'pointer' && !this.#leads();
    if (!orbits && !free) return undefined;
    const slow = this.isSlow();
    const sways = free && !resting && !slow && !this.studio.keepsStill() && aimed === undefined;
    const elapsed = now - (this.#lastFrame || now);
    this.#lastFrame = now;
    const wait = this.#steps() ? flipEach : 0;
    const step = Math.min(longestStep, Math.max(0, elapsed)); // a frame's time may lie before that of a drawing between two frames
    if (orbits) {
      const azimuth = (light.azimuth + (360 * step) / swayPeriod) % 360;
      this.studio.store.set({ light: { azimuth, elevation: light.elevation } });
      return wait;
    }
    // The light returns to where the plate looks as intended, and sways a little around it.
    const home = aimed ?? this.#home(now);
    const aim = sways && !flipping ? swayed(home, now) : home;
    const jumps = this.#calm.matches || slow || (flipping && near(light, aim, leap));
    const way = jumps ? aim : turned(light, aim, step);
    const arrives = near(way, aim, 0.05);
    const next = arrives ? aim : way;
    // Steps may be small on a fast screen: if they were skipped, the light would never arrive.
    if (!near(next, light, 1e-6)) this.studio.store.set({ light: next });
    return sways || (flipping && !resting) || !arrives ? wait : undefined;
  }

  /** Tells whether the light follows the pointer: over the plate, unless the lamp was asked to turn. */
  #leads(): boolean {
    const { flipping, welcome } = this.#state;
    return this.#hovered && (!flipping || welcome);
  }

  get #state(): Readonly<Shown> {
    return this.studio.store.state;
  }

  #rests = (now: number): boolean => now - this.#lastTouch > swayFor;

  /** Tells whether the lamp jumps from picture to picture, without a move in between. */
  #steps = (): boolean => this.#state.flipping && this.isSlow();

  /** Returns the lamp of the shown picture; while the lamp turns, a place between two lamps. */
  #home(now: number): Light {
    const { plate, result, lamp, flipping } = this.#state;
    const look = result?.toolpath.look;
    const lamps = lampsOf(plate, look);
    if (!flipping || lamps.length < 2) {
      this.#flipBegan = 0;
      return lamps[lamp] ?? homeLight(plate, look);
    }
    if (this.#flipBegan === 0) this.#flipBegan = now - lamp * flipEach;
    const turn = (now - this.#flipBegan) / flipEach;
    const from = Math.floor(turn) % lamps.length;
    const to = (from + 1) % lamps.length;
    if (this.#state.lamp !== from) this.studio.store.set({ lamp: from });
    const moved = ((turn % 1) - (1 - crossing) / 2) / crossing;
    const share = this.#steps() ? 0 : Math.min(1, Math.max(0, moved));
    return between(lamps[from] as Light, lamps[to] as Light, (1 - Math.cos(Math.PI * share)) / 2);
  }
}
