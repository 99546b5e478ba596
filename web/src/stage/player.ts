// Plays the print by showing a growing share of the path.
import { css, html, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { live } from 'lit/directives/live.js';
import { formatNumber, t } from '../i18n/text.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';
import { button } from '../controls/button.js';

const duration = 14_000; // [ms] for a whole print

@customElement('sillon-player')
export class Player extends StudioElement {
  static override reads = ['played', 'playing', 'result'] as const;

  static override styles = css`
    :host {
      display: grid;
      grid-template-columns: auto 1fr auto;
      align-items: center;
      gap: 10px;
      padding: 4px 12px 4px 4px;
    }
    output {
      min-width: 5ch;
      text-align: right;
      color: var(--soft);
      font-size: var(--note);
      font-variant-numeric: tabular-nums;
      white-space: nowrap;
    }
  `;

  #before = 0;

  override render(): TemplateResult {
    const { played, playing, result } = this.state;
    const length = result?.report.lengthMm;
    const percent = t('progress.percent', { percent: Math.floor(100 * played) });
    const label = t(playing ? 'verb.pause' : 'verb.play');
    return html`
      ${button({ look: 'plain square', name: label }, icon(playing ? 'pause' : 'play'), this.#toggle)}
      <input
        type="range"
        min="0"
        max="1"
        step="0.001"
        aria-label=${t('view.progress')}
        aria-valuetext=${percent}
        .value=${live(String(played))}
        .style=${`--share: ${played}`}
        @input=${(event: Event) =>
          this.studio.store.set({ played: Number((event.currentTarget as HTMLInputElement).value), playing: false })}
      />
      <output
        >${length === undefined ? percent : t('summary.metres', { m: formatNumber((length * played) / 1000, 1) })}</output
      >
    `;
  }

  #toggle = (): void => this.studio.togglePlay();

  protected override onState(state: this['state'], before: this['state']): void {
    if (state.playing && !before.playing) {
      this.#before = performance.now();
      requestAnimationFrame(this.#tick);
    }
  }

  #tick = (now: number): void => {
    if (!this.state.playing || !this.isConnected) return;
    const played = Math.min(1, this.state.played + (now - this.#before) / duration);
    this.#before = now;
    this.studio.store.set({ played, playing: played < 1 });
    if (played < 1) requestAnimationFrame(this.#tick);
  };
}
