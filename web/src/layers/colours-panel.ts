// The flat colours of a drawing, each with the direction of the beads in its areas.
import type { ColourAngle } from 'sillon';
import { css, html, type TemplateResult } from 'lit';
import { customElement, property } from 'lit/decorators.js';
import { directionsFor } from '../model/flat-colours.js';
import { words } from '../i18n/en/colours.js';
import { say } from '../i18n/text.js';
import type { PlateLayer } from '../model/plate.js';
import '../controls/dial.js';
import { StudioElement } from '../controls/element.js';
import { numberInput } from '../controls/fields.js';
import { panelStyle } from '../controls/panel-style.js';
import { changeIn } from './layer-field.js';
import { button } from '../controls/button.js';

const limits = { min: -360, max: 360, step: 1 };

@customElement('sillon-colours')
export class ColoursPanel extends StudioElement {
  static override reads = ['plate'] as const;

  static override styles = [
    panelStyle,
    css`
      ul {
        display: grid;
        gap: 8px;
      }
      li.field {
        grid-template-columns: auto minmax(max-content, 1fr) 44px minmax(0, auto);
        column-gap: 10px;
      }
      .swatch {
        width: 26px;
        height: 26px;
        border-radius: 50%;
        background: var(--colour);
        box-shadow: inset 0 0 0 1px var(--edge);
      }
      sillon-dial {
        width: 44px;
        height: 44px;
      }
    `,
  ];

  @property({ attribute: false }) layer!: PlateLayer;

  override render(): TemplateResult {
    const { colours } = this.layer;
    if (colours.length === 0) return html`<p class="note">${say(words, 'colours.none')}</p>`;
    const names = colours.map(({ colour }) => colour);
    return html`
      <ul>
        ${colours.map((one, k) => this.#row(one, k))}
      </ul>
      <div class="buttons">
        ${this.#action(say(words, 'colours.tones'), say(words, 'colours.tones.help'), () => directionsFor(names))}
        ${this.#action(say(words, 'colours.even'), say(words, 'colours.even.help'), () =>
          colours.map(({ colour }, k) => ({ colour, angle: Math.round((180 * k) / colours.length) })),
        )}
      </div>
      <p class="note">${say(words, 'colours.note')}</p>
    `;
  }

  #action(label: string, help: string, made: () => ColourAngle[]): TemplateResult {
    return button({ title: help }, label, () => this.#set(made()));
  }

  #row({ colour, angle }: ColourAngle, k: number): TemplateResult {
    const label = say(words, 'colours.one', { n: k + 1, colour });
    const id = `colour-${k}`;
    const turn = (next: number): void =>
      this.#set(
        this.layer.colours.map((one, other) => (other === k ? { ...one, angle: next } : one)),
        `colours.${this.layer.id}.${k}`,
      );
    const onSettle = (): void => this.studio.settle();
    return html`<li class="field">
      <span class="swatch" .style=${`--colour: ${colour}`}></span>
      <label for=${id} title=${colour}>${say(words, 'colours.nth', { n: k + 1 })}</label>
      <sillon-dial
        .label=${label}
        .value=${angle}
        .min=${limits.min}
        .max=${limits.max}
        @turn=${(event: CustomEvent<number>) => turn(event.detail)}
        @settle=${onSettle}
      ></sillon-dial>
      ${numberInput({ ...limits, id, label, value: angle, unit: '°', onInput: turn, onSettle })}
      <p class="error" id="${id}-error" role="status" hidden></p>
    </li>`;
  }

  #set(colours: ColourAngle[], gesture?: string): void {
    changeIn(this.studio, this.layer, () => ({ colours }), gesture);
  }
}
