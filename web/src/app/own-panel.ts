// The settings that a host lets its visitors change one by one.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { words } from '../i18n/en/about.js';
import { say, t } from '../i18n/text.js';
import type { Control } from '../model/guest.js';
import type { SettingId } from '../model/settings.js';
import { StudioElement } from '../controls/element.js';
import { textField } from '../controls/fields.js';
import { filamentField, printerField, swatchStyle } from '../print/machine-fields.js';
import { panelStyle } from '../controls/panel-style.js';
import { settingField } from '../controls/setting-field.js';
import { ownControls } from '../studio/shown.js';
import { sizeFields } from '../shape/size-fields.js';
import { kindFields } from '../layers/kind-fields.js';
import { groundOf } from '../model/fills.js';

@customElement('sillon-own-panel')
export class OwnPanel extends StudioElement {
  static override reads = ['plate', 'controls', 'units', 'keepRatio', 'host'] as const;

  static override styles = [
    panelStyle,
    swatchStyle,
    css`
      section {
        gap: 18px;
      }
    `,
  ];

  override render(): TemplateResult {
    return html`<section aria-labelledby="own-title">
      <h2 id="own-title">${t('section.own')}</h2>
      ${ownControls(this.state).map((control) => this.#field(control))}
      ${this.state.host === '' ? nothing : html`<p class="note">${say(words, 'app.host', { host: this.state.host })}</p>`}
    </section>`;
  }

  /** Returns the control of a setting or part. */
  #field(control: Control): TemplateResult | TemplateResult[] {
    const { studio } = this;
    const { plate } = this.state;
    const ground = groundOf(plate);
    switch (control) {
      case 'name':
        return textField({
          id: 'name',
          label: t('app.plate'),
          value: plate.name,
          maxLength: 80,
          onInput: (name) => studio.change((now) => ({ ...now, name }), 'name'),
          onSettle: () => studio.settle(),
        });
      case 'size':
        return sizeFields(studio);
      case 'source':
        return html`${ground === undefined ? nothing : kindFields(studio, ground)}`;
      case 'filament':
        return filamentField(studio);
      case 'printer':
        return printerField(studio);
      default:
        return settingField(studio, control as SettingId);
    }
  }
}
