// Turns photographs of a coupon into a spool.
import type { CouponReading, Measured } from 'sillon';
import { html, nothing, type TemplateResult } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { repeat } from 'lit/directives/repeat.js';
import { changeSpools } from '../print/own-spools.js';
import { c } from '../i18n/calibrate.js';
import { formatNumber, t } from '../i18n/text.js';
import { withFound } from './model.js';
import { withSpool } from '../model/filaments.js';
import type { OwnSpool } from '../model/plate.js';
import { isAbort, problemOf, type Problem } from '../model/problem.js';
import { spoolKey, withOne } from '../print/spools.js';
import { StudioElement } from '../controls/element.js';
import { flag, numberField, textField } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import { photoStyle } from './photo-style.js';
import { button } from '../controls/button.js';

const usualElevation = 45; // [°], shown first when the visitor states the lamp's elevation
const enough = 3; // photographs; with fewer, the page asks for more
const example = 'examples/coupon-photograph.jpg';

/** A photograph with its reading, or with the reason why it was refused. It has neither while it is unread. */
interface Shot {
  readonly file: File;
  readonly url: string;
  readonly reading?: CouponReading | undefined;
  readonly problem?: Problem | undefined;
}

/** Text id for a flow without a figure. */
function flowBeyond(read: CouponReading): 'photo.flow.lower' | 'photo.flow.higher' | 'photo.flow.unknown' {
  if (read.allDiscsClosed) return 'photo.flow.lower';
  return read.noDiscClosed ? 'photo.flow.higher' : 'photo.flow.unknown';
}

@customElement('sillon-calibrate-photo')
export class CalibratePhoto extends StudioElement {
  static override reads = ['plate', 'spools'] as const;
  static override styles = photoStyle;

  @state() private shots: readonly Shot[] = [];
  /** Result of all readings together. */
  @state() private joined: CouponReading | undefined;
  @state() private apart: Problem | undefined;
  @state() private over = false;
  /** Elevation of the lamp [°]; undefined where nobody has measured it. */
  @state() private elevation: number | undefined;
  @state() private name = 'mySpool';
  #job: AbortController | undefined;
  readonly #end = new AbortController();

  override connectedCallback(): void {
    super.connectedCallback();
    // Files dropped here are taken in the capture phase, before the page below handles them.
    const { signal } = this.#end;
    for (const kind of ['dragover', 'dragleave', 'drop'] as const) {
      addEventListener(kind, this.#onFiles, { signal, capture: true });
    }
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#end.abort();
    this.#job?.abort();
    for (const { url } of this.shots) URL.revokeObjectURL(url);
  }

  #onFiles = (event: DragEvent): void => {
    event.preventDefault();
    event.stopPropagation();
    this.over = event.type === 'dragover';
    if (event.type === 'drop') this.#add([...(event.dataTransfer?.files ?? [])]);
  };

  async #pick(): Promise<void> {
    this.#add(await this.studio.pick('image/*'));
  }

  /** Adds photographs; one that is there already is left out, since it would count twice. */
  #add(files: readonly File[]): void {
    const isNew = (file: File): boolean => !this.shots.some((shot) => sameFile(shot.file, file));
    const shots = files.filter(isNew).map((file) => ({ file, url: URL.createObjectURL(file) }));
    if (shots.length === 0) return;
    this.shots = [...this.shots, ...shots];
    void this.#read();
  }

  #remove(shot: Shot): void {
    URL.revokeObjectURL(shot.url);
    this.shots = this.shots.filter(({ url }) => url !== shot.url);
    void this.#read();
  }

  #readAgain(): void {
    this.shots = this.shots.map(({ file, url }) => ({ file, url }));
    void this.#read();
  }

  /** Reads the photographs that are still unread, one after the other, and then joins all readings. */
  async #read(): Promise<void> {
    this.#job?.abort();
    const job = new AbortController();
    this.#job = job;
    const { signal } = job;
    const { printer, print } = this.state.plate;
    const { elevation } = this;
    const request = { printer, print, ...(elevation !== undefined && { lampElevation: elevation }) };
    this.joined = undefined;
    this.apart = undefined;
    const told = (shot: Shot, outcome: Pick<Shot, 'reading' | 'problem'>): void => {
      this.shots = this.shots.map((one) => (one.url === shot.url ? { ...one, ...outcome } : one));
    };
    for (;;) {
      const shot = this.shots.find(isWaiting);
      if (shot === undefined) break;
      try {
        const [{ photograph }, engine] = await Promise.all([
          import('../files/photo.js'),
          this.studio.services.engine(),
        ]);
        const reading = await engine.readCoupon(await photograph(shot.file), request, { signal });
        if (signal.aborted) return;
        told(shot, { reading });
      } catch (error) {
        if (isAbort(error) || signal.aborted) return;
        told(shot, { problem: problemOf(error) });
      }
    }
    const readings = this.#readings();
    if (readings.length === 0) return;
    try {
      const engine = await this.studio.services.engine();
      const joined = await engine.joinReadings(readings, request, { signal });
      if (!signal.aborted) this.joined = joined;
    } catch (error) {
      if (!isAbort(error) && !signal.aborted) this.apart = problemOf(error);
    }
  }

  #readings(): CouponReading[] {
    return this.shots.flatMap(({ reading }) => reading ?? []);
  }

  override render(): TemplateResult {
    return html`<p class="what">${c('photo.what')}</p>
      <div class="both">
        <div class="left">${this.shots.length === 0 ? this.#empty() : this.#photographs()} ${this.#lamp()}</div>
        <div class="right" role="status">${this.#outcome()}</div>
      </div>`;
  }

  #empty(): TemplateResult {
    return html`<div class="drop ${this.over ? 'over' : ''}">
      ${icon('camera', 40)}
      <p>${c('photo.drop')}</p>
      ${button('main', c('photo.choose'), () => void this.#pick())}
    </div>`;
  }

  #photographs(): TemplateResult {
    const readings = this.#readings();
    return html`<ul class="shots board ${this.over ? 'over' : ''}" aria-label=${c('photo.list')} aria-live="polite">
        ${repeat(
          this.shots,
          ({ url }) => url,
          (shot) => this.#row(shot, shot.reading === undefined ? 0 : readings.indexOf(shot.reading) + 1),
        )}
      </ul>
      ${button('', html`${icon('plus', 16)} ${c('photo.another')}`, () => void this.#pick())}`;
  }

  /** One photograph in the list. @param number  number in the engine's order of readings, which its messages use; 0:
   * no reading */
  #row(shot: Shot, number: number): TemplateResult {
    const { file, url, reading, problem } = shot;
    const name = number > 0 && this.shots.length > 1 ? `${number}. ${file.name}` : file.name;
    const remove = c('photo.remove', { name: file.name });
    return html`<li>
      <img src=${file.type === 'image/svg+xml' ? nothing : url} alt="" />
      <div class="told">
        <p class="title cut" title=${file.name}>${name}</p>
        ${reading === undefined ? nothing : gave(reading)}
        ${problem === undefined ? nothing : html`<p class="why"><b>${c('photo.refused')}:</b> ${problem.detail}</p>`}
        ${isWaiting(shot) ? html`<p class="note">${c('photo.reading')}…</p>` : nothing}
      </div>
      ${button({ look: 'plain square', name: remove }, icon('bin', 16), () => this.#remove(shot))}
    </li>`;
  }

  #lamp(): TemplateResult {
    const { elevation } = this;
    const set = (next: number | undefined): void => {
      this.elevation = next;
      this.#readAgain();
    };
    return html`${flag({
        id: 'measured',
        label: c('photo.elevation'),
        value: elevation !== undefined,
        onChange: (on) => set(on ? usualElevation : undefined),
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
              onSettle: () => this.#readAgain(),
            })
      }
      <p class="note">${c('photo.same')}</p>`;
  }

  #outcome(): TemplateResult {
    const { apart, joined } = this;
    if (apart !== undefined) {
      return html`<div class="refused">
        <h2>${icon('warn', 20)} ${c('photo.apart')}</h2>
        <p>${apart.detail}</p>
      </div>`;
    }
    if (joined !== undefined) return this.#result(joined);
    if (this.shots.some(isWaiting)) return html`<p class="busy">${c('photo.reading')}…</p>`;
    return html`<figure>
        <img src=${example} alt=${c('photo.example')} />
        <figcaption class="note">${c('photo.example')}</figcaption>
      </figure>
      <ol>
        ${(['photo.how1', 'photo.how2', 'photo.how3', 'photo.how4'] as const).map((id) => html`<li>${c(id)}</li>`)}
      </ol>`;
  }

  #result(read: CouponReading): TemplateResult {
    const n = this.#readings().length;
    const flow = read.flow;
    return html`<h2>${c('photo.read', { n })}</h2>
      <dl class="board">
        ${row(c('photo.along'), barred(read.along, 2, '°'))} ${row(c('photo.across'), barred(read.across, 1, '°'))}
        ${row(c('photo.flow'), flow === null ? c(flowBeyond(read)) : barred(flow, 3))}
        ${row(c('photo.width', { asked: formatNumber(read.widthAsked, 3) }), barred(read.width, 3, '\u00a0mm'))}
      </dl>
      <p class="note">${c('photo.bars')} ${n < enough ? c('photo.more') : nothing}</p>
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
        })}
        ${button('main', html`${icon('check', 16)} ${c('photo.keep')}`, () => this.#keep(read))}
      </div>
      ${flow === null ? nothing : this.#flow(Math.round(100 * flow.value) / 100)}`;
  }

  #flow(flow: number): TemplateResult {
    const text = formatNumber(flow, 2);
    const { plate } = this.state;
    return button(
      { disabled: withFound(plate, 'flow', flow, false) === plate },
      html`${t('setting.print.flow')}: ${c('use', { value: text })}`,
      () => {
        this.studio.settle();
        this.studio.change((before) => withFound(before, 'flow', flow, false));
        this.studio.notify(c('used', { name: t('setting.print.flow'), value: text }));
      },
    );
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

const isWaiting = ({ reading, problem }: Shot): boolean => reading === undefined && problem === undefined;

const sameFile = (a: File, b: File): boolean =>
  a.name === b.name && a.size === b.size && a.lastModified === b.lastModified;

/** The slopes and the lamp that one photograph gave. */
function gave({ along, across, azimuth, elevation }: CouponReading): TemplateResult {
  const lamp = c('photo.lamp', {
    azimuth: Math.round(azimuth.value),
    elevation: Math.round(elevation.value),
    error: Math.max(1, Math.round(elevation.error)),
  });
  const slopes = c('photo.gave', { along: barred(along, 2, '°'), across: barred(across, 1, '°') });
  return html`<p class="note figures">${slopes}</p>
    <p class="note figures">${lamp}</p>`;
}

const row = (name: string, value: string): TemplateResult =>
  html`<div>
    <dt>${name}</dt>
    <dd class="figures">${value}</dd>
  </div>`;

const barred = ({ value, error }: Measured, digits: number, unit = ''): string =>
  `${formatNumber(value, digits)}\u00a0±\u00a0${formatNumber(error, digits)}${unit}`;
