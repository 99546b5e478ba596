// Draws the plate's directions with the engine: they stand in for
// beads, and are a view of their own. Only the newest plate counts.
import type { Engine, Shape } from 'sillon';
import { engineInput, shapeInput } from '../model/input.js';
import { usualLight, lampsOf } from '../model/lamp.js';
import { pictureLayers } from '../model/layers.js';
import { pageOf, type Plate, type PlateLayer } from '../model/plate.js';
import { coarseResolution, fineResolution, type DirectionRaster } from '../model/raster.js';
import { sameSolved } from '../model/result.js';
import type { Light } from '../model/view.js';
import type { Store } from '../model/store.js';
import type { Shown } from '../studio/shown.js';

/** Texels that the engine draws per spacing of beads. */
const texelsPerBead = 4;

/** Draws the directions of a plate.
 * @param resolution  most texels along the longer side
 * @throws errors of the engine */
export function drawDirections(plate: Plate, engine: Engine, resolution: number): Promise<DirectionRaster> {
  const { input, params } = engineInput(plate);
  const least = (texelsPerBead * Math.max(...pageOf(plate))) / resolution;
  return engine.drawLayers(input, { ...params, spacing: Math.max(params.spacing, least) });
}

/** Returns a function that reads shapes, each once. */
function shapeReader(engine: () => Promise<Engine>): (plate: Plate) => Promise<Shape> {
  let last: { of: Pick<Plate, 'shape' | 'width' | 'height'>; read: Promise<Shape> } | undefined;
  return (plate) => {
    const { shape, width, height } = plate;
    if (last?.of.shape === shape && last.of.width === width && last.of.height === height) return last.read;
    const read = engine().then((running) => running.readShape(shapeInput(plate, ({ bytes }) => bytes)));
    last = { of: plate, read };
    read.catch(() => (last = undefined)); // the engine may not have been loaded
    return read;
  };
}

/** Returns the lamp for pictures that name none: the one that the engine chose for the last plate, or the usual one. */
const lampFor = ({ plate, result }: Readonly<Shown>): Light => lampsOf(plate, result?.toolpath.look)[0] ?? usualLight;

/** Gives a lamp to each single picture that names none: to choose one itself, the engine would have to make plates. */
function withLamp(plate: Plate, { azimuth, elevation }: Light): Plate {
  const lit = (layer: PlateLayer): PlateLayer => {
    const [one, ...others] = layer.pictures;
    if (one === undefined || one.lamp !== null || others.length > 0) return layer;
    return { ...layer, pictures: [{ ...one, lamp: [azimuth, elevation] }] };
  };
  return pictureLayers(plate).length === 0 ? plate : { ...plate, layers: plate.layers.map(lit) };
}

interface Drawn {
  plate: Plate;
  lamp: Light;
  coarse: boolean;
}

/** Tells whether the drawn directions are those of a plate, and fine enough. */
const covers = (drawn: Drawn | undefined, { plate, lamp, coarse }: Drawn): boolean =>
  drawn !== undefined &&
  sameSolved(drawn.plate, plate) &&
  (coarse || !drawn.coarse) &&
  (pictureLayers(plate).length === 0 || JSON.stringify(drawn.lamp) === JSON.stringify(lamp));

/** Keeps `directions` of the state up to date: coarse ones at once, fine ones if
 * the view shows them and no drag goes on. A first visit sees its plate before
 * there is an engine, and needs no directions before the plate has beads. */
export function followDirections(store: Store<Shown>, engine: () => Promise<Engine>): void {
  const readShape = shapeReader(engine);
  let drawn: Drawn | undefined;
  let drawing = false;

  const draw = async (): Promise<void> => {
    const { state } = store;
    const { plate, view, live, welcome, result } = state;
    const lamp = lampFor(state);
    const coarse = live || view !== 'directions' || !covers(drawn, { plate, lamp, coarse: true });
    if (drawing || covers(drawn, { plate, lamp, coarse }) || (welcome && result === undefined && view !== 'directions'))
      return;
    drawing = true;
    drawn = { plate, lamp, coarse };
    try {
      const resolution = coarse ? coarseResolution : fineResolution;
      const raster = engine().then((running) => drawDirections(withLamp(plate, lamp), running, resolution));
      const [shape, drawnRaster] = await Promise.all([readShape(plate), raster]);
      store.set({ directions: { plate, shape, raster: drawnRaster } });
    } catch {
      // A faulty layer is reported when the plate is made. The next change tries again.
      drawn = undefined;
      if (store.state.plate === plate) return;
    } finally {
      drawing = false;
    }
    void draw();
  };

  store.subscribe((state, before) => {
    const asks = (['plate', 'view', 'live', 'welcome', 'result'] as const).some((key) => state[key] !== before[key]);
    if (asks) void draw();
  });
}
