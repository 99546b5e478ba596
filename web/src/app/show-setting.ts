// Opens the section that has a setting, and leads to its field.
import type { SettingId } from '../model/settings.js';
import type { Studio } from '../studio/studio.js';

const patience = 3000; // [ms] for a section that is fetched first
const step = 50; // [ms]

/** The field's element in any shadow root below. */
function fieldIn(root: ParentNode, id: string): HTMLElement | undefined {
  for (const one of root.querySelectorAll<HTMLElement>('*')) {
    if (one.id === id) return one;
    const within = one.shadowRoot === null ? undefined : fieldIn(one.shadowRoot, id);
    if (within !== undefined) return within;
  }
  return undefined;
}

export async function showSetting(studio: Studio, id: SettingId): Promise<void> {
  studio.store.set({ advanced: true });
  studio.setPanel(id.startsWith('toolpath.') ? 'toolpath' : 'print');
  const field = id.replace('.', '-');
  for (let waited = 0; waited < patience; waited += step) {
    const found = fieldIn(document, field);
    if (found !== undefined) {
      found.scrollIntoView({ block: 'center' });
      found.focus();
      return;
    }
    await new Promise((resolve) => setTimeout(resolve, step));
  }
}
