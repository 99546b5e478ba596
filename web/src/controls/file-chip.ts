// Shows a file that a plate is made from.
import { html, nothing, type TemplateResult } from 'lit';
import { formatBytes, t } from '../i18n/text.js';
import type { SourceFile } from '../model/plate.js';
import { icon } from './icons.js';
import type { Studio } from '../studio/studio.js';
import { button } from './button.js';

/** Returns the chip of a file with buttons to replace and remove it.
 * @param onRemove  removes the file; left out: the plate needs it
 * @param onFiles  takes replacements; left out: the plate opens them */
export const fileChip = (
  studio: Studio,
  file: SourceFile,
  accept: string,
  onRemove?: () => void,
  onFiles = (files: readonly File[]): Promise<void> => studio.open(files),
): TemplateResult =>
  html`<div class="file">
    ${icon('file', 18)}
    <span class="what"
      ><b class="cut" title=${file.name}>${file.name}</b><span class="note">${formatBytes(file.bytes.size)}</span></span
    >
    ${button('plain', t('verb.replace'), async () => {
      await onFiles(await studio.pick(accept));
    })}
    ${
      onRemove === undefined
        ? nothing
        : button({ look: 'plain square', label: `${t('verb.remove')}: ${file.name}` }, icon('close', 16), onRemove)
    }
  </div>`;
