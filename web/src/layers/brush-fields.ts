// Makes the fields of the brush: its effect, width and softness.
import { html, nothing, type TemplateResult } from 'lit';
import { numberField, select } from '../controls/fields.js';
import { t } from '../i18n/text.js';
import { modeChoices, pageOf } from '../model/plate.js';
import type { Brush } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';

/** The fields of the brush. Widths are shown in mm, while the brush keeps its radius as a share of the page's width. */
export function brushFields(studio: Studio): TemplateResult {
  const { tool, brush, plate } = studio.store.state;
  const set = (change: Partial<Brush>): void => studio.store.set({ brush: { ...studio.store.state.brush, ...change } });
  const [wide] = pageOf(plate);
  return html`<p class="note">${t(`tool.${tool}.help`)}</p>
    ${
      tool === 'mode'
        ? select({
            id: 'brush-mode',
            label: t('section.modes'),
            value: brush.mode,
            options: modeChoices.map((value) => ({ value, label: t(`mode.${value}`) })),
            onChoose: (mode) => set({ mode }),
          })
        : nothing
    }
    ${numberField({
      id: 'brush-radius',
      label: t('tool.radius'),
      value: Math.round(brush.radius * 2 * wide * 10) / 10,
      min: 0.2,
      max: wide,
      step: 0.1,
      usual: [0.2, Math.max(1, Math.round(wide / 2))],
      unit: 'mm',
      onInput: (across) => set({ radius: across / 2 / wide }),
    })}
    ${numberField({
      id: 'brush-softness',
      label: t('tool.softness'),
      value: Math.round(brush.softness * 100),
      min: 0,
      max: 100,
      step: 1,
      usual: [0, 100],
      unit: '%',
      onInput: (percent) => set({ softness: percent / 100 }),
    })}`;
}
