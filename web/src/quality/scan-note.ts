// Note on the lamps under which the plate's QR code can be read or, where there are none, on what helps.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { words } from '../i18n/en/doubts.js';
import { language, say } from '../i18n/text.js';
import { isOf } from '../model/result.js';
import { stretches } from './stretches.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';

const told = ([from, to]: [number, number]): string => (from === to ? `${from}°` : `${from}–${to}°`);

@customElement('sillon-scan-note')
export class ScanNote extends StudioElement {
  static override reads = ['scan', 'plate'] as const;

  static override styles = css`
    p {
      display: grid;
      grid-template-columns: auto 1fr;
      gap: 8px;
      margin: 0 0 12px;
      color: var(--soft);
      font-size: var(--note);
    }
    .good .icon {
      color: var(--good);
    }
    .poor .icon {
      color: var(--bad);
    }
  `;

  override render(): TemplateResult | typeof nothing {
    const { scan, plate } = this.state;
    if (scan === undefined || !isOf(scan, plate)) return nothing;
    const lamps = stretches(scan.azimuths).map(told);
    const where = new Intl.ListFormat(language(), { type: 'disjunction' }).format(lamps);
    return html`<p class=${lamps.length > 0 ? 'good' : 'poor'} role="status">
      ${icon(lamps.length > 0 ? 'check' : 'warn', 16)}
      <span>${lamps.length > 0 ? say(words, 'scan.reads', { where }) : say(words, 'scan.none')}</span>
    </p>`;
  }
}
