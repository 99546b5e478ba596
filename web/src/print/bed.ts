// The printer's bed from above, with the plate where it will be printed. The plate can be dragged.
import { css, html, svg, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import { settingOf, withValue } from '../model/settings.js';
import { StudioElement } from '../controls/element.js';
import { isRoundKind, pageOf } from '../model/plate.js';

@customElement('sillon-bed')
export class Bed extends StudioElement {
  static override reads = ['plate'] as const;

  static override styles = css`
    svg {
      display: block;
      width: 100%;
      max-height: 200px;
      border-radius: var(--radius);
      background: var(--sunken);
    }
    .bed {
      fill: var(--raised);
      stroke: var(--edge);
      vector-effect: non-scaling-stroke;
    }
    .grid {
      stroke: var(--line);
      vector-effect: non-scaling-stroke;
    }
    .plate {
      fill: color-mix(in srgb, var(--accent) 22%, transparent);
      stroke: var(--accent);
      stroke-width: 1.5;
      vector-effect: non-scaling-stroke;
      cursor: move;
      touch-action: none;
    }
    .outside {
      fill: color-mix(in srgb, var(--bad) 22%, transparent);
      stroke: var(--bad);
    }
  `;

  #grab: { x: number; y: number; place: [number, number] } | undefined;

  override render(): TemplateResult {
    const { plate } = this.state;
    const { printer, print, shape } = plate;
    const { roundBed } = printer;
    const [x0, y0] = printer.bedMin;
    const [x1, y1] = printer.bedMax;
    const box = this.studio.boxOnBed();
    const [px, py] = print.place ?? this.studio.centredPlace();
    const corners = [px, px + box[0]].flatMap((x) => [py, py + box[1]].map((y) => [x, y] as const));
    const round = isRoundKind(shape.kind) ? [] : corners; // the corners of a disc are empty
    const outside =
      px < x0 ||
      py < y0 ||
      px + box[0] > x1 ||
      py + box[1] > y1 ||
      (roundBed && round.some(([x, y]) => Math.hypot(x - (x0 + x1) / 2, y - (y0 + y1) / 2) > (x1 - x0) / 2));
    const margin = Math.max(x1 - x0, y1 - y0) * 0.04;
    const lines = (from: number, to: number): number[] =>
      Array.from(
        { length: Math.max(0, Math.floor(to / 50) - Math.ceil(from / 50) + 1) },
        (_, k) => (Math.ceil(from / 50) + k) * 50,
      );
    const middle: [number, number] = [px + box[0] / 2, py + box[1] / 2];
    const turned = `translate(${middle[0]} ${middle[1]}) rotate(${print.rotate})`;
    const [width, tall] = pageOf(plate);
    return html`<svg
      role="img"
      aria-label=${t('setting.print.place')}
      viewBox="${x0 - margin} ${-y1 - margin} ${x1 - x0 + 2 * margin} ${y1 - y0 + 2 * margin}"
    >
      <g transform="scale(1 -1)">
        <rect class="bed" x=${x0} y=${y0} width=${x1 - x0} height=${y1 - y0} rx=${roundBed ? (x1 - x0) / 2 : 2} />
        ${lines(x0, x1).map((x) => svg`<line class="grid" x1=${x} x2=${x} y1=${y0} y2=${y1} />`)}
        ${lines(y0, y1).map((y) => svg`<line class="grid" x1=${x0} x2=${x1} y1=${y} y2=${y} />`)}
        <g
          class="plate ${outside ? 'outside' : ''}"
          @pointerdown=${this.#onDown}
          @pointermove=${this.#onMove}
          @pointerup=${this.#onUp}
        >
          ${
            isRoundKind(shape.kind)
              ? svg`<circle cx=${middle[0]} cy=${middle[1]} r=${width / 2} />`
              : svg`<rect transform=${turned} x=${-width / 2} y=${-tall / 2} width=${width} height=${tall}
                rx=${shape.kind === 'rounded' ? shape.radius : 0} />`
          }
        </g>
      </g>
    </svg>`;
  }

  #toBed(event: PointerEvent): DOMPoint | undefined {
    const picture = this.renderRoot.querySelector('svg');
    const matrix = picture?.getScreenCTM()?.inverse();
    return matrix === undefined ? undefined : new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix);
  }

  #onDown = (event: PointerEvent): void => {
    const at = this.#toBed(event);
    if (at === undefined) return;
    (event.currentTarget as Element).setPointerCapture(event.pointerId);
    this.#grab = { x: at.x, y: at.y, place: this.state.plate.print.place ?? this.studio.centredPlace() };
  };

  #onMove = (event: PointerEvent): void => {
    const at = this.#toBed(event);
    if (this.#grab === undefined || at === undefined) return;
    const { x, y, place } = this.#grab;
    const next: [number, number] = [Math.round(place[0] + at.x - x), Math.round(place[1] - (at.y - y))];
    this.studio.change((plate) => withValue(plate, settingOf('print.place'), next), 'print.place');
  };

  #onUp = (): void => {
    this.#grab = undefined;
    this.studio.settle();
  };
}
