// Drags a row of the list to another place. The layers change places during the drag, which is one undo step.
import { raised } from '../model/layer-list.js';
import type { Studio } from '../studio/studio.js';

const begins = 4; // [CSS pixels]; a shorter movement is a click
const gesture = 'layers.order';

/** The layer whose row a pointer takes. A mouse can take any part of a row, a finger only the handle, since it
 * scrolls the panel elsewhere. */
export function rowTaken({ target, button, pointerType }: PointerEvent): number | undefined {
  const part = (target as Element).closest(pointerType === 'mouse' ? '.grip, .row' : '.grip');
  const id = part?.closest<HTMLElement>('li[data-layer]')?.dataset['layer'];
  return button === 0 && id !== undefined ? Number(id) : undefined;
}

/** The list of rows, as a drag sees it. */
interface RowList {
  /** The rows as they lie now, the topmost layer's first. */
  rows: () => readonly HTMLElement[];
  /** @param held  layer whose row is being dragged; undefined after the drag */
  hold: (held: number | undefined) => void;
}

function middleOf(row: HTMLElement): number {
  const { top, bottom } = row.getBoundingClientRect();
  return (top + bottom) / 2;
}

/** Follows a drag of a row until it ends; Escape takes it back. */
export function dragRow(studio: Studio, id: number, down: PointerEvent, list: RowList): void {
  const isOwn = (row: HTMLElement): boolean => Number(row.dataset['layer']) === id;
  const box = list.rows().find(isOwn)?.getBoundingClientRect();
  const [height, grabbed] = box === undefined ? [0, 0] : [box.height, down.clientY - box.top];
  const before = studio.store.state.plate.layers;
  const dragging = new AbortController();
  const { signal } = dragging;
  let moved = false;
  let ended = false;
  const onMove = ({ pointerId, clientY }: PointerEvent): void => {
    if (ended || pointerId !== down.pointerId || (!moved && Math.abs(clientY - down.clientY) < begins)) return;
    if (!moved) {
      moved = true;
      studio.settle();
      list.hold(id);
    }
    const rows = list.rows();
    const own = rows.findIndex(isOwn);
    const top = clientY - grabbed;
    // A row passes another once its leading edge has passed the other's middle, in both directions.
    const above = rows.filter((row, k) => k !== own && middleOf(row) < (k < own ? top : top + height)).length;
    studio.change((plate) => {
      const from = plate.layers.findIndex((layer) => layer.id === id);
      return raised(plate, id, plate.layers.length - 1 - above - from);
    }, gesture);
  };
  const end = (abandons: boolean): void => {
    if (!moved || ended) return;
    ended = true;
    const { layers } = studio.store.state.plate;
    if (abandons || layers.every((layer, k) => layer === before[k])) studio.store.abandon();
    studio.settle();
    list.hold(undefined);
  };
  const onEnd = ({ pointerId, type }: PointerEvent): void => {
    if (pointerId !== down.pointerId) return;
    // The click that follows a drag would choose a layer. It comes before any timer, so a timer ends its suppression.
    setTimeout(() => dragging.abort());
    end(type === 'pointercancel');
  };
  const onKey = ({ key }: KeyboardEvent): void => {
    if (key === 'Escape') end(true);
  };
  const onClick = (event: Event): void => {
    if (moved) event.stopPropagation();
  };
  addEventListener('pointermove', onMove, { signal });
  addEventListener('pointerup', onEnd, { signal });
  addEventListener('pointercancel', onEnd, { signal });
  addEventListener('keydown', onKey, { signal });
  addEventListener('click', onClick, { signal, capture: true });
}
