// Puts together what computes a plate's results: the engine, the directions that it is given, and the order of both.
import directionsWorker from '../generators/directions.worker.ts?worker&url';
import { createRasteriser } from '../generators/rasteriser.js';
import type { Room } from '../generators/room.js';
import { loadEngine } from '../engine/load.js';
import { startWorker } from '../engine/start-worker.js';
import { StudioEngine } from '../engine/studio-engine.js';
import type { Plate } from '../model/plate.js';
import type { MakingServices, PlacingServices } from '../studio/services.js';
import type { Studio } from '../studio/studio.js';
import marksWorker from '../views/marks.worker.ts?worker&url';
import { Pipeline } from './pipeline.js';

/** @param first  what is to have the network before the engine */
export function createMaking(
  { store, threads }: Studio,
  first: () => Promise<unknown>,
): { pipeline: Pipeline; making: MakingServices & PlacingServices } {
  const maker = new StudioEngine(
    { load: () => loadEngine(threads, first()), now: () => performance.now() },
    {
      onResult: (result) => {
        pipeline.onResult(result);
      },
      onProgress: (progress) => {
        store.set({ progress });
      },
      onProblem: (problem) => {
        store.set({ problem });
      },
      onInfo: (engine) => {
        store.set({ engine });
      },
    },
  );
  const engine = () => maker.engine();
  const rasteriser = createRasteriser(
    async (file) => {
      const [{ pictureOfFile }, running] = await Promise.all([import('../files/drawn.js'), engine()]);
      return pictureOfFile(file, running);
    },
    () => startWorker(directionsWorker, 'directions'),
  );
  async function roomOf(plate: Plate): Promise<Room> {
    const [{ shapeRoom }, running] = await Promise.all([import('../generators/shape-room.js'), engine()]);
    return shapeRoom(plate, running);
  }
  const pipeline = new Pipeline(store, maker, rasteriser, () => startWorker(marksWorker, 'marks'), roomOf);
  const making: MakingServices & PlacingServices = {
    engine,
    cancel: () => {
      pipeline.cancel();
    },
    retry: () => {
      pipeline.retry();
    },
    drew: (ms) => {
      maker.drew(ms);
    },
    gcode: () => pipeline.gcode(),
    body: () => pipeline.body(),
    zones: () => pipeline.zones(),
    svg: () => pipeline.svg(),
    view: () => pipeline.view(),
    directions: () => pipeline.directions(),
    layerBoxes: async (plate) => {
      const [{ layerBoxes }, running] = await Promise.all([import('../engine/layer-boxes.js'), engine()]);
      return layerBoxes(plate, running);
    },
    freePlace: async (plate, taken, wanted) =>
      (await import('../generators/free-place.js')).freePlaceOn(plate, roomOf(plate), taken, wanted),
  };
  return { pipeline, making };
}
