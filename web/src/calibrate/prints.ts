// The calibration prints: what each finds and costs, its file, what to see on it, and the result to type in.
import type { Calibration, CalibrationKind, CalibrationRequest } from 'sillon';
import { html, nothing, type TemplateResult } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { c } from '../i18n/calibrate.js';
import { wholeWords } from '../i18n/say-problem.js';
import { warningText } from '../i18n/say-core.js';
import { formatDuration, formatNumber, t } from '../i18n/text.js';
import { kinds } from './model.js';
import { viewLook } from '../model/filaments.js';
import type { Plate } from '../model/plate.js';
import { isAbort, problemOf, type Problem } from '../model/problem.js';
import { answerFields, type Found } from './answer.js';
import { drawing } from './drawings.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';
import { choiceCards } from '../controls/cards.js';
import { printStyle } from './style.js';
import type { Shown } from '../studio/shown.js';
import { gcodeMark, isPacked, type Studio } from '../studio/studio.js';
import { button } from '../controls/button.js';

const pictureSide = 720; // [pixels]
const rest = 250; // [ms] after a change before the prints are made again

type Made = { calibration: Calibration } | { problem: Problem };

@customElement('sillon-calibrate-prints')
export class CalibratePrints extends StudioElement {
  static override reads = ['plate'] as const;
  static override styles = [choiceCards, printStyle];

  @state() private kind: CalibrationKind = 'coupon';
  @state() private made: ReadonlyMap<CalibrationKind, Made> = new Map<CalibrationKind, Made>();
  @state() private found: Found = { value: undefined, constant: false, low: undefined, high: undefined };
  /** Picture of the chosen print, with the print that it shows. */
  @state() private picture: { of: Calibration; url: string } | undefined;
  readonly #fresh = new Set<CalibrationKind>();
  #job: AbortController | undefined;
  #timer: ReturnType<typeof setTimeout> | undefined;

  override connectedCallback(): void {
    super.connectedCallback();
    void this.#make();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearTimeout(this.#timer);
    this.#job?.abort();
    this.#forgetPicture();
  }

  protected override onState({ plate }: Readonly<Shown>, { plate: before }: Readonly<Shown>): void {
    const same = (['printer', 'print', 'toolpath', 'pictures', 'spool'] as const).every(
      (part) => plate[part] === before[part],
    );
    if (same) return;
    this.#fresh.clear();
    this.#job?.abort();
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#make(), rest);
  }

  /** Makes the prints that are out of date: the chosen one first, with its picture, then the others for their
   * figures. */
  async #make(): Promise<void> {
    this.#job?.abort();
    const job = new AbortController();
    this.#job = job;
    const { plate } = this.state;
    const order = [this.kind, ...kinds.filter((kind) => kind !== this.kind && !this.#fresh.has(kind))];
    for (const kind of order) {
      await this.#makeOne(kind, plate, job.signal);
      if (job.signal.aborted) return;
    }
  }

  async #makeOne(kind: CalibrationKind, plate: Plate, signal: AbortSignal): Promise<void> {
    let made: Made;
    try {
      const engine = await this.studio.services.engine();
      const calibration = await engine.calibrate(kind, calibrationOf(plate, kind === this.kind ? pictureSide : 0), {
        signal,
      });
      made = { calibration };
    } catch (error) {
      if (isAbort(error) || signal.aborted) return;
      made = { problem: problemOf(error) };
    }
    if (signal.aborted) return;
    this.#fresh.add(kind);
    this.made = new Map([...this.made, [kind, made]]);
    if (kind === this.kind) this.#showPicture(made);
  }

  #showPicture(made: Made): void {
    this.#forgetPicture();
    if ('problem' in made || made.calibration.picture === undefined) return;
    this.picture = { of: made.calibration, url: URL.createObjectURL(made.calibration.picture) };
  }

  #forgetPicture(): void {
    if (this.picture !== undefined) URL.revokeObjectURL(this.picture.url);
    this.picture = undefined;
  }

  #choose(kind: CalibrationKind): void {
    this.kind = kind;
    this.found = { value: undefined, constant: false, low: undefined, high: undefined };
    this.#forgetPicture();
    void this.#make();
    void this.updateComplete.then(() => {
      if (!matchMedia('(max-width: 860px)').matches) return;
      this.renderRoot
        .querySelector('.about-it')
        ?.scrollIntoView({ block: 'start', behavior: this.studio.calm() ? 'auto' : 'smooth' });
    });
  }

  override render(): TemplateResult {
    return html`<p class="what">${c('what')}</p>
      <div class="both">
        <div class="kinds" role="radiogroup" aria-label=${c('kinds')}>${kinds.map((kind) => this.#card(kind))}</div>
        ${this.#about()}
      </div>`;
  }

  #card(kind: CalibrationKind): TemplateResult {
    const made = this.made.get(kind);
    const cost = made === undefined ? '–' : 'problem' in made ? c('cannot') : costText(made.calibration);
    return html`<label class="card board">
      <input
        type="radio"
        name="kind"
        value=${kind}
        .checked=${kind === this.kind}
        @change=${() => this.#choose(kind)}
      />
      ${drawing(kind)}
      <span class="words"><b>${c(`kind.${kind}`)}</b><span>${c(`finds.${kind}`)}</span></span>
      <span class="cost figures">${cost}</span>
    </label>`;
  }

  #about(): TemplateResult {
    const { kind } = this;
    const made = this.made.get(kind);
    const name = c(`kind.${kind}`);
    return html`<section class="about-it" aria-label=${name}>
      <h2>${name}</h2>
      <p>${c(`finds.${kind}`)}</p>
      ${made !== undefined && 'problem' in made ? this.#problem(made.problem) : this.#shown(name, made?.calibration)}
    </section>`;
  }

  #problem(problem: Problem): TemplateResult {
    const { message, hint } = wholeWords(problem);
    return html`<p class="problem" role="alert">${icon('warn', 16)} <span>${message} ${hint}</span></p>`;
  }

  #shown(name: string, calibration: Calibration | undefined): TemplateResult {
    const { kind } = this;
    return html`<figure>
        ${
          this.picture === undefined
            ? html`<span class="blank">${drawing(kind)}</span>`
            : html`<img src=${this.picture.url} alt=${c('picture', { name })} />`
        }
        <figcaption class="note">${c('rendered')}</figcaption>
      </figure>
      <div class="take">
        ${button(
          { look: 'main', disabled: calibration === undefined },
          html`${icon('download')} ${t('keys.gcode')}`,
          this.#save,
        )}
        <span class="note figures">${calibration === undefined ? '' : costText(calibration)}</span>
      </div>
      ${(calibration?.summary.warnings ?? []).map(
        (warning) => html`<p class="note warned">${icon('warn', 14)} <span>${warningText(warning)}</span></p>`,
      )}
      <h3>${c('look')}</h3>
      <p>${c(`see.${kind}`)}</p>
      ${
        kind === 'coupon'
          ? button('', html`${icon('camera', 16)} ${c('toPhoto')}`, () => {
              this.dispatchEvent(new CustomEvent('photograph'));
            })
          : nothing
      }
      <h3>${c('best')}</h3>
      ${answerFields(this.studio, kind, calibration, this.found, (change) => {
        this.found = { ...this.found, ...change };
      })}`;
  }

  #save = (): void => {
    const { kind } = this;
    this.studio.whenReviewed(() => void saveCalibration(this.studio, kind));
  };
}

/** The engine's request for a calibration print. @param side  of its picture [pixels]; 0: no picture */
export function calibrationOf(plate: Plate, side: number): CalibrationRequest {
  const { printer, print, toolpath } = plate;
  // Calibration prints are seen from above, whichever side the plate shows.
  const filament = viewLook({ ...plate, print: { ...print, showSide: 'up' } });
  return { printer, print, toolpath, filament, pictureSide: side };
}

export const costText = ({ summary }: Calibration): string =>
  c('cost', {
    time: formatDuration(summary.seconds),
    grams: c('grams', { g: formatNumber(summary.filamentGrams, 1) }),
  });

/** Saves a calibration print for the plate's present printer. */
export async function saveCalibration(studio: Studio, kind: CalibrationKind): Promise<void> {
  await studio.attempt(async () => {
    const { plate } = studio.store.state;
    const engine = await studio.services.engine();
    const { blob, summary } = await engine.calibrate(kind, calibrationOf(plate, 0));
    const packed = isPacked('gcode', plate);
    const name = `${kind}${gcodeMark(plate, summary.seconds)}${packed ? '.gcode.3mf' : '.gcode'}`;
    studio.deliver(packed ? await engine.packGcode(blob) : blob, name);
    studio.notify(t('export.done', { name }));
  });
}
