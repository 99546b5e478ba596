// Directions of the plate as the engine draws them, for the view that shows them. Only the newest plate counts.
import type { Engine } from 'sillon';
import { engineInput } from '../model/input.js';
import { pictureLayers } from '../model/layers.js';
import { pageOf, type Plate } from '../model/plate.js';
import { coarseResolution, fineResolution, type DirectionRaster } from '../model/raster.js';
import { sameDirections } from '../model/result.js';
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

interface Drawn {
  plate: Plate;
  coarse: boolean;
}

const covers = (drawn: Drawn | undefined, plate: Plate, coarse: boolean): boolean =>
  drawn !== undefined && sameDirections(drawn.plate, plate) && (coarse || !drawn.coarse);

/** Keeps `directions` of the state while the view shows them. Pictures have none before they are solved for: beads tell theirs. */
export function followDirections(store: Store<Shown>, engine: () => Promise<Engine>): void {
  let drawn: Drawn | undefined;
  let drawing = false;

  const draw = async (): Promise<void> => {
    const { plate, view, live } = store.state;
    if (drawing || view !== 'directions' || covers(drawn, plate, live)) return;
    if (pictureLayers(plate).length > 0) {
      store.set({ directions: undefined });
      drawn = undefined;
      return;
    }
    drawing = true;
    drawn = { plate, coarse: live };
    try {
      const resolution = live ? coarseResolution : fineResolution;
      store.set({ directions: await drawDirections(plate, await engine(), resolution) });
    } catch {
      // Whatever is wrong with a layer is told where the plate is made. The next look at the view asks again.
      drawn = undefined;
      if (store.state.plate === plate) return;
    } finally {
      drawing = false;
    }
    void draw();
  };

  store.subscribe((state, before) => {
    if (state.plate !== before.plate || state.view !== before.view || state.live !== before.live) void draw();
  });
}
