// How beads are laid.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { words } from '../i18n/en/presets.js';
import { formatNumber, say, t } from '../i18n/text.js';
import {
  adviceFor,
  expertSettings,
  nozzleAdvice,
  qualities,
  qualityOf,
  settings,
  withNozzle,
  withQuality,
} from '../model/settings.js';
import { advancedSettings } from '../controls/advanced.js';
import { StudioElement } from '../controls/element.js';
import { cards, segments } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import { panelStyle } from '../controls/panel-style.js';
import { settingField } from '../controls/setting-field.js';

type QualityName = keyof typeof qualities;

@customElement('sillon-toolpath-panel')
export class ToolpathPanel extends StudioElement {
  static override reads = ['plate', 'advanced'] as const;

  static override styles = [
    ...StudioElement.styles,
    panelStyle,
    css`
      .suggestion {
        display: flex;
        flex-wrap: wrap;
        gap: 4px 8px;
        align-items: center;
      }
    `,
  ];

  override render(): TemplateResult {
    const { plate } = this.state;
    const { toolpath, printer } = plate;
    const quality = qualityOf(toolpath);
    const advice = adviceFor(printer.nozzle);
    return html`
      <section aria-labelledby="beads-title">
        <h2 id="beads-title">${t('section.toolpath')}</h2>
        ${cards<QualityName>({
          id: 'quality',
          label: say(words, 'preset.title'),
          value: quality,
          options: (Object.keys(qualities) as QualityName[]).map((value) => ({
            value,
            label: say(words, `preset.${value}`),
            picture: `presets/${value}.webp`,
          })),
          onChoose: (value) => {
            this.studio.change((now) => withQuality(now, value));
          },
        })}
        <p class="note">
          ${quality === undefined ? say(words, 'preset.custom') : say(words, `preset.${quality}.help`)}
        </p>
      </section>
      <section aria-label=${t('section.beads')}>
        ${segments({
          id: 'nozzle',
          label: t('setting.printer.nozzle'),
          value: String(printer.nozzle),
          options: nozzleAdvice.map(({ nozzle }) => ({ value: String(nozzle), label: formatNumber(nozzle, 2) })),
          onChoose: (value) => {
            this.studio.change((now) => withNozzle(now, Number(value)));
          },
        })}
        ${settingField(this.studio, 'toolpath.spacing')}
        ${
          advice.spacing[1] === toolpath.spacing
            ? nothing
            : html`<p class="note suggestion">
                ${t('setting.suggested', { nozzle: advice.nozzle, value: advice.spacing[1] })}
                <button
                  type="button"
                  class="link"
                  @click=${() => {
                    this.studio.change((now) => ({
                      ...now,
                      toolpath: { ...now.toolpath, spacing: advice.spacing[1] },
                    }));
                  }}
                >
                  ${t('verb.use')}
                </button>
              </p>`
        }
        ${settingField(this.studio, 'toolpath.perimeterMode')}
        ${toolpath.perimeterMode === 'count' ? settingField(this.studio, 'toolpath.perimeters') : nothing}
        ${settingField(this.studio, 'toolpath.seed')}
        <div class="buttons">
          <button
            type="button"
            @click=${() => {
              this.studio.change((now) => ({
                ...now,
                toolpath: { ...now.toolpath, seed: Math.floor(Math.random() * 1e6) },
              }));
            }}
          >
            ${icon('shuffle', 16)} ${t('verb.shuffle')}
          </button>
        </div>
      </section>
      ${advancedSettings(
        this.studio,
        settings.filter(
          (setting) => setting.section === 'toolpath' && setting.advanced && !expertSettings.has(setting.id),
        ),
      )}
    `;
  }
}
