// The folded part of a panel: rows of data, each with its default.
import { html, type TemplateResult } from 'lit';
import { settingLabel, valueText } from '../i18n/say.js';
import { t } from '../i18n/text.js';
import { valueOf, withValue, type Setting } from '../model/settings.js';
import { icon } from './icons.js';
import { settingField } from './setting-field.js';
import type { Studio } from '../studio/studio.js';

const same = (a: unknown, b: unknown): boolean => JSON.stringify(a) === JSON.stringify(b);

function resetButton(studio: Studio, setting: Setting): TemplateResult | string {
  if (same(valueOf(studio.store.state.plate, setting), setting.default)) return '';
  const value = valueText(setting, setting.default);
  return html`<button
    type="button"
    class="link"
    aria-label=${t('setting.resetOne', { name: settingLabel(setting), value })}
    @click=${() => {
      studio.change((plate) => withValue(plate, setting, structuredClone(setting.default)));
    }}
  >
    ${t('setting.default', { value })}
  </button>`;
}

export const advancedSettings = (studio: Studio, rows: readonly Setting[]): TemplateResult =>
  html`<section>
    <details
      .open=${studio.store.state.advanced}
      @toggle=${(event: Event) => {
        const { open } = event.currentTarget as HTMLDetailsElement;
        if (open !== studio.store.state.advanced) studio.store.set({ advanced: open });
      }}
    >
      <summary>${icon('fold', 16)} ${t('section.advanced')}</summary>
      <p class="note">${t('section.advancedHelp')}</p>
      <div class="rows">
        ${
          studio.store.state.advanced
            ? rows.map((row) => html`<div>${settingField(studio, row.id)} ${resetButton(studio, row)}</div>`)
            : ''
        }
      </div>
    </details>
  </section>`;
