// Reasons not to print the plate as it is, each in one sentence with a remedy, and how well its QR code can be read.
import type { PictureReport } from 'sillon';
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { words as english } from '../i18n/en/doubts.js';
import { say, t } from '../i18n/text.js';
import { doubtsOf, hasPicture, type Doubt, type Seen } from '../model/doubts.js';
import { leastSeen } from '../model/lamp.js';
import type { PlateResult } from '../model/state.js';
import { isOf } from '../model/result.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';
import { linked } from '../controls/linked.js';
import './scan-note.js';

type Cycles = PlateResult['toolpath']['cycles'];

/** Results by path, so that each is computed once although several sections show it. */
const answers = new WeakMap<Cycles, Promise<Seen>>();

const words = (doubt: Doubt, pictures: readonly PictureReport[] | undefined): string =>
  doubt === 'fine' || doubt === 'faint' ? say(english, `doubt.${doubt}`) : t(`lamp.weak.${doubt}`, leastSeen(pictures));

@customElement('sillon-doubts')
export class Doubts extends StudioElement {
  static override reads = ['plate', 'result', 'scan'] as const;

  static override styles = css`
    :host {
      display: block;
      min-height: 1px; /* of nothing, nobody could tell whether it is in sight */
    }
    p {
      margin-bottom: 10px;
    }
  `;

  override render(): TemplateResult {
    const { plate, result } = this.state;
    const finished = result?.measured === true && !result.coarse && isOf(result, plate) ? result : undefined;
    const seen = finished === undefined ? undefined : this.#seen(finished);
    const pictures = finished?.report.pictures;
    return html`${doubtsOf(plate, pictures, seen).map(
      (doubt) =>
        html`<p class="warning ${doubt}" role="status">
          ${icon('warn', 16)} <span>${linked(this.studio, words(doubt, pictures))}</span>
        </p>`,
    )}
    ${this.state.scan === undefined ? nothing : html`<sillon-scan-note .studio=${this.studio}></sillon-scan-note>`}`;
  }

  /** True while the element can be seen; nothing is computed otherwise. */
  #visible = false;
  readonly #watch = new IntersectionObserver((entries) => {
    this.#visible = entries.some(({ isIntersecting }) => isIntersecting);
    if (this.#visible) this.requestUpdate();
  });

  override connectedCallback(): void {
    super.connectedCallback();
    this.#watch.observe(this);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#watch.disconnect();
  }

  #asked: Cycles | undefined;
  #known: { of: Cycles; how: Seen } | undefined;

  async #look(result: PlateResult): Promise<Seen> {
    const [{ seenOf }, directions] = await Promise.all([
      import('./seen.js'),
      this.studio.services.directions(result.plate),
    ]);
    return seenOf(result, directions);
  }

  /** Measures of the finished plate. They are computed while somebody looks; the element is drawn again once they
   * are known. */
  #seen(result: PlateResult): Seen | undefined {
    const { cycles } = result.toolpath;
    if (this.#known?.of === cycles) return this.#known.how;
    if (!this.#visible || !hasPicture(result.plate) || this.#asked === cycles) return undefined;
    this.#asked = cycles;
    const answer = answers.get(cycles) ?? this.#look(result);
    answers.set(cycles, answer);
    void this.studio.attempt(async () => {
      this.#known = { of: cycles, how: await answer };
      this.requestUpdate();
    });
    return undefined;
  }
}
