// Asks for a sliced print, to lay other beads on it, or for a body, to give it zones.
import { printOf } from '../files/sliced.js';
import { StudioError } from '../model/problem.js';
import type { Studio } from '../studio/studio.js';

export async function pickSliced(studio: Studio): Promise<void> {
  const [file] = await studio.pick('.gcode,.gco,.g,.gz,.bgcode,.3mf,.stl');
  if (file === undefined) return;
  const print = await printOf(file);
  if (print === '') studio.fail(new StudioError('NotSliced', { name: file.name }));
  else studio.store.set({ sliced: file, dialog: print === 'sliced' ? 'rebrush' : 'zones' });
}
