// Edits the picture that new beads are solved for, and the filament; tells how well the picture can be seen.
import { html, nothing, type TemplateResult } from 'lit';
import { r } from '../i18n/rebrush.js';
import { t } from '../i18n/text.js';
import { filamentOf, filaments } from '../model/filaments.js';
import { filamentLabel } from '../print/filament-name.js';
import { ownSpools } from '../print/machine-fields.js';
import { select } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import { thumbnail } from '../controls/thumbnail.js';
import type { PrintWork } from './work.js';
import { button } from '../controls/button.js';

/** Least cropped share of a picture that is worth a note. */
const leastCut = 0.03;

/** Returns the fields of the picture, or a button that chooses one. */
export function pictureFields(work: PrintWork, onPick: () => void): TemplateResult {
  const { wish } = work;
  const { picture } = wish;
  if (picture === undefined) {
    return html`<p class="note">${r('picture.help')}</p>
      <div class="buttons">${button('main', html`${icon('open', 16)} ${r('picture.choose')}`, onPick)}</div>`;
  }
  const seen = (work.known.done?.surfaces ?? []).flatMap(({ pictures }) => pictures);
  const mean = seen.reduce((sum, one) => sum + one.r, 0) / seen.length;
  const cut = Math.max(0, ...seen.map(({ leftOut = 0 }) => leftOut));
  const spools = ownSpools(work.studio);
  return html`<div class="picture">
      ${thumbnail(picture)}<b class="cut" title=${picture.name}>${picture.name}</b>
      ${button('plain', t('verb.replace'), onPick)}
    </div>
    ${
      seen.length === 0
        ? nothing
        : html`<p class="note">${r('picture.seen', { percent: Math.round(100 * Math.max(0, mean)) })}</p>`
    }
    ${cut < leastCut ? nothing : html`<p class="note">${r('picture.cut', { percent: Math.round(100 * cut) })}</p>`}
    ${select({
      id: 'spool',
      label: r('spool'),
      value: wish.own?.key ?? wish.spool,
      options: [
        ...filaments.map((filament) => ({ value: filament.key, label: filamentLabel(filament) })),
        ...spools.map(({ key }) => ({ value: key, label: key })),
      ],
      onChoose: (key) => {
        const own = spools.find((one) => one.key === key);
        work.want(own === undefined ? { spool: filamentOf(key).key, own } : { own });
      },
    })}`;
}
