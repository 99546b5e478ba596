// A photograph of the coupon becomes a spool.
import type { CouponReading, Measured } from 'sillon';
import { html, nothing, type TemplateResult } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { changeSpools } from './own-spools.js';
import { c } from '../i18n/calibrate.js';
import { formatNumber, t } from '../i18n/text.js';
import { withFound } from '../model/calibrate.js';
import { withSpool } from '../model/filaments.js';
import type { OwnSpool } from '../model/plate.js';
import { isAbort, problemOf, type Problem } from '../model/problem.js';
import { spoolKey, withOne } from '../model/spools.js';
import { StudioElement } from './element.js';
import { flag, numberField, textField } from './fields.js';
import { icon } from './icons.js';
import { photoStyle } from './calibrate-photo-style.js';

const usualElevation = 45; // [°]
const example = 'examples/coupon-photograph.jpg';

@customElement('sillon-calibrate-photo')
export class CalibratePhoto extends StudioElement {
  static override reads = ['plate', 'spools'] as const;
  static override styles = [...StudioElement.styles, photoStyle];

  @state() private file: File | undefined;
  @state() private url = '';
  @state() private reading: CouponReading | undefined;
  @state() private problem: Problem | undefined;
  @state() private over = false;
  /** Of the lamp [°]; undefined: nobody has measured it. */
  @state() private elevation: number | undefined;
  @state() private name = 'mySpool';
  #job: AbortController | undefined;
  readonly #end = new AbortController();

  override connectedCallback(): void {
    super.connectedCallback();
    // Before the page below hears of them.
    const { signal } = this.#end;
    for (const kind of ['dragover', 'dragleave', 'drop'] as const) {
      addEventListener(kind, this.#onFiles, { signal, capture: true });
    }
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#end.abort();
    this.#job?.abort();
    URL.revokeObjectURL(this.url);
  }

  #onFiles = (event: DragEvent): void => {
    event.preventDefault();
    event.stopPropagation();
    this.over = event.type === 'dragover';
    const file = event.type === 'drop' ? event.dataTransfer?.files[0] : undefined;
    if (file !== undefined) this.#open(file);
  };

  async #pick(): Promise<void> {
    const [file] = await this.studio.pick('image/*');
    if (file !== undefined) this.#open(file);
  }

  #open(file: File): void {
    URL.revokeObjectURL(this.url);
    this.file = file;
    this.url = URL.createObjectURL(file);
    void this.#read();
  }

  async #read(): Promise<void> {
    const { file, elevation } = this;
    if (file === undefined) return;
    this.#job?.abort();
    const job = new AbortController();
    this.#job = job;
    this.reading = undefined;
    this.problem = undefined;
    const { printer, print } = this.state.plate;
    const request = { printer, print, ...(elevation !== undefined && { lampElevation: elevation }) };
    try {
      const [{ photograph }, engine] = await Promise.all([import('../files/photo.js'), this.studio.services.engine()]);
      const reading = await engine.readCoupon(await photograph(file), request, { signal: job.signal });
      if (!job.signal.aborted) this.reading = reading;
    } catch (error) {
      if (!isAbort(error) && !job.signal.aborted) this.problem = problemOf(error);
    }
  }

  override render(): TemplateResult {
    return html`<p class="what">${c('photo.what')}</p>
      <div class="both">
        <div class="left">${this.file === undefined ? this.#empty() : this.#photograph()} ${this.#lamp()}</div>
        <div class="right" role="status">${this.#outcome()}</div>
      </div>`;
  }

  #empty(): TemplateResult {
    return html`<div class="drop ${this.over ? 'over' : ''}">
      ${icon('camera', 40)}
      <p>${c('photo.drop')}</p>
      <button type="button" class="main" @click=${() => void this.#pick()}>${c('photo.choose')}</button>
    </div>`;
  }

  #photograph(): TemplateResult {
    return html`<div class="shown ${this.over ? 'over' : ''}">
        <img src=${this.url} alt=${this.file?.name ?? ''} />
      </div>
      <button type="button" @click=${() => void this.#pick()}>${icon('open', 16)} ${c('photo.another')}</button>`;
  }

  #lamp(): TemplateResult {
    const { elevation } = this;
    const set = (next: number | undefined): void => {
      this.elevation = next;
      void this.#read();
    };
    return html`${flag({
        id: 'measured',
        label: c('photo.elevation'),
        value: elevation !== undefined,
        onChange: (on) => {
          set(on ? usualElevation : undefined);
        },
      })}
      ${
        elevation === undefined
          ? nothing
          : numberField({
              id: 'elevation',
              label: c('photo.elevation'),
              value: elevation,
              min: 10,
              max: 80,
              step: 1,
              usual: [10, 80],
              unit: '°',
              onInput: (next) => {
                this.elevation = next;
              },
              onSettle: () => void this.#read(),
            })
      }
      <p class="note">${c('photo.same')}</p>`;
  }

  #outcome(): TemplateResult {
    const { file, reading, problem } = this;
    if (problem !== undefined) {
      return html`<div class="refused">
        <h2>${icon('warn', 20)} ${c('photo.refused')}</h2>
        <p>${problem.detail}</p>
      </div>`;
    }
    if (reading !== undefined) return this.#result(reading);
    if (file !== undefined) return html`<p class="busy">${c('photo.reading')}…</p>`;
    return html`<figure>
        <img src=${example} alt=${c('photo.example')} />
        <figcaption class="note">${c('photo.example')}</figcaption>
      </figure>
      <ol>
        ${(['photo.how1', 'photo.how2', 'photo.how3'] as const).map((id) => html`<li>${c(id)}</li>`)}
      </ol>`;
  }

  #result(read: CouponReading): TemplateResult {
    const { azimuth, elevation } = read;
    const flow = read.flow;
    return html`<h2>${c('photo.read')}</h2>
      <dl>
        ${row(c('photo.along'), barred(read.along, 2, '°'))} ${row(c('photo.across'), barred(read.across, 1, '°'))}
        ${row(
          c('photo.flow'),
          flow === null ? c(read.allDiscsClosed ? 'photo.flow.lower' : 'photo.flow.higher') : barred(flow, 3),
        )}
        ${row(c('photo.width', { asked: formatNumber(read.widthAsked, 3) }), barred(read.width, 3, '\u00a0mm'))}
        ${row(
          c('photo.lamp'),
          c('photo.lamp.at', {
            azimuth: Math.round(azimuth.value),
            elevation: Math.round(elevation.value),
            error: Math.max(1, Math.round(elevation.error)),
          }),
        )}
      </dl>
      <p class="note">${c('photo.bars')}</p>
      <div class="keep">
        <span class="colour" .style=${`--colour: rgb(${read.spool.colour.join(' ')})`}></span>
        ${textField({
          id: 'spool-name',
          label: c('photo.name'),
          value: this.name,
          maxLength: 40,
          onInput: (name) => {
            this.name = name;
          },
          onSettle: () => undefined,
        })}
        <button
          type="button"
          class="main"
          @click=${() => {
            this.#keep(read);
          }}
        >
          ${icon('check', 16)} ${c('photo.keep')}
        </button>
      </div>
      ${flow === null ? nothing : this.#flow(Math.round(100 * flow.value) / 100)}`;
  }

  #flow(flow: number): TemplateResult {
    const text = formatNumber(flow, 2);
    const { plate } = this.state;
    return html`<button
      type="button"
      ?disabled=${withFound(plate, 'flow', flow, false) === plate}
      @click=${() => {
        this.studio.settle();
        this.studio.change((before) => withFound(before, 'flow', flow, false));
        this.studio.notify(c('used', { name: t('setting.print.flow'), value: text }));
      }}
    >
      ${t('setting.print.flow')}: ${c('use', { value: text })}
    </button>`;
  }

  #keep({ spool }: CouponReading): void {
    const { spools = [] } = this.state;
    const own: OwnSpool = {
      key: spoolKey(
        this.name,
        spools.map(({ key }) => key),
      ),
      ...spool,
    };
    changeSpools(this.studio, (all) => withOne(all, own));
    this.studio.settle();
    this.studio.change((plate) => withSpool(plate, own));
    this.name = own.key;
    this.studio.notify(c('photo.kept', { name: own.key }));
  }
}

const row = (name: string, value: string): TemplateResult =>
  html`<div>
    <dt>${name}</dt>
    <dd class="figures">${value}</dd>
  </div>`;

const barred = ({ value, error }: Measured, digits: number, unit = ''): string =>
  `${formatNumber(value, digits)} ± ${formatNumber(error, digits)}${unit}`;
