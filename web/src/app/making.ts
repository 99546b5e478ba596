// Assembles the modules that compute a plate's results: the engine, the directions, and the pipeline.
import { loadEngine } from '../engine/load.js';
import { startWorker } from '../engine/start-worker.js';
import { StudioEngine } from '../engine/studio-engine.js';
import type { Plate } from '../model/plate.js';
import type { MakingServices, PlacingServices } from '../studio/services.js';
import type { Studio } from '../studio/studio.js';
import marksWorker from '../views/marks.worker.ts?worker&url';
import { fineResolution } from '../model/raster.js';
import type { Room } from '../layers/room.js';
import { drawDirections, followDirections } from './directions.js';
import { Pipeline } from './pipeline.js';

/** Creates them. @param first  returns requests that use the network before the engine does */
export function createMaking(
  { store, threads }: Studio,
  first: () => Promise<unknown>,
): { pipeline: Pipeline; making: MakingServices & PlacingServices } {
  const maker = new StudioEngine(
    { load: () => loadEngine(threads, first()), now: () => performance.now() },
    {
      onResult: (result) => pipeline.onResult(result),
      onProgress: (progress) => store.set({ progress }),
      onProblem: (problem) => store.set({ problem }),
      onInfo: (engine) => store.set({ engine }),
    },
  );
  const engine = () => maker.engine();
  async function roomOf(plate: Plate): Promise<Room> {
    const [{ shapeRoom }, running] = await Promise.all([import('../layers/shape-room.js'), engine()]);
    return shapeRoom(plate, running);
  }
  const pipeline = new Pipeline(store, maker, () => startWorker(marksWorker, 'marks'));
  followDirections(store, engine);
  const making: MakingServices & PlacingServices = {
    engine,
    cancel: () => pipeline.cancel(),
    retry: () => pipeline.retry(),
    gcode: () => pipeline.gcode(),
    body: () => pipeline.body(),
    zones: () => pipeline.zones(),
    svg: () => pipeline.svg(),
    view: () => pipeline.view(),
    directions: async (plate) => drawDirections(plate, await engine(), fineResolution),
    layerBoxes: async (plate) => {
      const [{ layerBoxes }, running] = await Promise.all([import('../engine/layer-boxes.js'), engine()]);
      return layerBoxes(plate, running);
    },
    freePlace: async (plate, taken, wanted) =>
      (await import('../layers/free-place.js')).freePlaceOn(plate, roomOf(plate), taken, wanted),
  };
  return { pipeline, making };
}
