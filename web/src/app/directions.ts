// The plate's directions as the engine draws them: what stands in for beads, and the view of directions. Only the newest plate counts.
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

/** The engine draws so many texels per spacing of beads. */
const texelsPerBead = 4;

/** @param resolution  texels of the longer side, at most
 * @throws what the engine refuses */
export function drawDirections(plate: Plate, engine: Engine, resolution: number): Promise<DirectionRaster> {
  const { input, params } = engineInput(plate);
  const least = (texelsPerBead * Math.max(...pageOf(plate))) / resolution;
  return engine.drawLayers(input, { ...params, spacing: Math.max(params.spacing, least) });
}

/** Reads shapes, each once. */
function shapeReader(engine: () => Promise<Engine>): (plate: Plate) => Promise<Shape> {
  let last: { of: Pick<Plate, 'shape' | 'width' | 'height'>; read: Promise<Shape> } | undefined;
  return (plate) => {
    const { shape, width, height } = plate;
    if (last?.of.shape === shape && last.of.width === width && last.of.height === height) return last.read;
    const read = engine().then((running) => running.readShape(shapeInput(plate, ({ bytes }) => bytes)));
    last = { of: plate, read };
    read.catch(() => (last = undefined)); // the engine may not have been there
    return read;
  };
}

/** For pictures that name none: the lamp that the engine has chosen for the last plate, or the usual one. */
const lampFor = ({ plate, result }: Readonly<Shown>): Light => lampsOf(plate, result?.toolpath.look)[0] ?? usualLight;

/** With a lamp for each single picture that names none: to choose one, the engine makes plates. */
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

const covers = (drawn: Drawn | undefined, { plate, lamp, coarse }: Drawn): boolean =>
  drawn !== undefined &&
  sameSolved(drawn.plate, plate) &&
  (coarse || !drawn.coarse) &&
  (pictureLayers(plate).length === 0 || JSON.stringify(drawn.lamp) === JSON.stringify(lamp));

/** Keeps `directions` of the state: coarse ones at once, fine ones where the view shows them and no hand moves. A first visit sees
 * its plate before there is an engine, and needs none of this before the plate has beads. */
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
      // Whatever is wrong with a layer is told where the plate is made. The next change asks again.
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
