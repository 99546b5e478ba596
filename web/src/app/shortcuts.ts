// Handles keys that work anywhere on the page; shortcut-list.ts lists the same keys.
import type { Tool } from '../model/state.js';
import type { ViewName } from '../model/view.js';
import { isTyping } from '../controls/fields.js';
import { offers } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';

const views: Record<string, ViewName> = { '1': 'appearance', '2': 'toolpath', '3': 'quality', '4': 'directions' };
const tools: Record<string, Tool> = { v: 'pan', b: 'comb', m: 'mode', e: 'erase' };
const lightKeys = [',', '.'];
const radiusStep = 1.2;
const lightStep = 5; // [degrees] per key press

/** Tells whether an event comes from a field for text. */
export function typesText(event: Event): boolean {
  const target = event.composedPath()[0];
  if (target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement) return true;
  return target instanceof HTMLInputElement && ['text', 'number'].includes(target.type);
}

let pressed = false;
for (const kind of ['pointerdown', 'pointerup', 'pointercancel'] as const) {
  addEventListener(
    kind,
    () => {
      pressed = kind === 'pointerdown';
    },
    true,
  );
}

const hasPopover = (root: ParentNode): boolean =>
  [...root.querySelectorAll('*')].some(
    (one) => one.matches(':popover-open') || (one.shadowRoot !== null && hasPopover(one.shadowRoot)),
  );

/** Tells whether Escape is free for the page: it first closes a menu, or ends a drag. */
const escapes = (): boolean => !pressed && !hasPopover(document);

/** Runs the action of a key. @returns true if the key has one */
export function onShortcut(studio: Studio, event: KeyboardEvent): boolean {
  const { state } = studio.store;
  const key = event.key.toLowerCase();
  if (state.dialog !== undefined || event.altKey) return false;
  if (event.ctrlKey || event.metaKey) return onCommand(studio, key, event);
  if (typesText(event)) return false;
  if (state.mode === 'view' && !lightKeys.includes(key)) return false;
  if (key in tools && !offers(state, 'layers')) return false;
  if (key === '?' && state.mode !== 'edit') return false;
  if (key in views) studio.setView(views[key] as ViewName);
  else if (key in tools) studio.setTool(tools[key] as Tool);
  else if (key === '?') studio.show('help');
  else if (key === 'c') studio.store.set({ compare: !state.compare, view: 'appearance' });
  else if (key === 'p') studio.togglePlay();
  else if (key === '[' || key === ']') {
    const factor = key === ']' ? radiusStep : 1 / radiusStep;
    const radius = Math.min(0.5, Math.max(0.002, state.brush.radius * factor));
    studio.store.set({ brush: { ...state.brush, radius } });
  } else if (key === ',' || key === '.') {
    const by = key === ',' ? lightStep : -lightStep;
    studio.setLight({ azimuth: (state.light.azimuth + by + 360) % 360 });
  } else if (key !== 'escape' || !escapes()) return false;
  else if (state.cropping) studio.store.set({ cropping: false });
  else if (state.reading !== undefined) state.reading.cancel();
  else if (state.progress !== undefined) studio.services.cancel();
  else if (state.tool !== 'pan') studio.setTool('pan');
  else return false;
  return true;
}

/** Runs the action of a key with Ctrl or Cmd. @returns true if the key has one */
function onCommand(studio: Studio, key: string, event: KeyboardEvent): boolean {
  const { store } = studio;
  if (store.state.mode === 'view') return false;
  if ((key === 'o' && store.state.mode !== 'edit') || (key === 's' && !offers(store.state, 'download'))) return false;
  if (key === 'k' && store.state.mode === 'edit') studio.show('palette');
  else if (key === 'o') void studio.openPicked();
  else if (key === 'p' && !event.shiftKey && offers(store.state, 'download')) studio.show('card');
  else if (key === 's') void studio.save(event.shiftKey ? 'gcode' : 'project');
  else if (isTyping(event)) return false;
  else if (key === 'z' && event.shiftKey) store.redo();
  else if (key === 'z') store.undo();
  else if (key === 'y') store.redo();
  else return false;
  return true;
}
