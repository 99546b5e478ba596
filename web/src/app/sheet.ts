// Lets Back close the section that is open as a sheet over the plate in narrow windows.
import { closesByBack } from '../controls/back.js';
import type { Studio } from '../studio/studio.js';

/** Registers the sheet with Back whenever a section opens in a narrow window. */
export function followSheet(studio: Studio): void {
  const { store } = studio;
  const narrow = matchMedia('(max-width: 720px)');
  let closed: (() => void) | undefined;
  const follow = (): void => {
    const open = narrow.matches && store.state.panel !== '';
    if (open === (closed !== undefined)) return;
    closed?.();
    closed = open ? closesByBack(() => studio.setPanel('')) : undefined;
  };
  narrow.addEventListener('change', follow);
  store.subscribe(({ panel }, before) => {
    if (panel !== before.panel) follow();
  });
  follow();
}
