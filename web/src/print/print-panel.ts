// Section of the print: printer, filament, layers and path, with what the print will take, warnings, and the file.
import type { GcodeWarning } from 'sillon';
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { c } from '../i18n/calibrate.js';
import { findingText, startLines, warningText } from '../i18n/say-core.js';
import { words as presets } from '../i18n/en/presets.js';
import { words as problems } from '../i18n/en/problems.js';
import { words } from '../i18n/en/printer.js';
import { formatBytes, formatDuration, formatNumber, say, t } from '../i18n/text.js';
import { loadSpools } from './own-spools.js';
import {
  adviceFor,
  nozzleAdvice,
  qualities,
  qualityOf,
  settingOf,
  withNozzle,
  withQuality,
  withValue,
  type Quality,
  type Setting,
} from '../model/settings.js';
import { thicknessOf } from '../model/thickness.js';
import { advancedSettings } from '../controls/advanced.js';
import './bed.js';
import '../quality/doubts-list.js';
import { StudioElement } from '../controls/element.js';
import { cards, segments } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import { linked } from '../controls/linked.js';
import { filamentField, printerField, swatchStyle } from './machine-fields.js';
import { panelStyle } from '../controls/panel-style.js';
import { settingField } from '../controls/setting-field.js';
import { thicknessField } from '../shape/thickness-field.js';
import { settingGroups, type GroupName } from '../model/setting-groups.js';
import { button } from '../controls/button.js';

const mostSeeds = 1e6; // seeds to choose from at random

@customElement('sillon-print-panel')
export class PrintPanel extends StudioElement {
  static override reads = ['plate', 'summary', 'check', 'result', 'advanced', 'problem', 'spools', 'units'] as const;

  static override styles = [
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
      .suggestion {
        display: flex;
        flex-wrap: wrap;
        gap: 4px 8px;
        align-items: center;
      }
      .rows .rows {
        padding-left: 22px; /* below the group's name */
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
        ${printerField(this.studio)} ${this.#nozzle()}
        <sillon-bed .studio=${this.studio}></sillon-bed>
      </section>
      <section aria-label=${t('section.filament')}>
        ${filamentField(this.studio)}
        <div class="buttons">
          ${button('', c('spools.yours'), this.studio.opens('spools'))}
          ${button('', html`${icon('tune', 16)} ${t('verb.calibrate')}`, this.studio.opens('calibrate'))}
        </div>
        ${settingField(this.studio, 'printer.nozzleTemperature')} ${settingField(this.studio, 'printer.bedTemperature')}
        ${settingField(this.studio, 'printer.speed')}
      </section>
      <section aria-label=${t('app.plate')}>
        ${thicknessField(this.studio)} ${settingField(this.studio, 'print.layerHeight')}
        ${settingField(this.studio, 'print.layers')} ${settingField(this.studio, 'print.base')} ${this.#lines()}
        ${this.#quality()}
      </section>
      ${advancedSettings(
        this.studio,
        settingGroups.map(({ name, rows }) => ({
          label: say(words, `group.${name}`),
          rows: this.#wanted(rows),
          more: this.#more(name),
        })),
      )}
      ${this.#before()}
      <div class="take">
        ${button('main', html`${icon('download')} ${t('keys.gcode')}`, () => void this.studio.save('gcode'))}
      </div>
    `;
  }

  #nozzle(): TemplateResult {
    return segments({
      id: 'printer-nozzle',
      label: t('setting.printer.nozzle'),
      value: String(this.state.plate.printer.nozzle),
      options: nozzleAdvice.map(({ nozzle }) => ({ value: String(nozzle), label: formatNumber(nozzle, 2) })),
      onChoose: (value) => this.studio.change((now) => withNozzle(now, Number(value))),
    });
  }

  /** Makes the fields for the beads: their width, and their course along the outline. */
  #lines(): TemplateResult {
    const { toolpath, printer } = this.state.plate;
    const { nozzle, spacing } = adviceFor(printer.nozzle);
    const [, usual] = spacing;
    return html`${settingField(this.studio, 'toolpath.spacing')}
    ${
      usual === toolpath.spacing
        ? nothing
        : html`<p class="note suggestion">
            ${t('setting.suggested', { nozzle, value: usual })}
            ${button('link', t('verb.use'), () =>
              this.studio.change((now) => withValue(now, settingOf('toolpath.spacing'), usual)),
            )}
          </p>`
    }
    ${settingField(this.studio, 'toolpath.perimeterMode')}
    ${toolpath.perimeterMode === 'count' ? settingField(this.studio, 'toolpath.perimeters') : nothing}`;
  }

  #quality(): TemplateResult {
    const quality = qualityOf(this.state.plate.toolpath);
    return html`<h3>${say(presets, 'preset.title')}</h3>
      ${cards<Quality>({
        id: 'quality',
        label: say(presets, 'preset.title'),
        value: quality,
        options: (Object.keys(qualities) as Quality[]).map((value) => ({
          value,
          label: say(presets, `preset.${value}`),
          picture: `presets/${value}.webp`,
        })),
        onChoose: (value) => this.studio.change((now) => withQuality(now, value)),
      })}
      <p class="note">
        ${quality === undefined ? say(presets, 'preset.custom') : say(presets, `preset.${quality}.help`)}
      </p>`;
  }

  /** The rows without fields that have no effect now. */
  #wanted(rows: readonly Setting[]): readonly Setting[] {
    const { rim } = this.state.plate.print;
    return rim > 0 ? rows : rows.filter(({ id }) => id !== 'print.rimWidth');
  }

  /** Elements after the fields of a group. */
  #more(name: GroupName): TemplateResult | undefined {
    if (name !== 'path') return undefined;
    return html`<div class="buttons">
      ${button('', html`${icon('shuffle', 16)} ${t('verb.shuffle')}`, () => {
        const seed = Math.floor(Math.random() * mostSeeds);
        this.studio.change((now) => withValue(now, settingOf('toolpath.seed'), seed));
      })}
    </div>`;
  }

  #warnings(): readonly GcodeWarning[] {
    const { summary, result } = this.state;
    return summary === undefined ? [] : [...(result?.report.warnings ?? []), ...summary.warnings];
  }

  #summary(): TemplateResult {
    const { summary, plate, check } = this.state;
    const notes = this.#warnings().length + (check?.findings.length ?? 0);
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
      <sillon-doubts .studio=${this.studio}></sillon-doubts>
      ${
        notes === 0
          ? nothing
          : html`<p class="note">${button('link', say(words, 'summary.notes', { n: notes }), this.#showNotes)}</p>`
      }`;
  }

  #showNotes = (): void => {
    const before = this.renderRoot.querySelector<HTMLElement>('#before-title');
    before?.scrollIntoView({ block: 'center' });
    before?.focus({ preventScroll: true });
  };

  /** Warnings and findings to read before the print is started; they come after the choices. */
  #before(): TemplateResult {
    const { summary } = this.state;
    return html`<section aria-labelledby="before-title">
      <h3 id="before-title" tabindex="-1">${say(words, 'summary.warnings')}</h3>
      <ul class="warnings">
        ${this.#warnings().map((warning) => this.#note(warningText(warning)))}
      </ul>
      ${this.#findings()} ${this.#startLines()}
      <p class="note">
        ${say(words, 'summary.estimate')}
        ${summary === undefined ? '' : say(words, 'summary.size', { size: formatBytes(summary.bytes) })}
      </p>
    </section>`;
  }

  #note(text: string, title = ''): TemplateResult {
    return html`<li title=${title || nothing}>${icon('warn', 16)}<span>${linked(this.studio, text)}</span></li>`;
  }

  /** Findings from reading the file back as a printer would. */
  #findings(): TemplateResult | typeof nothing {
    const { check } = this.state;
    if (check === undefined) return nothing;
    if (check.findings.length === 0) return html`<p class="note">${say(problems, 'check.good')}</p>`;
    return html`<h3>${say(problems, check.errors > 0 ? 'check.errors' : 'check.warnings')}</h3>
      <ul class="warnings">
        ${check.findings.map((finding) => this.#note(findingText(finding), finding.message))}
      </ul>`;
  }

  /** Faults of the start block, each with its line. */
  #startLines(): TemplateResult | typeof nothing {
    const { summary, problem, plate } = this.state;
    const lines = startLines(summary?.warnings ?? [], problem, plate.printer.startGcode);
    if (lines.length === 0) return nothing;
    return html`<h3>${linked(this.studio, t('brought.name', { name: t('setting.printer.startGcode') }))}</h3>
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
