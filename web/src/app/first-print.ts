// Leads to a first file for one's own printer: the machine, the first object to print, and what to check on the print.
import type { Calibration } from 'sillon';
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { c } from '../i18n/calibrate.js';
import { t } from '../i18n/text.js';
import { withSpool } from '../model/filaments.js';
import { isAbort } from '../model/problem.js';
import { choiceCards } from '../controls/cards.js';
import { calibrationOf, costText, saveCalibration } from '../calibrate/prints.js';
import { drawing } from '../calibrate/drawings.js';
import { DialogElement } from '../controls/dialog.js';
import { coaster } from '../plates/examples.js';
import { icon } from '../controls/icons.js';
import { printerField, takePrinter } from '../print/machine-fields.js';
import type { Shown } from '../studio/shown.js';
import { button } from '../controls/button.js';

type First = 'coupon' | 'coaster';

@customElement('sillon-first')
export class FirstPrint extends DialogElement {
  static override reads = ['plate', 'progress'] as const;

  static override styles = [
    choiceCards,
    css`
      dialog {
        width: min(720px, calc(100vw - 24px));
      }
      .step {
        display: grid;
        gap: 12px;
      }
      .steps {
        display: grid;
        gap: 22px;
        list-style: none;
        counter-reset: step;
      }
      .step {
        position: relative;
        padding-left: 44px;
        justify-items: start;
        counter-increment: step;
      }
      .step::before {
        content: counter(step);
        position: absolute;
        left: 0;
        top: -3px;
        display: grid;
        width: 28px;
        height: 28px;
        place-content: center;
        border-radius: 50%;
        background: var(--tint);
        color: var(--accent);
        font-weight: 600;
      }
      .step > h2 {
        font-size: var(--lead);
      }
      .step > .field,
      .choices {
        width: 100%;
      }
      .choices {
        display: grid;
        grid-template-columns: 1fr 1fr;
        gap: 10px;
      }
      .choices .card {
        grid-template-columns: auto minmax(0, 1fr);
        gap: 2px 12px;
        padding: 10px 14px 10px 10px;
      }
      .drawing {
        width: 52px;
        height: 52px;
      }
      .words b {
        font-size: var(--lead);
      }
      .take {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: 6px 14px;
      }
      .take button {
        min-height: max(42px, var(--control));
        padding: 0 20px;
      }
      .after {
        display: grid;
        gap: 6px;
        margin: 0;
        padding-left: 18px;
        list-style: disc;
      }
      @media (max-width: 520px) {
        .choices {
          grid-template-columns: 1fr;
        }
        .step {
          padding-left: 0;
        }
        .step > h2 {
          padding-left: 38px;
          min-height: 24px;
        }
      }
    `,
  ];

  @state() private first: First = 'coupon';
  @state() private coupon: Calibration | undefined;
  #job: AbortController | undefined;

  protected override heading = (): string => c('first.title');

  override connectedCallback(): void {
    super.connectedCallback();
    // Capturing listeners run before those of the page below.
    this.listen('dragover', this.#onFile, true);
    this.listen('drop', this.#onFile, true);
    void this.#estimate();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#job?.abort();
  }

  /** Reads the printer from a file of the visitor's slicer. */
  #onFile = (event: DragEvent): void => {
    event.preventDefault();
    event.stopPropagation();
    const file = event.type === 'drop' ? event.dataTransfer?.files[0] : undefined;
    if (file !== undefined) void takePrinter(this.studio, file);
  };

  protected override onState({ plate }: Readonly<Shown>, { plate: before }: Readonly<Shown>): void {
    if (plate.printer !== before.printer) void this.#estimate();
  }

  /** Computes the cost of the coupon. */
  async #estimate(): Promise<void> {
    this.#job?.abort();
    const job = new AbortController();
    this.#job = job;
    try {
      const engine = await this.studio.services.engine();
      const made = await engine.calibrate('coupon', calibrationOf(this.state.plate, 0), { signal: job.signal });
      if (!job.signal.aborted) this.coupon = made;
    } catch (error) {
      if (!isAbort(error)) this.coupon = undefined; // its download reports the reason
    }
  }

  protected override body(): TemplateResult {
    return html`<p>${c('first.what')}</p>
      <ol class="steps">
        <li class="step">
          <h2>${c('first.machine')}</h2>
          ${printerField(this.studio)}
          <p class="note">${c('first.machineHelp')}</p>
        </li>
        <li class="step">
          <h2 id="what-first">${c('first.print')}</h2>
          <div class="choices" role="radiogroup" aria-labelledby="what-first">
            ${this.#choice('coupon')} ${this.#choice('coaster')}
          </div>
        </li>
        <li class="step">
          <h2>${c('first.download')}</h2>
          <div class="take">
            ${button('main', html`${icon('download')} ${c('first.download')}`, () => this.#save())}
            ${
              this.first === 'coupon' && this.coupon !== undefined
                ? html`<span class="note figures">${costText(this.coupon)}</span>`
                : nothing
            }
          </div>
        </li>
        <li class="step">
          <h2>${c('first.after')}</h2>
          <ul class="after">
            ${(['first.after1', 'first.after2', 'first.after3'] as const).map((id) => html`<li>${c(id)}</li>`)}
          </ul>
          ${button('', html`${icon('tune', 16)} ${t('verb.calibrate')}`, () =>
            this.close(this.studio.opens('calibrate')),
          )}
        </li>
      </ol>`;
  }

  #choice(value: First): TemplateResult {
    return html`<label class="card board">
      <input
        type="radio"
        name="first"
        value=${value}
        .checked=${value === this.first}
        @change=${() => {
          this.first = value;
        }}
      />
      ${drawing(value)}
      <span class="words"><b>${c(`first.${value}`)}</b><span class="note">${c(`first.${value}Help`)}</span></span>
    </label>`;
  }

  /** Downloads the chosen first print; the coaster replaces the plate, but keeps its printer and filament. */
  #save(): void {
    const { first, studio } = this;
    if (first === 'coupon') {
      studio.whenReviewed(() => void saveCalibration(studio, 'coupon'));
      return;
    }
    void studio.attempt(async () => {
      const { printer, spool, pictures } = this.state.plate;
      await studio.services.openExample(coaster);
      studio.change((plate) => ({
        ...withSpool(plate, spool),
        pictures: { ...plate.pictures, spool: pictures.spool },
        printer,
      }));
      await studio.save('gcode');
    });
  }
}
