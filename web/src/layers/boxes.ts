// Asks the engine for the layers' boxes after each change of the layers. Only one question is open at a time; changes
// meanwhile lead to a single further question.
import type { KnownBox } from '../model/layer-frame.js';
import type { Plate } from '../model/plate.js';
import type { Studio } from '../studio/studio.js';

const followed = new WeakSet<Studio>();

const samePlaces = (a: Plate, b: Plate): boolean =>
  a.layers === b.layers && a.width === b.width && a.height === b.height && a.shape === b.shape;

/** Keeps `layerBoxes` of the state up to date; further calls have no effect. */
export function followBoxes(studio: Studio): void {
  if (followed.has(studio)) return;
  followed.add(studio);
  const { store } = studio;
  let asked: Plate | undefined;
  let asking = false;

  const ask = async (): Promise<void> => {
    const { plate } = store.state;
    if (asking || (asked !== undefined && samePlaces(asked, plate))) return;
    asking = true;
    asked = plate;
    try {
      const boxes = await studio.services.layerBoxes(plate);
      const placed = plate.layers.flatMap((layer): [number, KnownBox][] => {
        const box = boxes.get(layer.id);
        return box === undefined ? [] : [[layer.id, { layer, size: box.size }]];
      });
      store.set({ layerBoxes: new Map(placed) });
    } catch {
      // Faults of layers are reported where the plate is made. Frames stay as far as they are known without the engine.
    } finally {
      asking = false;
    }
    void ask();
  };

  store.subscribe((state, before) => {
    if (state.plate !== before.plate) void ask();
  });
  void ask();
}
