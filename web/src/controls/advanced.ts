// The folded part of a panel: groups of settings, each with a button that restores its default.
import { html, type TemplateResult } from 'lit';
import { settingLabel, valueText } from '../i18n/say.js';
import { t } from '../i18n/text.js';
import { valueOf, withValue, type Setting } from '../model/settings.js';
import { icon } from './icons.js';
import { settingField } from './setting-field.js';
import type { Studio } from '../studio/studio.js';
import { button } from './button.js';

const same = (a: unknown, b: unknown): boolean => JSON.stringify(a) === JSON.stringify(b);

/** Returns a button that restores the default; empty if the setting has it. */
function resetButton(studio: Studio, setting: Setting): TemplateResult | string {
  if (same(valueOf(studio.store.state.plate, setting), setting.default)) return '';
  const value = valueText(setting, setting.default);
  return button(
    { look: 'link', label: t('setting.resetOne', { name: settingLabel(setting), value }) },
    t('setting.default', { value }),
    () => studio.change((plate) => withValue(plate, setting, structuredClone(setting.default))),
  );
}

export interface AdvancedGroup {
  label: string;
  rows: readonly Setting[];
  /** Content after the rows. */
  more?: TemplateResult | undefined;
}

const groupFields = (studio: Studio, { label, rows, more }: AdvancedGroup): TemplateResult =>
  html`<details>
    <summary>${icon('fold', 16)} ${label}</summary>
    <div class="rows">
      ${rows.map((row) => html`<div>${settingField(studio, row.id)} ${resetButton(studio, row)}</div>`)} ${more ?? ''}
    </div>
  </details>`;

/** Returns the folded section; each group in it is folded, too, so that few fields are in sight at a time. */
export const advancedSettings = (studio: Studio, groups: readonly AdvancedGroup[]): TemplateResult =>
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
      <div class="rows">${studio.store.state.advanced ? groups.map((group) => groupFields(studio, group)) : ''}</div>
    </details>
  </section>`;
