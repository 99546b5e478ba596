// In narrow windows a section is a sheet over the plate, which Back closes.
import { closesByBack } from '../controls/back.js';
import type { Studio } from '../studio/studio.js';

export function followSheet(studio: Studio): void {
  const { store } = studio;
  const narrow = matchMedia('(max-width: 720px)');
  let closed: (() => void) | undefined;
  const follow = (): void => {
    const open = narrow.matches && store.state.panel !== '';
    if (open === (closed !== undefined)) return;
    closed?.();
    closed = open
      ? closesByBack(() => {
          studio.setPanel('');
        })
      : undefined;
  };
  narrow.addEventListener('change', follow);
  store.subscribe(({ panel }, before) => {
    if (panel !== before.panel) follow();
  });
  follow();
}
