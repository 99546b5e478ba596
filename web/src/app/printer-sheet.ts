// The sheet of printer, filament and thickness: it opens before the first file, and at any later time.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement, property, state } from 'lit/decorators.js';
import { words } from '../i18n/en/printer.js';
import { machineName } from '../i18n/say.js';
import { say, t } from '../i18n/text.js';
import { printersByFile } from '../model/printers.js';
import { thicknessOf } from '../model/thickness.js';
import { DialogElement } from '../controls/dialog.js';
import { icon } from '../controls/icons.js';
import { thicknessField } from '../shape/thickness-field.js';
import type { Shown } from '../studio/shown.js';
import { markUntried, untriedText } from '../studio/untried-print.js';
import { filamentField, printerField, swatchStyle } from '../print/machine-fields.js';
import { loadSpools } from '../print/own-spools.js';
import { button } from '../controls/button.js';

/** Rounds a length [mm] to the micrometre. */
const rounded = (length: number): number => Math.round(1000 * length) / 1000;

@customElement('sillon-printer-sheet')
export class PrinterSheet extends DialogElement {
  static override reads = ['plate', 'own', 'spools', 'units'] as const;

  static override styles = [
    swatchStyle,
    css`
      dialog {
        width: min(520px, calc(100vw - 24px));
      }
      section {
        display: grid;
        gap: 10px;
        justify-items: start;
      }
      section > .field {
        width: 100%;
      }
      .missing {
        color: var(--bad);
      }
      .end .main {
        min-height: max(42px, var(--control));
        padding: 0 20px;
      }
    `,
  ];

  @property() purpose: 'printer' | 'firstFile' = 'printer';
  /** Key of a chosen printer that needs a file, until the file is read. */
  @state() private waits = '';
  @state() private missing = false;

  protected override heading = (): string => say(words, 'sheet.title');

  override connectedCallback(): void {
    super.connectedCallback();
    loadSpools(this.studio);
  }

  protected override onState({ plate }: Readonly<Shown>, { plate: before }: Readonly<Shown>): void {
    if (plate.printer === before.printer) return;
    this.waits = ''; // a file has defined the printer, or another one was chosen
    this.missing = false;
  }

  /** Tells whether the printer is still unknown: nobody has chosen one, or the chosen one waits for its file. */
  #lacks = (): boolean => this.waits !== '' || this.studio.lacksPrinter();

  protected override body(): TemplateResult {
    const { plate } = this.state;
    const lacks = this.#lacks();
    const waiting = printersByFile.find(({ key }) => key === this.waits);
    return html`<p>${say(words, 'sheet.what')}</p>
      <section>
        ${printerField(this.studio, {
          value: lacks ? this.waits : undefined,
          onChoose: (key) => {
            this.waits = printersByFile.some((one) => one.key === key) ? key : '';
            this.missing = false;
          },
        })}
        ${waiting === undefined ? nothing : html`<p role="status">${say(words, 'printer.needsFile', { name: waiting.label })}</p>`}
        ${this.missing && waiting === undefined ? html`<p class="missing" role="alert">${say(words, 'sheet.missing')}</p>` : nothing}
      </section>
      <section>${filamentField(this.studio)}</section>
      <section>${thicknessField(this.studio)}</section>
      <p class="note">
        ${untriedText(plate)} ${button('link', t('verb.first'), () => this.close(this.studio.opens('first')))}
      </p>
      <div class="end">
        ${button(
          'main',
          this.purpose === 'printer' ? t('verb.done') : html`${icon('download')} ${this.#file(lacks)}`,
          () => this.#answer(lacks),
        )}
      </div>`;
  }

  #file(lacks: boolean): string {
    const printer = lacks ? '' : machineName(this.state.plate.printer);
    return printer === '' ? t('keys.gcode') : t('export.gcodeFor', { printer });
  }

  /** Keeps the answers and closes the sheet, or asks for the missing printer. */
  #answer(lacks: boolean): void {
    if (lacks) {
      this.missing = true;
      this.renderRoot.querySelector<HTMLElement>(this.waits === '' ? '#printer' : '#printer-file')?.focus();
      return;
    }
    const { purpose, studio } = this;
    studio.settle();
    markUntried(studio);
    void studio.attempt(() => studio.keepOwnPrint(rounded(thicknessOf(this.state.plate))));
    this.close(() => {
      if (purpose === 'firstFile') studio.goOnPrinting();
    });
  }
}
