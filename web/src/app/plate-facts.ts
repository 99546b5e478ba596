// Size, printer and filament of a plate, and a button for sliced prints.
import { css, html, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';
import { panelStyle } from '../controls/panel-style.js';
import { printerLabel } from '../i18n/say.js';
import { t } from '../i18n/text.js';
import { profileOf } from '../model/printers.js';
import { filamentName } from '../print/filament-name.js';
import { sizeNumbers, stacked } from '../shape/size-fields.js';
import { thicknessNumber } from '../shape/thickness-field.js';
import { pickSliced } from './pick-sliced.js';
import { button } from '../controls/button.js';

@customElement('sillon-plate-facts')
export class PlateFacts extends StudioElement {
  static override reads = ['plate', 'keepRatio', 'units'] as const;

  static override styles = [
    panelStyle,
    css`
      .plate {
        display: grid;
        grid-template-columns: repeat(auto-fit, minmax(6rem, 1fr));
        gap: 10px;
      }
      .printer {
        justify-content: start;
        gap: 10px;
        min-height: calc(var(--control) + 10px);
        text-align: left;
      }
      .printer span {
        flex: 1;
      }
    `,
  ];

  override render(): TemplateResult {
    const { plate } = this.state;
    const profile = profileOf(plate.printer);
    const printer = profile === undefined ? plate.printer.name || t('printer.own') : printerLabel(profile);
    return html`<section aria-label=${t('app.plate')}>
      <div class="plate">${[...sizeNumbers(this.studio), thicknessNumber(this.studio)].map(stacked)}</div>
      ${button({ look: 'printer', title: t('start.printer') }, html`${icon('print')} <span>${printer} · ${filamentName(plate)}</span> ${icon('tune', 16)}`, this.studio.opens('printer'))}
      ${button('plain printer', html`${icon('comb')} <span>${t('verb.rebrush')}</span>`, () => void pickSliced(this.studio))}
    </section>`;
  }
}
