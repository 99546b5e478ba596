// Opens the section of a setting, unfolds the groups around it, and focuses its field.
import type { SettingId } from '../model/settings.js';
import { isAtFirst } from '../model/setting-groups.js';
import type { Studio } from '../studio/studio.js';

/** A setting, or the choice of a quality, which sets all that makes a path. */
export type FieldId = SettingId | 'quality';

const patience = 3000; // [ms] for a section that must be loaded first
const step = 50; // [ms]

/** Fields that exist only while another field has a certain value. */
const without: Partial<Record<FieldId, FieldId>> = {
  'toolpath.perimeters': 'toolpath.perimeterMode',
  'print.rimWidth': 'print.rim',
};

/** Returns the first matching element below a root, also in nested shadow roots. */
function elementIn(root: ParentNode, selector: string): HTMLElement | undefined {
  const here = root.querySelector<HTMLElement>(selector);
  if (here !== null) return here;
  for (const { shadowRoot } of root.querySelectorAll('*')) {
    const within = shadowRoot === null ? undefined : elementIn(shadowRoot, selector);
    if (within !== undefined) return within;
  }
  return undefined;
}

/** Returns the element that takes a field's focus: its input, or the chosen one of several. */
function inputOf(root: ParentNode, id: FieldId): HTMLElement | undefined {
  const name = id.replace('.', '-');
  return (
    elementIn(root, `#${name}`) ??
    elementIn(root, `input[name='${name}']:checked`) ??
    elementIn(root, `input[name='${name}']`) ??
    elementIn(root, `#${name}-null`) ??
    elementIn(root, `#${name}-0`)
  );
}

/** Opens all folded groups around an element. */
function unfold(element: HTMLElement): void {
  for (let one = element.closest('details'); one; one = one.parentElement?.closest('details') ?? null) one.open = true;
}

/** Shows a setting; gives up if its section does not come in time. */
export async function showSetting(studio: Studio, id: FieldId): Promise<void> {
  studio.show(undefined);
  if (id !== 'quality' && !isAtFirst(id)) studio.store.set({ advanced: true });
  studio.setPanel('print');
  for (let waited = 0; waited < patience; waited += step) {
    const panel = elementIn(document, 'sillon-print-panel')?.shadowRoot;
    const other = without[id];
    const found = panel && (inputOf(panel, id) ?? (other && inputOf(panel, other)));
    if (found) {
      unfold(found);
      found.scrollIntoView({ block: 'center' });
      found.focus();
      return;
    }
    await new Promise((resolve) => setTimeout(resolve, step));
  }
}
