// Dialog that shows a printer's start and end G-code line by line, and how a printer from elsewhere differs from the
// visitor's. It comes before such a printer is used, and before the first file for it is downloaded.
import type { GcodeFinding, PrinterValues } from 'sillon';
import { css, html, nothing, type PropertyValues, type TemplateResult } from 'lit';
import { customElement, property, state } from 'lit/decorators.js';
import { words } from '../i18n/en/blocks.js';
import { heatText, settingLabel, valueText } from '../i18n/say.js';
import { findingText } from '../i18n/say-core.js';
import { say, t } from '../i18n/text.js';
import { withoutBlocks } from '../model/brought.js';
import { settings, type Setting, type SettingValue } from '../model/settings.js';
import { DialogElement } from '../controls/dialog.js';
import { icon } from '../controls/icons.js';
import { button } from '../controls/button.js';

type Block = 'startGcode' | 'endGcode';

/** Replaces invisible characters, and those that reverse the text around them, by their code points. */
const visible = (text: string): string =>
  text.replace(/[\p{Cc}\p{Cf}\u2028\u2029]/gu, (letter) =>
    letter === '\t' ? ' ' : `\\u${(letter.codePointAt(0) ?? 0).toString(16).padStart(4, '0')}`,
  );

@customElement('sillon-blocks')
export class Blocks extends DialogElement {
  static override reads = ['plate'] as const;

  static override styles = css`
    table {
      width: 100%;
      border-collapse: collapse;
      font-size: var(--note);
    }
    th,
    td {
      padding: 4px 8px 4px 0;
      border-bottom: 1px solid var(--line);
      text-align: start;
      overflow-wrap: anywhere;
    }
    ol {
      list-style: none;
      border: 1px solid var(--line);
      border-radius: var(--radius);
      background: var(--sunken);
      font-size: var(--note);
    }
    li {
      display: grid;
      grid-template-columns: 3.5em minmax(0, 1fr);
      gap: 2px 8px;
      padding: 3px 8px;
    }
    li + li {
      border-top: 1px solid var(--line);
    }
    .number {
      color: var(--soft);
      text-align: end;
      font-variant-numeric: tabular-nums;
    }
    code {
      overflow-wrap: anywhere;
      unicode-bidi: isolate-override;
    }
    .mark {
      display: flex;
      gap: 6px;
      grid-column: 2;
      color: var(--soft);
    }
    .mark .icon {
      flex: none;
      margin-top: 1px;
    }
    .error {
      background: var(--bad-tint);
    }
    .error .mark {
      color: var(--bad);
    }
    .warning .mark {
      color: var(--accent);
    }
  `;

  @property() purpose: 'brought' | 'blocks' = 'brought';
  /** The engine's findings; undefined for a block that is not examined yet, or that is empty. */
  @state() private findings: Partial<Record<Block, readonly GcodeFinding[]>> = {};
  #examined: PrinterValues | undefined;

  protected override heading = (): string =>
    this.purpose === 'brought' ? t('brought.title') : say(words, 'blocks.title');

  #printer(): PrinterValues {
    const { brought, printer } = this.state.plate;
    return this.purpose === 'brought' ? (brought ?? printer) : printer;
  }

  protected override willUpdate(changes: PropertyValues): void {
    super.willUpdate(changes);
    const printer = this.#printer();
    if (printer === this.#examined) return;
    this.#examined = printer;
    this.findings = {};
    for (const block of ['startGcode', 'endGcode'] as const) void this.#examine(printer, block);
  }

  async #examine(printer: PrinterValues, block: Block): Promise<void> {
    if (printer[block] === '') return;
    try {
      const engine = await this.studio.services.engine();
      const found = await engine.examineBlock(printer[block], printer.flavor);
      if (printer === this.#examined) this.findings = { ...this.findings, [block]: found };
    } catch {
      // The lines stay marked as not checked.
    }
  }

  protected override body(): TemplateResult {
    const printer = this.#printer();
    return html`
      <p>${say(words, this.purpose === 'brought' ? 'brought.help' : 'blocks.help')}</p>
      ${this.purpose === 'brought' ? this.#differences(printer) : nothing}
      ${printer.generalHeatLimits ? html`<p>${icon('warn', 16)} ${say(words, 'blocks.generalHeatLimits')} ${heatText(printer)}</p>` : nothing}
      ${this.#block(printer, 'startGcode')} ${this.#block(printer, 'endGcode')}
      <div class="end">${this.purpose === 'brought' ? this.#choice() : this.#download()}</div>
    `;
  }

  #differences(printer: PrinterValues): TemplateResult | typeof nothing {
    const own = this.state.plate.printer;
    const valueIn = (values: PrinterValues, { key }: Setting): SettingValue =>
      (values as unknown as Record<string, SettingValue>)[key] as SettingValue;
    const rows = settings.filter(
      (setting) =>
        setting.section === 'printer' &&
        !(setting.kind === 'text' && setting.long) &&
        JSON.stringify(valueIn(printer, setting)) !== JSON.stringify(valueIn(own, setting)),
    );
    if (rows.length === 0) return nothing;
    return html`<table>
      <thead>
        <tr>
          <th scope="col">${say(words, 'brought.setting')}</th>
          <th scope="col">${say(words, 'brought.mine')}</th>
          <th scope="col">${say(words, 'brought.theirs')}</th>
        </tr>
      </thead>
      <tbody>
        ${rows.map(
          (setting) =>
            html`<tr>
              <th scope="row">${settingLabel(setting)}</th>
              <td>${visible(valueText(setting, valueIn(own, setting)))}</td>
              <td>${visible(valueText(setting, valueIn(printer, setting)))}</td>
            </tr>`,
        )}
      </tbody>
    </table>`;
  }

  #block(printer: PrinterValues, block: Block): TemplateResult | typeof nothing {
    const text = printer[block];
    if (text === '') return nothing;
    const findings = this.findings[block];
    const lines = text.split('\n').map((line, k) => ({ number: k + 1, line: line.trim() }));
    return html`<h3>${t(`setting.printer.${block}`)}</h3>
      <ol>
        ${lines.map(({ number, line }) => (line === '' ? nothing : this.#line(number, line, findings)))}
      </ol>`;
  }

  #line(number: number, line: string, findings: readonly GcodeFinding[] | undefined): TemplateResult {
    const found = findings?.filter((finding) => finding.line === number) ?? [];
    const state = found.some(({ error }) => error) ? 'error' : found.length > 0 ? 'warning' : '';
    const mark = (text: string): TemplateResult =>
      html`<span class="mark">${state === '' ? nothing : icon('warn', 14)}<span>${text}</span></span>`;
    return html`<li class=${state}>
      <span class="number">${number}</span><code dir="ltr">${visible(line)}</code>
      ${findings === undefined && !line.startsWith(';') ? mark(say(words, 'blocks.unchecked')) : nothing}
      ${found.map((finding) => mark(findingText({ ...finding, line: 0 })))}
    </li>`;
  }

  #choice(): TemplateResult {
    return html`${button('', t('verb.use'), () => {
      this.studio.useBrought(true);
      this.close();
    })}
    ${button('main', t('brought.keep'), () => {
      this.studio.keepOwnPrinter();
      this.close();
    })}`;
  }

  #download(): TemplateResult {
    return html`${button('', say(words, 'blocks.remove'), () => {
      this.studio.change(withoutBlocks);
      this.close();
    })}
    ${button('main', html`${icon('download')} ${t('keys.gcode')}`, () =>
      this.close(() => {
        this.studio.goOn();
      }),
    )}`;
  }
}
