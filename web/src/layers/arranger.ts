// Moves, scales, turns and crops the chosen layer by hand; a click chooses another.
import type { Place } from '../controls/gestures.js';
import { l } from '../i18n/layers.js';
import { formatNumber } from '../i18n/text.js';
import { croppedTo, keepsProportions, rounded, scaledLayer, slid } from '../model/layer-changes.js';
import { boundsOf, onPage, placeIn, resized, rotated, type Frame, type Point } from '../model/layer-frame.js';
import { changeLayer, layerOf, withoutLayer } from '../model/layer-list.js';
import { type LayerValues } from '../model/layers.js';
import { pageOf, type PlateLayer } from '../model/plate.js';
import { cornerSnapped, snapped, type Guide } from '../model/snap.js';
import type { Shown } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';
import { arranges, chosenLayer, frameIn, isMovable, layerAt } from './arranging.js';
import { cursorOf, gripAt, handlesOf, type Grip, type PageView } from './grips.js';
import { warnedLayers } from '../model/warned.js';

const reachOf = { touch: 24, other: 10 }; // [CSS pixels] within which a grip is taken; fingers need more
const snapsWithin = 6; // [CSS pixels]; larger: snaps more often, but free places near a line are harder to reach
const steps = { plain: 1, shift: 10, alt: 0.1 }; // [mm] for each press of an arrow key

/** A grip that a hand holds, with the layer and its frame as they were when it took hold. */
interface Hold {
  grip: Grip;
  from: Point;
  layer: PlateLayer;
  frame: Frame;
}

/** Everything that is drawn over the plate. */
export interface Arranged {
  layer: PlateLayer | undefined;
  frame: Frame | undefined;
  cropping: boolean;
  /** Frame of the layer under the pointer, which a click would choose. */
  over: Frame | undefined;
  /** True where the chosen layer has a warning. */
  bad: boolean;
  /** Frames of other layers that have warnings. */
  warned: readonly Frame[];
  guides: readonly Guide[];
  /** Text beside the frame while it changes. */
  label: string;
}

/** Turns pointer and key events into changes of the chosen layer. */
export class Arranger {
  #hold: Hold | undefined;
  #guides: readonly Guide[] = [];
  #over: number | undefined;
  #nudging = false;

  constructor(
    private readonly studio: Studio,
    private readonly view: () => PageView,
  ) {}

  get #state(): Readonly<Shown> {
    return this.studio.store.state;
  }

  /** True while a hand holds the layer. */
  get holds(): boolean {
    return this.#hold !== undefined;
  }

  #movable(): { layer: PlateLayer; frame: Frame } | undefined {
    const state = this.#state;
    const layer = arranges(state) ? chosenLayer(state) : undefined;
    return layer === undefined || !isMovable(state.plate, layer) ? undefined : { layer, frame: frameIn(state, layer) };
  }

  #gripAt(place: Place, touch: boolean): Grip | undefined {
    const found = this.#movable();
    if (found === undefined) return undefined;
    const reach = touch ? reachOf.touch : reachOf.other;
    return gripAt(found.frame, this.view(), place, reach, handlesOf(found.layer, this.#state.cropping));
  }

  // --- The pointer ----------------------------------------------------------------------------------------------------------

  /** Begins a drag of the layer. @returns false where a pointer that goes down there moves the view instead */
  takes(place: Place, event: PointerEvent): boolean {
    if (event.button !== 0 || event.altKey) return false;
    const grip = this.#gripAt(place, event.pointerType === 'touch');
    const found = this.#movable();
    if (grip === undefined || found === undefined) return false;
    this.#hold = { grip, from: this.view().toPage(place), ...found };
    return true;
  }

  move(place: Place, event: PointerEvent): void {
    const hold = this.#hold;
    if (hold === undefined) return;
    const changes = this.#changes(hold, this.view().toPage(place), event);
    const { plate } = this.#state;
    if (layerOf(plate, hold.layer.id) === undefined) {
      this.release(); // the layer was undone meanwhile
      return;
    }
    this.studio.change((now) => changeLayer(now, hold.layer.id, () => changes), 'layer');
  }

  #changes({ grip, from, layer, frame }: Hold, to: Point, event: PointerEvent): Partial<LayerValues> {
    const { cropping } = this.#state;
    this.#guides = [];
    switch (grip.kind) {
      case 'turn':
        return { rotation: rotated(frame, from, to, event.shiftKey) };
      case 'angle':
        return { angle: rotated({ ...frame, turn: layer.angle }, from, to, event.shiftKey) };
      case 'side': {
        const held = onPage(frame, placeIn(frame, grip.side));
        const there: Point = [held[0] + to[0] - from[0], held[1] + to[1] - from[1]];
        if (cropping) return croppedTo(frame, layer, grip.side, there);
        const free = event.shiftKey && !keepsProportions(layer);
        const corner = this.#snaps(event) ? this.#cornerSnapped(frame, grip.side, there, free) : there;
        const { scale, middle } = resized(frame, grip.side, corner, free);
        return { ...scaledLayer(layer, frame, scale), at: rounded(middle) };
      }
      case 'box': {
        if (cropping) return slid(frame, layer, from, to);
        const { middle } = frame;
        const moved: Point = [middle[0] + to[0] - from[0], middle[1] + to[1] - from[1]];
        const by: Point = this.#snaps(event) ? this.#snap({ ...frame, middle: moved }, layer) : [0, 0];
        return { at: rounded([moved[0] + by[0], moved[1] + by[1]]) };
      }
    }
  }

  #snaps = ({ ctrlKey, metaKey }: PointerEvent): boolean => !ctrlKey && !metaKey;

  get #reach(): number {
    return snapsWithin / this.view().scale;
  }

  #cornerSnapped(frame: Frame, side: Point, to: Point, free: boolean): Point {
    const { scale, middle } = resized(frame, side, to, free);
    const size: Point = [frame.size[0] * scale[0], frame.size[1] * scale[1]];
    const now = { ...frame, middle, size };
    const fixed = free ? undefined : onPage(now, placeIn(now, [-side[0], -side[1]]));
    const corner = onPage(now, placeIn(now, side));
    const snap = cornerSnapped(corner, pageOf(this.#state.plate), fixed, this.#reach);
    this.#guides = snap.guides;
    return snap.corner;
  }

  #snap(frame: Frame, layer: PlateLayer): Point {
    const state = this.#state;
    const middles = state.plate.layers
      .filter((other) => other.visible && other.id !== layer.id && isMovable(state.plate, other))
      .map((other) => frameIn(state, other).middle);
    const { by, guides } = snapped(boundsOf(frame), pageOf(state.plate), middles, this.#reach);
    this.#guides = guides;
    return by;
  }

  /** Ends a drag, which becomes one undo step. */
  release(): void {
    this.#hold = undefined;
    this.#guides = [];
    this.studio.settle();
  }

  /** Ends a drag and takes it back. */
  abandon(): void {
    if (this.#hold === undefined) return;
    this.studio.store.abandon();
    this.release();
  }

  /** Handles a pointer that hovers; undefined: it has left. @returns the cursor's name; empty: the usual one */
  hover(place: Place | undefined): string {
    const state = this.#state;
    this.#over = undefined;
    if (place === undefined || !arranges(state)) return '';
    if (this.#hold !== undefined) {
      const { grip, frame } = this.#hold;
      return grip.kind === 'turn' || grip.kind === 'angle' ? 'grabbing' : cursorOf(grip, frame);
    }
    const grip = this.#gripAt(place, false);
    const found = this.#movable();
    if (grip !== undefined && found !== undefined) return cursorOf(grip, found.frame);
    const under = state.cropping ? undefined : layerAt(state, this.view().toPage(place), 0);
    if (under === undefined || under.id === state.layer) return '';
    this.#over = under.id;
    return 'pointer';
  }

  /** Handles a click that was no drag. */
  click(place: Place): void {
    const state = this.#state;
    if (!arranges(state)) return;
    if (state.cropping) {
      if (this.#gripAt(place, true) === undefined) this.studio.store.set({ cropping: false });
      return;
    }
    const { toPage, scale } = this.view();
    const grip = this.#gripAt(place, false);
    if (grip !== undefined && grip.kind !== 'box') return;
    const under = layerAt(state, toPage(place), reachOf.other / scale / 2);
    if (under?.id !== state.layer) this.studio.store.set({ layer: under?.id });
  }

  /** Starts or ends cropping of a picture. */
  doubleClick(place: Place): void {
    const layer = chosenLayer(this.#state);
    if (layer?.kind !== 'picture' || this.#gripAt(place, false)?.kind !== 'box') return;
    this.studio.store.set({ cropping: !this.#state.cropping });
  }

  // --- Keys -----------------------------------------------------------------------------------------------------------------

  /** Handles a key. @returns false where the key has no meaning here */
  key(event: KeyboardEvent): boolean {
    const state = this.#state;
    const layer = arranges(state) ? chosenLayer(state) : undefined;
    if (layer === undefined || event.ctrlKey || event.metaKey) return false;
    const step = event.altKey ? steps.alt : event.shiftKey ? steps.shift : steps.plain;
    const ways: Record<string, Point> = {
      ArrowLeft: [-step, 0],
      ArrowRight: [step, 0],
      ArrowUp: [0, step],
      ArrowDown: [0, -step],
    };
    const way = ways[event.key];
    if (way !== undefined) this.#nudge(way);
    else if (event.altKey) return false;
    else if (event.key === 'Escape' && this.#hold !== undefined) this.abandon();
    else if ((event.key === 'Escape' || event.key === 'Enter') && state.cropping) {
      this.studio.store.set({ cropping: false });
    } else if (event.key === 'Escape') this.studio.store.set({ layer: undefined });
    else if (event.key === 'Delete' || event.key === 'Backspace') {
      this.studio.settle();
      this.studio.change((plate) => withoutLayer(plate, layer.id));
    } else return false;
    return true;
  }

  #nudge([dx, dy]: Point): void {
    const found = this.#movable();
    if (found === undefined) return;
    const { layer, frame } = found;
    const at = rounded([frame.middle[0] + dx, frame.middle[1] + dy]);
    this.#nudging = true;
    this.studio.change((plate) => changeLayer(plate, layer.id, () => ({ at })), 'layer.key');
  }

  /** Ends a nudge when its key is released, or the focus is lost. */
  keyUp(): void {
    if (!this.#nudging) return;
    this.#nudging = false;
    this.studio.settle();
  }

  // --- To be drawn ------------------------------------------------------------------------------------------------------------

  /** Everything to draw. @returns undefined where nothing is drawn */
  shown(): Arranged | undefined {
    const state = this.#state;
    if (!arranges(state)) return undefined;
    const chosen = chosenLayer(state);
    const framed = chosen !== undefined && (isMovable(state.plate, chosen) || chosen.kind === 'border');
    const layer = framed ? chosen : undefined;
    const warned = warnedLayers(state);
    const others = state.plate.layers.filter(
      (one) => one !== layer && one.visible && warned.has(one) && isMovable(state.plate, one),
    );
    const over = this.#over === undefined ? undefined : layerOf(state.plate, this.#over);
    return {
      layer,
      frame: layer && frameIn(state, layer),
      cropping: state.cropping && layer?.kind === 'picture',
      over: over && frameIn(state, over),
      bad: layer !== undefined && warned.has(layer),
      warned: others.map((one) => frameIn(state, one)),
      guides: this.#guides,
      label: layer === undefined ? '' : this.#label(frameIn(state, layer), layer),
    };
  }

  #label({ middle, size }: Frame, { rotation, angle }: PlateLayer): string {
    const [x, y] = middle.map((length) => formatNumber(length, 1));
    const [width, height] = size.map((length) => formatNumber(length, 1));
    if (this.#nudging) return l('at', { x: x ?? '', y: y ?? '' });
    switch (this.#hold?.grip.kind) {
      case 'turn':
        return `${formatNumber(rotation, 1)}°`;
      case 'angle':
        return `${formatNumber(angle, 1)}°`;
      case 'side':
        return l('sized', { width: width ?? '', height: height ?? '' });
      case 'box':
        return this.#state.cropping ? '' : l('at', { x: x ?? '', y: y ?? '' });
      default:
        return '';
    }
  }
}
