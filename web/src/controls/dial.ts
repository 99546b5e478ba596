// A protractor for an angle: a bead's line, which has no front, or a light, which has one.
import { css, html, svg, LitElement, type TemplateResult } from 'lit';
import { customElement, property } from 'lit/decorators.js';
import { controls } from './controls.js';

const wrap = (angle: number, period: number): number => ((angle % period) + period) % period;

@customElement('sillon-dial')
export class Dial extends LitElement {
  static override styles = [
    controls,
    css`
      :host {
        display: inline-block;
        width: 40px;
        height: 40px;
      }
      .dial {
        display: block;
        width: 100%;
        height: 100%;
        border-radius: 50%;
        cursor: grab;
        touch-action: none;
      }
      .dial:active {
        cursor: grabbing;
      }
      svg {
        display: block;
        width: 100%;
        height: 100%;
      }
      .face {
        fill: var(--raised);
        stroke: var(--edge);
      }
      .tick {
        stroke: var(--edge);
      }
      .hand {
        stroke: var(--accent);
        stroke-width: 2.5;
        stroke-linecap: round;
      }
      .lamp {
        fill: var(--accent);
      }
    `,
  ];

  @property() label = '';
  /** Angle in degrees, counter-clockwise from the right. */
  @property({ type: Number }) value = 0;
  @property({ type: Number }) min = -360;
  @property({ type: Number }) max = 360;
  @property() kind: 'line' | 'light' = 'line';

  override render(): TemplateResult {
    const angle = (this.value * Math.PI) / 180;
    const x = Math.cos(angle);
    const y = -Math.sin(angle);
    const period = this.kind === 'line' ? 180 : 360;
    return html`<div
      class="dial"
      role="slider"
      tabindex="0"
      aria-label=${this.label}
      aria-valuemin=${this.min}
      aria-valuemax=${this.max}
      aria-valuenow=${Math.round(this.value)}
      aria-valuetext="${Math.round(this.value)}°"
      @pointerdown=${this.#onPointerDown}
      @pointermove=${this.#onPointerMove}
      @pointerup=${this.#onPointerUp}
      @keydown=${this.#onKey}
    >
      <svg viewBox="-20 -20 40 40" aria-hidden="true">
        <circle class="face" r="18.5" />
        ${Array.from({ length: 24 }, (_, k) => {
          const turn = (k * Math.PI) / 12;
          const inner = k % 6 === 0 ? 13.5 : 16;
          return svg`<line class="tick" x1=${inner * Math.cos(turn)} y1=${inner * Math.sin(turn)}
            x2=${18 * Math.cos(turn)} y2=${18 * Math.sin(turn)} />`;
        })}
        ${
          period === 180
            ? svg`<line class="hand" x1=${-12 * x} y1=${-12 * y} x2=${12 * x} y2=${12 * y} />`
            : svg`<line class="hand" x1="0" y1="0" x2=${8 * x} y2=${8 * y} />
              <circle class="lamp" r="4" cx=${12 * x} cy=${12 * y} />`
        }
      </svg>
    </div>`;
  }

  #tell(value: number): void {
    const within = Math.min(this.max, Math.max(this.min, Math.round(value)));
    this.dispatchEvent(new CustomEvent('turn', { detail: within }));
  }

  #settle(): void {
    this.dispatchEvent(new CustomEvent('settle'));
  }

  /** Reports the angle under the pointer, as the value closest to the previous one. */
  #pointTo(event: PointerEvent): void {
    const box = this.getBoundingClientRect();
    const dx = event.clientX - box.left - box.width / 2;
    const dy = box.top + box.height / 2 - event.clientY;
    const angle = (Math.atan2(dy, dx) * 180) / Math.PI;
    const period = this.kind === 'line' ? 180 : 360;
    const away = wrap(angle - this.value + period / 2, period) - period / 2;
    let next = this.value + away;
    if (next > this.max) next -= period;
    if (next < this.min) next += period;
    this.#tell(event.shiftKey ? Math.round(next / 15) * 15 : next);
  }

  #onPointerDown = (event: PointerEvent): void => {
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    this.#pointTo(event);
  };

  #onPointerMove = (event: PointerEvent): void => {
    if ((event.currentTarget as HTMLElement).hasPointerCapture(event.pointerId)) this.#pointTo(event);
  };

  #onPointerUp = (): void => this.#settle();

  /** Turns by arrow keys: 1°, or 15° with Shift or Page keys. */
  #onKey = (event: KeyboardEvent): void => {
    const step = event.shiftKey ? 15 : 1;
    const steps: Record<string, number> = {
      ArrowUp: step,
      ArrowRight: step,
      ArrowDown: -step,
      ArrowLeft: -step,
      PageUp: 15,
      PageDown: -15,
    };
    const by = steps[event.key];
    if (by === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    this.#tell(this.value + by);
    this.#settle();
  };
}
