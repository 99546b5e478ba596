// Asks for a print that a slicer made, to lay other beads on it.
import { seemsSliced } from '../files/sliced.js';
import { StudioError } from '../model/problem.js';
import type { Studio } from '../studio/studio.js';

export async function pickSliced(studio: Studio): Promise<void> {
  const [file] = await studio.pick('.gcode,.gco,.g,.gz,.bgcode,.3mf');
  if (file === undefined) return;
  const head = new Uint8Array(await file.slice(0, 64).arrayBuffer());
  if (seemsSliced(file.name, head)) studio.store.set({ sliced: file, dialog: 'rebrush' });
  else studio.fail(new StudioError('NotSliced', { name: file.name }));
}
