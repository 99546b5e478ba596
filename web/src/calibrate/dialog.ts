// Calibration dialog: the prints, photographs of a coupon, and the spools made from them.
import { css, html, type TemplateResult } from 'lit';
import { customElement, property, state } from 'lit/decorators.js';
import { loadSpools } from '../print/own-spools.js';
import { c } from '../i18n/calibrate.js';
import './photo.js';
import './prints.js';
import { DialogElement } from '../controls/dialog.js';
import { segments } from '../controls/fields.js';
import { filamentField, printerField, swatchStyle } from '../print/machine-fields.js';
import '../print/spool-list.js';

type Tab = 'prints' | 'photo' | 'spools';
const tabs: readonly Tab[] = ['prints', 'photo', 'spools'];

@customElement('sillon-calibrate')
export class Calibrate extends DialogElement {
  static override reads = ['plate', 'spools'] as const;

  static override styles = [
    swatchStyle,
    css`
      dialog {
        width: min(1080px, calc(100vw - 24px));
        height: min(860px, calc(100dvh - 24px));
      }
      .body {
        flex: 1;
        grid-template-rows: auto auto minmax(0, 1fr);
        align-content: start;
        gap: 16px;
      }
      .tabs {
        max-width: 26.25rem;
      }
      .tabs .segments {
        display: flex;
        flex-wrap: wrap; /* large letters take several rows */
      }
      .tabs .segments label {
        flex: 1 0 0;
        min-width: max-content;
      }
      .machine {
        display: grid;
        grid-template-columns: minmax(0, 1fr) minmax(0, 1fr);
        gap: 10px 28px;
        padding: 14px 16px;
      }
      .machine > div {
        display: grid;
        gap: 8px;
        align-content: start;
        justify-items: start;
      }
      .machine .field {
        width: 100%;
      }
      @media (max-width: 720px) {
        .machine {
          grid-template-columns: minmax(0, 1fr);
        }
      }
    `,
  ];

  @property() purpose: 'calibrate' | 'spools' = 'calibrate';
  @state() private tab: Tab = 'prints';

  protected override heading = (): string => c('title');

  override connectedCallback(): void {
    super.connectedCallback();
    loadSpools(this.studio);
    if (this.purpose === 'spools') this.tab = 'spools';
  }

  protected override body(): TemplateResult {
    const { tab, studio } = this;
    return html`
      <div class="tabs">
        ${segments<Tab>(
          {
            id: 'tab',
            label: c('tabs'),
            value: tab,
            options: tabs.map((value) => ({ value, label: c(`tab.${value}`) })),
            onChoose: (next) => {
              this.tab = next;
            },
          },
          false,
        )}
      </div>
      ${
        tab === 'spools'
          ? html`<sillon-spools .studio=${studio}></sillon-spools>`
          : html`<div class="machine board">
              <div>${printerField(studio)}</div>
              <div>${filamentField(studio)}</div>
            </div>`
      }
      ${
        tab === 'prints'
          ? html`<sillon-calibrate-prints
              .studio=${studio}
              @photograph=${() => {
                this.tab = 'photo';
              }}
            ></sillon-calibrate-prints>`
          : ''
      }
      ${tab === 'photo' ? html`<sillon-calibrate-photo .studio=${studio}></sillon-calibrate-photo>` : ''}
    `;
  }
}
