// Section of the quality: one sentence per measure, a histogram of the beads' widths, and places worth a look.
import { css, html, nothing, svg, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { layerNameIn } from '../i18n/layers.js';
import { warningText } from '../i18n/say-core.js';
import { threadsWords } from '../i18n/say-threads.js';
import { verdictText } from '../i18n/say-verdict.js';
import { words } from '../i18n/en/quality.js';
import { formatNumber, say, t } from '../i18n/text.js';
import { warnedLayers } from '../model/warned.js';
import { judgedFile } from '../model/lamp.js';
import { orderVerdicts, verdictsOf, type Verdict } from '../model/verdicts.js';
import { widthHistogram } from '../controls/histogram.js';
import type { Mark } from '../model/view.js';
import './doubts-list.js';
import { StudioElement } from '../controls/element.js';
import { icon, type IconName } from '../controls/icons.js';
import { linked } from '../controls/linked.js';
import { panelStyle } from '../controls/panel-style.js';
import { button } from '../controls/button.js';

const icons: Record<Verdict['level'], IconName> = { good: 'check', fair: 'info', poor: 'warn' };
const mostListed = 60;

/** Kinds of places that each measure refers to. */
const placesOf: Partial<Record<Verdict['measure'], readonly Mark['kind'][]>> = {
  path: ['lost'],
  coverage: ['gap', 'lost'],
  uTurns: ['turn'],
  widths: ['narrow', 'wide'],
  lost: ['lost', 'kept'],
};

@customElement('sillon-quality-panel')
export class QualityPanel extends StudioElement {
  static override reads = ['plate', 'result', 'check', 'progress', 'marks', 'mark', 'engine'] as const;

  static override styles = [
    panelStyle,
    css`
      .verdicts {
        display: grid;
        gap: 14px;
      }
      .verdicts li {
        display: grid;
        grid-template-columns: auto 1fr auto;
        gap: 0 10px;
      }
      .verdicts .icon {
        grid-row: span 2;
        margin-top: 1px;
      }
      .verdicts b {
        overflow-wrap: anywhere;
      }
      .verdicts p {
        grid-column: 2 / -1;
        color: var(--soft);
      }
      .verdicts .good .icon {
        color: var(--good);
      }
      .verdicts .fair .icon {
        color: var(--accent);
      }
      .verdicts .poor :is(.icon, .level) {
        color: var(--bad);
      }
      .histogram {
        display: block;
        width: 100%;
        height: 110px;
        overflow: visible;
      }
      .histogram .bar {
        fill: var(--accent);
      }
      .histogram .axis {
        stroke: var(--edge);
      }
      .histogram .limit {
        stroke: var(--ink);
        stroke-dasharray: 2 3;
      }
      .histogram text {
        fill: var(--soft);
        font-size: 10px;
        font-variant-numeric: tabular-nums;
      }
      .places {
        display: flex;
        align-items: center;
        justify-content: space-between;
        gap: 8px;
      }
      .list {
        display: grid;
        gap: 2px;
        max-height: 260px;
        margin: 0 -8px;
        overflow: auto;
      }
      .list button {
        width: 100%;
        justify-content: space-between;
        padding: 0 8px;
        font-weight: 400;
      }
    `,
  ];

  override render(): TemplateResult {
    const { result, check, engine } = this.state;
    const verdicts = result === undefined || !result.measured ? [] : verdictsOf(result.report);
    const delay = check?.neighbourDelay ?? undefined; // known once the file has been written
    if (verdicts.length > 0 && delay !== undefined) verdicts.push(...orderVerdicts(delay));
    return html`
      <section aria-labelledby="quality-title">
        <h2 id="quality-title">${t('section.quality')}</h2>
        <sillon-doubts .studio=${this.studio}></sillon-doubts>
        ${
          verdicts.length === 0
            ? html`<p class="note">
                ${say(words, this.state.progress === undefined ? 'measure.none' : 'measure.waiting')}
              </p>`
            : html`<ul class="verdicts">
                ${verdicts.map(
                  (verdict) =>
                    html`<li class=${verdict.level}>
                      ${icon(icons[verdict.level], 18)}
                      <b>${this.#name(verdict, verdicts)}</b
                      ><span class="note level">${say(words, `level.${verdict.level}`)}</span>
                      <p>${linked(this.studio, verdictText(verdict))} ${this.#look(verdict)}</p>
                    </li>`,
                )}
              </ul>`
        }
      </section>
      ${this.#layers()} ${result === undefined ? nothing : this.#histogram()} ${this.#places()}
      ${
        engine === undefined
          ? nothing
          : html`<section>
              <p class="note">
                ${threadsWords(engine, this.studio.threads).count}. ${threadsWords(engine, this.studio.threads).why}
              </p>
            </section>`
      }
    `;
  }

  /** Layers that are not visible, or not as they should be. */
  #layers(): TemplateResult | typeof nothing {
    const warned = [...warnedLayers(this.state)];
    if (warned.length === 0) return nothing;
    return html`<section aria-labelledby="layers-title">
      <h3 id="layers-title">${say(words, 'quality.layers')}</h3>
      <ul class="verdicts">
        ${warned.map(
          ([layer, warnings]) =>
            html`<li class="fair">
              ${icon('warn', 18)}
              <b
                >${button('link', layerNameIn(this.state.plate.layers, layer), () => {
                  this.studio.store.set({ layer: layer.id, cropping: false, tool: 'pan' });
                  this.studio.setPanel('layers');
                })}</b
              >
              ${warnings.map((warning) => html`<p>${linked(this.studio, warningText(warning))}</p>`)}
            </li>`,
        )}
      </ul>
    </section>`;
  }

  /** Name of a measure; where several pictures have it, also the file that it judges. */
  #name(verdict: Verdict, verdicts: readonly Verdict[]): string {
    const label = say(words, `measure.${verdict.measure}`);
    const same = verdicts.filter(({ measure }) => measure === verdict.measure);
    const { result } = this.state;
    if (same.length === 1 || result === undefined || verdict.measure !== 'picture') return label;
    const { plate, report } = result;
    const file = judgedFile(plate, report.pictures ?? [], same.indexOf(verdict));
    return t('setting.value', { label, value: file?.name ?? '' });
  }

  /** Makes the button that shows the first place to which the verdict refers. */
  #look({ measure, level }: Verdict): TemplateResult | typeof nothing {
    const kinds = placesOf[measure] ?? [];
    const at = this.state.marks.findIndex(({ kind }) => kinds.includes(kind));
    const good = (measure === 'lost' || measure === 'path') && level === 'good';
    if (at < 0 || (good && this.state.marks[at]?.kind !== 'kept')) return nothing;
    return button(
      { look: 'link', label: `${say(words, `measure.${measure}`)}: ${say(words, 'mark.look')}` },
      say(words, 'mark.look'),
      () => this.studio.lookAtMark(at),
    );
  }

  #histogram(): TemplateResult | typeof nothing {
    const { result } = this.state;
    if (result === undefined) return nothing;
    const { bars, low, high } = widthHistogram(result.toolpath);
    const top = Math.max(...bars, 1e-9);
    const step = 300 / bars.length;
    const { spacing } = result.toolpath;
    const at = ((spacing - low) / (high - low)) * 300;
    return html`<section aria-labelledby="widths-title">
      <h3 id="widths-title">${say(words, 'histogram.widths')}</h3>
      <figure>
        <svg class="histogram" viewBox="0 0 300 110" role="img" aria-labelledby="widths-title">
          ${bars.map(
            (bar, k) =>
              svg`<rect class="bar" x=${k * step + 0.5} width=${Math.max(0.5, step - 1)} y=${88 - (84 * bar) / top}
                height=${(84 * bar) / top} />`,
          )}
          <line class="axis" x1="0" x2="300" y1="88.5" y2="88.5" />
          <line class="limit" x1=${at} x2=${at} y1="0" y2="88" />
          <text x="0" y="103">${formatNumber(low)} mm</text>
          <text x="300" y="103" text-anchor="end">${formatNumber(high)} mm</text>
          <text x=${at} y="103" text-anchor="middle">${formatNumber(spacing)}</text>
        </svg>
      </figure>
    </section>`;
  }

  #places(): TemplateResult | typeof nothing {
    const { marks, mark } = this.state;
    if (marks.length === 0) return nothing;
    const step = (by: number): void =>
      this.studio.lookAtMark((mark + by + marks.length + (mark < 0 && by < 0 ? 1 : 0)) % marks.length);
    return html`<section aria-labelledby="places-title">
      <div class="places">
        <h3 id="places-title">${say(words, 'mark.count', { n: marks.length })}</h3>
        <span class="buttons">
          ${button({ look: 'square', label: say(words, 'mark.previous') }, icon('previous'), () => step(-1))}
          ${button({ look: 'square', label: say(words, 'mark.next') }, icon('next'), () => step(1))}
        </span>
      </div>
      <ul class="list">
        ${marks
          .slice(0, mostListed)
          .map(
            ({ kind, x, y }, k) =>
              html`<li>
                ${button(
                  { look: 'plain', pressed: k === mark },
                  html`<span>${say(words, `mark.${kind}`)}</span
                    ><span class="note figures">${formatNumber(x, 1)}; ${formatNumber(y, 1)} mm</span>`,
                  () => this.studio.lookAtMark(k),
                )}
              </li>`,
          )}
      </ul>
    </section>`;
  }
}
