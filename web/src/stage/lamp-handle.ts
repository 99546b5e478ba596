// The handle of the lamp around the plate: dragging moves the lamp, keys turn and raise it.
import { css, html, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';
import { elevations } from '../views/light.js';

const [lowest, highest] = elevations;
const inner = 0.58; // place of a lamp straight above, as a share of the way to the bench's edge; smaller: it hides the plate
const step = 5; // [degrees] per key press
const leap = 15; // [degrees] per key press with Shift

/** Returns the place of a lamp of this elevation [degrees], as a share of the way to the bench's edge. */
const reach = (elevation: number): number => 1 - ((1 - inner) * elevation) / highest;

@customElement('sillon-lamp')
export class LampHandle extends StudioElement {
  static override reads = ['light'] as const;

  static override styles = css`
    :host {
      --inset: 30px; /* of its track from the edges: the handle's half, and a gap */
      pointer-events: none;
    }
    .lamp {
      position: absolute;
      left: calc(50% + (50% - var(--inset)) * var(--x));
      top: calc(50% - (50% - var(--inset)) * var(--y));
      display: grid;
      place-items: center;
      width: 44px;
      height: 44px;
      margin: -22px 0 0 -22px;
      border-radius: 50%;
      color: #3a2a06;
      cursor: grab;
      pointer-events: auto;
      touch-action: none;
    }
    .lamp::before {
      content: '';
      position: absolute;
      inset: 6px;
      border-radius: 50%;
      background: radial-gradient(circle at 40% 35%, #fff7e0, #f3cf82 60%, #d9a548);
      box-shadow:
        0 0 0 1px rgb(0 0 0 / 0.35),
        0 0 22px 4px rgb(255 214 130 / 0.45);
    }
    .lamp:active {
      cursor: grabbing;
    }
    .icon {
      position: relative;
    }
  `;

  override render(): TemplateResult {
    const { azimuth, elevation } = this.state.light;
    const [turn, far] = [(azimuth * Math.PI) / 180, reach(elevation)];
    const degrees = { azimuth: Math.round(azimuth), elevation: Math.round(elevation) };
    return html`<div
      class="lamp"
      role="slider"
      tabindex="0"
      aria-label=${t('light.azimuth')}
      aria-valuemin="0"
      aria-valuemax="360"
      aria-valuenow=${degrees.azimuth}
      aria-valuetext=${t('lamp.stands', degrees)}
      title=${t('light.drag')}
      .style=${`--x: ${far * Math.cos(turn)}; --y: ${far * Math.sin(turn)}`}
      @pointerenter=${() => this.studio.store.set({ lampHeld: true })}
      @pointerleave=${() => this.studio.store.set({ lampHeld: false })}
      @pointerdown=${(event: PointerEvent) => (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId)}
      @pointermove=${this.#onMove}
      @wheel=${this.#onWheel}
      @keydown=${this.#onKey}
    >
      ${icon('sun')}
    </div>`;
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.studio.store.set({ lampHeld: false });
  }

  /** Places the lamp under the pointer that drags it. */
  #onMove = (event: PointerEvent): void => {
    const lamp = event.currentTarget as HTMLElement;
    if (!lamp.hasPointerCapture(event.pointerId)) return;
    const { left, top, width, height } = this.getBoundingClientRect();
    const inset = parseFloat(getComputedStyle(this).getPropertyValue('--inset'));
    const x = (event.clientX - left - width / 2) / (width / 2 - inset);
    const y = (top + height / 2 - event.clientY) / (height / 2 - inset);
    const azimuth = (Math.atan2(y, x) * 180) / Math.PI;
    const elevation = (highest * (1 - Math.hypot(x, y))) / (1 - inner);
    this.studio.setLight({
      azimuth: Math.round(azimuth + 360) % 360,
      elevation: Math.round(Math.min(highest, Math.max(lowest, elevation))),
    });
  };

  /** Passes a wheel event on to the plate: the lamp follows the pointer and sometimes lies under it. */
  #onWheel = (event: WheelEvent): void => {
    event.preventDefault();
    this.studio.stage?.wheel(event);
  };

  /** Turns the lamp by the left and right arrow keys, and raises or lowers it by the others. */
  #onKey = (event: KeyboardEvent): void => {
    const by = event.shiftKey ? leap : step;
    const { azimuth, elevation } = this.state.light;
    if (event.key === 'ArrowLeft') this.studio.setLight({ azimuth: (azimuth + by) % 360 });
    else if (event.key === 'ArrowRight') this.studio.setLight({ azimuth: (azimuth - by + 360) % 360 });
    else if (event.key === 'ArrowUp') this.studio.setLight({ elevation: Math.min(highest, elevation + by) });
    else if (event.key === 'ArrowDown') this.studio.setLight({ elevation: Math.max(lowest, elevation - by) });
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
}
