// Changes a number while its name is dragged: to the right it grows, by one step every few pixels.
import type { NumberField } from './fields.js';

const pixelsPerStep = 4;
const steps = 150; // steps across the usual range, if it has more
const begins = 3; // [pixels] shorter drags are clicks

/** Follows a drag until it ends. @param down  the pointerdown event on the field's name */
export function scrub(
  down: PointerEvent,
  name: HTMLElement,
  { value, min, max, step, usual, onInput, onSettle }: NumberField,
): void {
  const [low, high] = usual ?? [0, steps * step];
  const by = Math.max(step, Math.ceil((high - low) / steps / step) * step) / pixelsPerStep;
  let moved = false;
  let last = value;
  const end = new AbortController();
  const { signal } = end;
  const onMove = (event: PointerEvent): void => {
    const dx = event.clientX - down.clientX;
    if (!moved && Math.abs(dx) < begins) return;
    moved = true;
    const exact = value + dx * by * (event.shiftKey ? 0.1 : 1);
    const next = Math.min(max, Math.max(min, Number((Math.round(exact / step) * step).toFixed(6))));
    if (next === last) return;
    last = next;
    onInput(next);
  };
  const onEnd = (): void => {
    end.abort();
    name.classList.remove('drags');
    if (moved) onSettle?.();
  };
  name.classList.add('drags');
  addEventListener('pointermove', onMove, { signal });
  addEventListener('pointerup', onEnd, { signal });
  addEventListener('pointercancel', onEnd, { signal });
  // A drag must not count as a click on the name, which would focus the field.
  addEventListener(
    'click',
    (event) => {
      if (moved) event.preventDefault();
    },
    { capture: true, once: true },
  );
}
