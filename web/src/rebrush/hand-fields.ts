// Edits the brush for new beads, and its strokes.
import { html, nothing, type TemplateResult } from 'lit';
import { r } from '../i18n/rebrush.js';
import { t } from '../i18n/text.js';
import { modeChoices } from '../model/plate.js';
import type { HandBrush } from '../model/rebrush.js';
import { numberField, segments, select } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import type { PrintWork } from './work.js';
import { button } from '../controls/button.js';

/** Returns the fields of the brush, and buttons to undo or clear its strokes. */
export function handFields(
  work: PrintWork,
  brush: HandBrush,
  onBrush: (change: Partial<HandBrush>) => void,
): TemplateResult {
  const { tool } = brush;
  const { strokes } = work.wish;
  return html`${segments({
      id: 'hand-tool',
      label: t('tool.title'),
      value: tool,
      options: [
        { value: 'pan', label: t('tool.pan'), icon: 'hand' },
        { value: 'comb', label: t('tool.comb'), icon: 'comb' },
        { value: 'mode', label: t('tool.mode'), icon: 'mode' },
        { value: 'erase', label: t('tool.erase'), icon: 'erase' },
      ],
      onChoose: (chosen) => onBrush({ tool: chosen }),
    })}
    <p class="note">${tool === 'pan' ? r('hand.help') : t(`tool.${tool}.help`)}</p>
    ${
      tool === 'mode'
        ? select({
            id: 'hand-mode',
            label: t('section.modes'),
            value: brush.mode,
            options: modeChoices.map((value) => ({ value, label: t(`mode.${value}`) })),
            onChoose: (mode) => onBrush({ mode }),
          })
        : nothing
    }
    ${
      tool === 'pan'
        ? nothing
        : numberField({
            id: 'hand-across',
            label: t('tool.radius'),
            value: brush.across,
            min: 0.5,
            max: 200,
            step: 0.5,
            usual: [0.5, 40],
            unit: 'mm',
            onInput: (across) => onBrush({ across }),
          })
    }
    ${
      strokes.length === 0
        ? nothing
        : html`<div class="buttons">
            <span class="note">${t('tool.strokes', { n: strokes.length })}</span>
            ${button('', html`${icon('undo', 16)} ${r('hand.undo')}`, () => work.undoStroke())}
            ${button('', html`${icon('erase', 16)} ${t('tool.clear')}`, () => work.want({ strokes: [] }))}
          </div>`
    }`;
}
