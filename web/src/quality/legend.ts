// Legend of a view's colours.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { words } from '../i18n/en/quality.js';
import { formatNumber, say } from '../i18n/text.js';
import { directionPalette, markColours, rampColour } from '../views/palette.js';
import { mostDelay, type ColourBy, type Mark } from '../model/view.js';
import { StudioElement } from '../controls/element.js';

const kinds: readonly Mark['kind'][] = ['lost', 'kept', 'gap', 'turn', 'narrow', 'wide'];

@customElement('sillon-legend')
export class Legend extends StudioElement {
  static override reads = ['view', 'colourBy', 'result', 'marks', 'plate'] as const;

  static override styles = css`
    :host {
      display: flex;
      flex-wrap: wrap;
      align-items: center;
      gap: 4px 10px;
      max-width: 100%;
      padding: 6px 12px;
      font-size: var(--note);
      color: var(--soft);
    }
    :host(.within) {
      padding: 0 8px;
    }
    canvas {
      display: block;
    }
    .ramp canvas {
      width: 130px;
      height: 10px;
      border-radius: 5px;
    }
    .ramp,
    .kind {
      display: flex;
      align-items: center;
      gap: 8px;
      white-space: nowrap;
    }
    .swatch {
      width: 10px;
      height: 10px;
      border-radius: 5px;
    }
  `;

  override render(): TemplateResult | typeof nothing {
    const { view, colourBy, result } = this.state;
    if (view === 'quality') {
      const counted = kinds.filter((kind) => this.state.marks.some((mark) => mark.kind === kind));
      return html`${counted.map(
        (kind) =>
          html`<span class="kind"
            ><span class="swatch" .style=${`background: ${markColours[kind]}`}></span
            >${say(words, `mark.${kind}`)}</span
          >`,
      )}`;
    }
    if (view === 'directions' || colourBy === 'direction') {
      return html`<canvas class="fan" width="112" height="60" aria-hidden="true"></canvas>
        ${view === 'directions' ? html`<span>${say(words, 'legend.direction')}</span>` : nothing}`; // elsewhere the choice beside it explains
    }
    if (colourBy === 'lean') {
      return html`<canvas class="fan" width="112" height="112" aria-hidden="true"></canvas>
        <span class="kind"
          ><span class="swatch" style="background: #1f1f1f"></span>${say(words, 'legend.squeezed')}</span
        >`;
    }
    const spacing = result?.toolpath.spacing ?? this.state.plate.toolpath.spacing;
    const { speed } = this.state.plate.printer;
    const ends: Record<Exclude<ColourBy, 'direction' | 'lean'>, readonly [string, string]> = {
      width: [`${formatNumber(0.5 * spacing)} mm`, `${formatNumber(1.5 * spacing)} mm`],
      speed: [`${formatNumber(speed / 2)} mm/s`, `${formatNumber(speed)} mm/s`],
      order: [say(words, 'legend.first'), say(words, 'legend.last')],
      delay: [`0 s`, `${formatNumber(mostDelay)} s`],
    };
    const [from, to] = ends[colourBy];
    return html`<span class="ramp">${from}<canvas width="130" height="1" aria-hidden="true"></canvas>${to}</span>`;
  }

  override updated(): void {
    const canvas = this.renderRoot.querySelector('canvas');
    const context = canvas?.getContext('2d');
    if (canvas === null || context === null || context === undefined) return;
    if (canvas.className === 'fan') drawFan(canvas, context);
    else drawRamp(canvas, context);
  }
}

/** Draws the ramp of colours from left to right. */
function drawRamp({ width }: HTMLCanvasElement, context: CanvasRenderingContext2D): void {
  for (let x = 0; x < width; ++x) {
    const [r, g, b] = rampColour(x / (width - 1));
    context.fillStyle = `rgb(${r} ${g} ${b})`;
    context.fillRect(x, 0, 1, 1);
  }
}

/** Draws each direction as a spoke in its colour: half a turn for directions, a whole one for sides. */
function drawFan(canvas: HTMLCanvasElement, context: CanvasRenderingContext2D): void {
  canvas.style.width = `${canvas.width / 2}px`;
  const palette = directionPalette();
  const middle = canvas.width / 2;
  const turns = canvas.height > middle * 1.5 ? 2 : 1; // in half turns
  const bottom = turns === 2 ? middle : canvas.height - 4;
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.lineWidth = 3;
  const steps = 180 * turns;
  for (let k = 0; k < steps; ++k) {
    const angle = ((k + 0.5) / 180) * Math.PI;
    const at = 3 * (Math.round((256 * (k + 0.5)) / steps) % 256);
    context.strokeStyle = `rgb(${palette[at] ?? 0} ${palette[at + 1] ?? 0} ${palette[at + 2] ?? 0})`;
    context.beginPath();
    context.moveTo(middle + 18 * Math.cos(angle), bottom - 18 * Math.sin(angle));
    context.lineTo(middle + 52 * Math.cos(angle), bottom - 52 * Math.sin(angle));
    context.stroke();
  }
}
