// Printer, filament, layers, place; what it will take; the file.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { c } from '../i18n/calibrate.js';
import { findingText, startLines, warningText } from '../i18n/say-core.js';
import { words as problems } from '../i18n/en/problems.js';
import { words } from '../i18n/en/printer.js';
import { formatBytes, formatDuration, formatNumber, say, t } from '../i18n/text.js';
import { loadSpools } from './own-spools.js';
import { settings } from '../model/settings.js';
import { thicknessOf } from '../model/thickness.js';
import { advancedSettings } from '../controls/advanced.js';
import './bed.js';
import '../quality/doubts-list.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';
import { filamentField, printerField, swatchStyle } from './machine-fields.js';
import { panelStyle } from '../controls/panel-style.js';
import { settingField } from '../controls/setting-field.js';

@customElement('sillon-print-panel')
export class PrintPanel extends StudioElement {
  static override reads = ['plate', 'summary', 'check', 'result', 'advanced', 'problem', 'spools'] as const;

  static override styles = [
    ...StudioElement.styles,
    panelStyle,
    swatchStyle,
    css`
      dl {
        display: grid;
        grid-template-columns: 1fr 1fr;
        gap: 12px 16px;
      }
      dt {
        color: var(--soft);
        font-size: var(--note);
      }
      dd {
        font-size: var(--title);
        font-weight: 500;
        letter-spacing: -0.01em;
        font-variant-numeric: tabular-nums;
      }
      .before h3 {
        margin-bottom: 12px;
      }
      .warnings {
        display: grid;
        gap: 6px;
      }
      .warnings li {
        display: flex;
        gap: 8px;
        font-size: var(--note);
      }
      .warnings .icon {
        color: var(--accent);
        margin-top: 1px;
      }
      .take {
        position: sticky;
        bottom: 0;
        padding: 12px 20px;
        border-top: 1px solid var(--line);
        background: var(--surface);
      }
      .take button {
        width: 100%;
        min-height: 38px;
      }
    `,
  ];

  override connectedCallback(): void {
    super.connectedCallback();
    loadSpools(this.studio);
  }

  override render(): TemplateResult {
    return html`
      <section aria-labelledby="print-title">
        <h2 id="print-title">${t('section.print')}</h2>
        ${this.#summary()}
      </section>
      <section aria-label=${t('section.printer')}>
        ${printerField(this.studio)}
        <sillon-bed .studio=${this.studio}></sillon-bed>
        ${settingField(this.studio, 'print.place')} ${settingField(this.studio, 'print.rotate')}
        ${settingField(this.studio, 'print.mirror')} ${settingField(this.studio, 'print.showSide')}
        ${settingField(this.studio, 'print.brim')} ${settingField(this.studio, 'print.copies')}
      </section>
      <section aria-label=${t('section.filament')}>
        ${filamentField(this.studio)}
        <div class="buttons">
          <button
            type="button"
            @click=${() => {
              this.studio.show('spools');
            }}
          >
            ${c('spools.yours')}
          </button>
          <button
            type="button"
            @click=${() => {
              this.studio.show('calibrate');
            }}
          >
            ${icon('tune', 16)} ${t('verb.calibrate')}
          </button>
        </div>
        ${settingField(this.studio, 'printer.nozzleTemperature')} ${settingField(this.studio, 'printer.bedTemperature')}
        ${settingField(this.studio, 'printer.speed')}
      </section>
      <section aria-label=${t('section.basics')}>
        ${settingField(this.studio, 'print.layers')} ${settingField(this.studio, 'print.base')}
        ${settingField(this.studio, 'print.rim')}
        ${this.state.plate.print.rim > 0 ? settingField(this.studio, 'print.rimWidth') : nothing}
        ${settingField(this.studio, 'print.layerHeight')}
      </section>
      ${advancedSettings(
        this.studio,
        settings.filter(({ section, advanced }) => section !== 'toolpath' && advanced),
      )}
      <div class="take">
        <button
          type="button"
          class="main"
          @click=${() => {
            void this.studio.save('gcode');
          }}
        >
          ${icon('download')} ${t('keys.gcode')}
        </button>
      </div>
    `;
  }

  #summary(): TemplateResult {
    const { summary, plate, result } = this.state;
    const warnings = summary === undefined ? [] : [...(result?.report.warnings ?? []), ...summary.warnings];
    const tall = thicknessOf(plate) + plate.print.rim * plate.print.layerHeight;
    const value = (label: string, text: string): TemplateResult =>
      html`<div>
        <dt>${label}</dt>
        <dd>${text}</dd>
      </div>`;
    const figure = (make: (known: NonNullable<typeof summary>) => string): string =>
      summary === undefined ? '–' : make(summary);
    return html`<dl>
        ${value(
          t('summary.time'),
          figure(({ seconds }) => formatDuration(seconds)),
        )}
        ${value(
          t('summary.weight'),
          figure(({ filamentGrams }) => t('summary.grams', { g: formatNumber(filamentGrams, 1) })),
        )}
        ${value(
          say(words, 'summary.filament'),
          figure(({ filamentMm }) => t('summary.metres', { m: formatNumber(filamentMm / 1000, 2) })),
        )}
        ${value(say(words, 'summary.height'), `${formatNumber(tall)} mm`)}
      </dl>
      <p class="note">
        ${say(words, 'summary.estimate')}
        ${summary === undefined ? '' : say(words, 'summary.size', { size: formatBytes(summary.bytes) })}
      </p>
      <div class="before">
        ${summary === undefined ? nothing : html`<h3>${say(words, 'summary.warnings')}</h3>`}
        <sillon-doubts .studio=${this.studio}></sillon-doubts>
        <ul class="warnings">
          ${warnings.map((warning) => html`<li>${icon('warn', 16)}<span>${warningText(warning)}</span></li>`)}
        </ul>
      </div>
      ${this.#findings()} ${this.#startLines()}`;
  }

  /** What reading the file back as a printer would has found. */
  #findings(): TemplateResult | typeof nothing {
    const { check } = this.state;
    if (check === undefined) return nothing;
    if (check.findings.length === 0) return html`<p class="note">${say(problems, 'check.good')}</p>`;
    return html`<h3>${say(problems, check.errors > 0 ? 'check.errors' : 'check.warnings')}</h3>
      <ul class="warnings">
        ${check.findings.map(
          (finding) => html`<li title=${finding.message}>${icon('warn', 16)}<span>${findingText(finding)}</span></li>`,
        )}
      </ul>`;
  }

  /** Faults of the start block, each with the line that has it. */
  #startLines(): TemplateResult | typeof nothing {
    const { summary, problem, plate } = this.state;
    const lines = startLines(summary?.warnings ?? [], problem, plate.printer.startGcode);
    if (lines.length === 0) return nothing;
    return html`<h3>${t('setting.printer.startGcode')}</h3>
      <ul class="warnings">
        ${lines.map(
          ({ line, code, what }) =>
            html`<li>
              ${icon('warn', 16)}<span>${say(problems, 'check.line', { line })} <code>${code}</code><br />${what}</span>
            </li>`,
        )}
      </ul>`;
  }
}
