// How the light over the plate moves by itself: it sways, circles, or turns from one picture's lamp to the next.
import { homeLight, lampsOf, shownPictures } from '../model/lamp.js';
import type { Light } from '../model/view.js';
import { Aim, between, lightUnder, near, swayed, swayPeriod, turned } from '../views/light.js';
import type { Shown } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';

const leap = 15; // [degrees] farther than that, the light springs to where it turns
const flipEach = 2600; // [ms] for each picture while the lamp turns
const crossing = 0.3; // share of that in which it moves: slower, two pictures are seen over each other for long
const swayFor = 90_000; // [ms] without anybody touching anything, after which the light rests
const longestStep = 50; // [ms] of a frame: after a pause the light does not leap

export class MovingLight {
  /** Whether a pointer floats above the plate. */
  #hovered = false;
  readonly #aim = new Aim();
  #lastTouch = performance.now();
  #lastFrame = 0;
  #flipBegan = 0;
  readonly #calm = matchMedia('(prefers-reduced-motion: reduce)');

  constructor(
    private readonly studio: Studio,
    /** It is hard to draw, as without a graphics card: then the light keeps still unless it is asked to move. */
    private readonly isSlow: () => boolean,
  ) {}

  /** Somebody is there. @returns whether the light had come to rest */
  touch(): boolean {
    const rested = this.#rests(performance.now());
    this.#lastTouch = performance.now();
    return rested;
  }

  /** A pointer floats there, ±1 at the edges and y up; undefined: it has gone, or draws. */
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

  /** Moves the light to where it is now. @returns [ms] until it moves again: 0 with the next frame, undefined not by itself */
  move(now: number): number | undefined {
    const { lightMode, view, light, aimed, tool, flipping, lampHeld } = this.#state;
    // It keeps still under a brush, else nobody could tell what a stroke changes, and under a hand, which could not take it.
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
    const step = Math.min(longestStep, Math.max(0, elapsed)); // a frame's time may lie before that of a drawing between frames
    if (orbits) {
      const azimuth = (light.azimuth + (360 * step) / swayPeriod) % 360;
      this.studio.store.set({ light: { azimuth, elevation: light.elevation } });
      return wait;
    }
    // Back to where the plate looks as it is meant to, and a little around it.
    const home = aimed ?? this.#home(now);
    const aim = sways && !flipping ? swayed(home, now) : home;
    const jumps = this.#calm.matches || slow || (flipping && near(light, aim, leap));
    const way = jumps ? aim : turned(light, aim, step);
    const arrives = near(way, aim, 0.05);
    const next = arrives ? aim : way;
    // The last steps of a fast screen are small: left out, the light would never arrive.
    if (!near(next, light, 1e-6)) this.studio.store.set({ light: next });
    return sways || (flipping && !resting) || !arrives ? wait : undefined;
  }

  /** Whether the light is where the pointer is: over the plate, unless somebody has asked for the lamp to turn. */
  #leads(): boolean {
    const { flipping, welcome } = this.#state;
    return this.#hovered && (!flipping || welcome);
  }

  get #state(): Readonly<Shown> {
    return this.studio.store.state;
  }

  #rests = (now: number): boolean => now - this.#lastTouch > swayFor;

  /** Whether the lamp turns from picture to picture without a way between. */
  #steps = (): boolean => this.#state.flipping && this.isSlow();

  /** Of the picture that is shown; while the lamp turns, between two. */
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
