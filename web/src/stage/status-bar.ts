// The line below the plate: its size, cost and time, and the progress of the engine.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { progressWords } from '../i18n/say.js';
import { formatDuration, formatNumber, t } from '../i18n/text.js';
import { isOf } from '../model/result.js';
import { StudioElement } from '../controls/element.js';
import { inUnits } from '../shape/units.js';
import { pageOf } from '../model/plate.js';
import { button } from '../controls/button.js';

/** Shortest job that is announced to screen readers [ms]; a shorter one ends before it could be heard. */
const worthSaying = 1000;

@customElement('sillon-status')
export class StatusBar extends StudioElement {
  static override reads = ['plate', 'result', 'summary', 'progress', 'reading', 'cancelled', 'live', 'units'] as const;

  static override styles = css`
    :host {
      position: relative;
      display: flex;
      align-items: center;
      gap: 0 18px;
      min-height: 40px;
      padding: 0 6px 0 14px;
      border-top: 1px solid var(--line);
      background: var(--surface);
      font-size: var(--note);
      white-space: nowrap;
    }
    .said {
      position: absolute;
      clip-path: inset(50%);
    }
    .figures {
      display: flex;
      flex: 1;
      flex-wrap: wrap;
      gap: 0 16px;
      min-width: 0;
      overflow: hidden;
      color: var(--soft);
    }
    .figures b {
      color: var(--ink);
      font-weight: 500;
    }
    .job {
      display: flex;
      flex: 1;
      align-items: center;
      gap: 12px;
      min-width: 0;
    }
    .job .stage {
      overflow: hidden;
      text-overflow: ellipsis;
    }
    .job .share {
      color: var(--soft);
      font-variant-numeric: tabular-nums;
    }
    .bar {
      position: absolute;
      inset: -2px 0 auto;
      height: 2px;
      background: var(--line);
    }
    .bar div {
      height: 100%;
      width: calc(100% * var(--share));
      background: var(--accent);
    }
    .job button {
      min-height: max(28px, var(--control));
      font-size: var(--note);
    }
    @media (max-width: 720px) {
      :host {
        padding-left: 10px;
      }
    }
    /* A low window needs the row: figures stand in the bench's corner, beside the plate. */
    @media (max-height: 479px) {
      :host {
        position: absolute;
        left: 8px;
        bottom: 8px;
        z-index: 1;
        width: max-content;
        max-width: 7.5rem;
        min-height: 28px;
        padding: 4px 8px;
        border: 1px solid var(--line);
        border-radius: var(--radius-large);
        overflow: hidden;
      }
      .figures {
        flex-direction: column;
      }
      .job {
        gap: 6px;
      }
      .job .stage,
      .rest {
        display: none;
      }
      .job button {
        min-height: 28px;
        padding: 0 6px;
      }
    }
    @container (width < 220px) {
      :host {
        display: none;
      }
    }
    /* Words go before figures are cut off. The container is the stage, which is as wide: Chromium gives no boxes to what
         comes later into an element that measures itself. */
    @container (max-width: 600px) {
      .rest {
        display: none;
      }
      .figures {
        gap: 0 10px;
      }
    }
  `;

  /** Announcement for screen readers: the engine works, the plate is ready, or the job was cancelled. */
  @state() private said = '';
  #busyTimer: ReturnType<typeof setTimeout> | undefined;
  #busy = false;

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearTimeout(this.#busyTimer);
  }

  protected override willUpdate(): void {
    const { progress, cancelled, summary } = this.state;
    if (progress !== undefined && !this.#busy) {
      this.#busy = true;
      this.#busyTimer = setTimeout(() => {
        const { progress: now } = this.state;
        if (now !== undefined) this.said = progressWords(now).job;
      }, worthSaying);
    } else if (progress === undefined && (cancelled || summary !== undefined)) {
      clearTimeout(this.#busyTimer);
      if (!this.#busy) return;
      this.#busy = false;
      this.said = cancelled || summary === undefined ? t('job.cancelled') : this.#ready(summary);
    }
  }

  #ready({ seconds, filamentGrams }: NonNullable<this['state']['summary']>): string {
    return t('job.ready', { time: formatDuration(seconds), g: formatNumber(filamentGrams, 1) });
  }

  override render(): TemplateResult {
    const { progress, reading } = this.state;
    return html`<p class="said" role="status">${this.said}</p>
      ${
        reading !== undefined
          ? this.#job(t('job.reading', { name: reading.name }), reading.fraction, '', reading.cancel)
          : progress === undefined
            ? this.#figures()
            : this.#progress(progress)
      }`;
  }

  #progress(progress: NonNullable<this['state']['progress']>): TemplateResult {
    const { job, stage, left } = progressWords(progress);
    return this.#job(stage === '' ? job : stage, progress.fraction, left, () => this.studio.services.cancel());
  }

  /** Returns the progress of a job, with a button that cancels it. */
  #job(what: string, fraction: number, left: string, cancel: () => void): TemplateResult {
    const percent = Math.floor(100 * fraction);
    return html`<div
        class="bar"
        role="progressbar"
        aria-label=${what}
        aria-valuemin="0"
        aria-valuemax="100"
        aria-valuenow=${percent}
      >
        <div .style=${`--share: ${fraction}`}></div>
      </div>
      <div class="job">
        <span class="stage">${what}</span>
        <span class="share">${t('progress.percent', { percent })}</span><span class="share rest">${left}</span>
        ${button('', t('verb.cancel'), cancel)}
      </div>`;
  }

  /** Returns the size of the plate and, once known, length, time and weight of its print. */
  #figures(): TemplateResult {
    const { plate, result, cancelled, units } = this.state;
    const size = pageOf(plate).map((length) => formatNumber(inUnits(length, units), units === 'in' ? 2 : 1));
    // Results of another plate, such as the last one that could be made, would be mistaken for this plate's.
    const own = result !== undefined && isOf(result, plate);
    const length = own ? result.report.lengthMm : undefined;
    const summary = own ? this.state.summary : undefined;
    return html`<div class="figures">
      ${
        cancelled
          ? html`<span>${t('job.cancelled')}</span>
              ${button('link', t('verb.retry'), () => this.studio.services.retry())}`
          : html`<b>${size.join(' × ')} ${units}</b> ${
                length === undefined
                  ? nothing
                  : html`<span class="rest"
                      >${t('summary.length')} <b>${t('summary.metres', { m: formatNumber(length / 1000, 1) })}</b></span
                    >`
              }
              ${
                summary === undefined
                  ? nothing
                  : html`<span
                        ><span class="rest">${t('summary.time')} </span><b>${formatDuration(summary.seconds)}</b></span
                      >
                      <span
                        ><span class="rest">${t('summary.weight')} </span
                        ><b>${t('summary.grams', { g: formatNumber(summary.filamentGrams, 1) })}</b></span
                      >`
              }`
      }
    </div>`;
  }
}
