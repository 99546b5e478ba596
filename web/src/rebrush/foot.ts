// The foot of the re-brushing panel with progress and download, and the message for files without work to do.
import { html, nothing, type TemplateResult } from 'lit';
import type { Rebrushed, SlicedFile } from 'sillon';
import { r } from '../i18n/rebrush.js';
import { exactWords } from '../i18n/say-problem.js';
import { problemWords } from '../i18n/say.js';
import { formatDuration, language, t } from '../i18n/text.js';
import type { Problem } from '../model/problem.js';
import { lackOf, type Wish } from '../model/rebrush.js';
import { icon } from '../controls/icons.js';
import { brushedName } from '../files/sliced.js';
import { leftReasons, reasonText } from './faces.js';
import type { PrintWork, Progress } from './work.js';
import { button } from '../controls/button.js';

/** Returns a progress bar with a cancel button. @param fraction  undefined: unknown */
export function progressBar(
  what: string,
  fraction: number | undefined,
  onCancel: () => void,
  rest = '',
): TemplateResult {
  const percent = fraction === undefined ? undefined : Math.floor(100 * fraction);
  return html`<div class="job">
    <span role="status">${what}</span>
    ${button('', t('verb.cancel'), onCancel)}
    <div
      class="bar ${percent === undefined ? 'unknown' : ''}"
      role="progressbar"
      aria-label=${what}
      aria-valuemin="0"
      aria-valuemax="100"
      aria-valuenow=${percent ?? nothing}
    >
      <div .style=${`--share: ${fraction ?? 0.3}`}></div>
    </div>
    ${percent === undefined ? nothing : html`<span class="note">${t('progress.percent', { percent })} ${rest}</span>`}
  </div>`;
}

/** Returns the page's words about a problem. If there are none, the engine's own follow; they are English, so other
 * languages fold them. */
function engineWords(problem: Problem): TemplateResult | typeof nothing {
  const { values } = problem;
  if ('mb' in values) return html`<p>${r('tooLarge', values)}</p>`;
  const told = reasonText(String(values['reason'])) ?? exactWords(problem)?.message;
  if (told !== undefined) return html`<p>${told}${/[.!?…]$/.test(told) ? '' : '.'}</p>`;
  const { detail } = problem;
  if (detail === '') return nothing;
  if (language() === 'en') return html`<p>${detail}</p>`;
  return html`<details>
    <summary>${icon('fold', 14)} ${t('problem.details')}</summary>
    <p lang="en">${detail}</p>
  </details>`;
}

/** Returns the message for a file that offers nothing to do. */
export function noWork(name: string, { print, faces, problem }: PrintWork['known']): TemplateResult {
  const message =
    print === undefined ? r('unreadable', { name }) : r(print.surfaces.length === 0 ? 'noTops' : 'noFaces', { name });
  return html`<div class="problem" role="alert">
    ${icon('warn')}
    <div>
      <p><b>${message}</b></p>
      ${problem === undefined ? nothing : engineWords(problem)}
      ${print === undefined ? html`<p class="note">${r('unreadableHelp')}</p>` : leftReasons(faces)}
    </div>
  </div>`;
}

/** Returns progress, problems, and the download button. */
export function foot(work: PrintWork, print: SlicedFile, name: string): TemplateResult {
  const { wish } = work;
  const { progress, problem, cancelled, done, saved } = work.known;
  const lack = lackOf(wish);
  return html`${progress === undefined ? nothing : making(wish, progress, work.cancel)}
  ${problem === undefined ? nothing : failed(problem)}
  ${lack === '' ? nothing : html`<p class="note" role="status">${r(lack)}</p>`}
  ${
    cancelled || (problem !== undefined && done === undefined && lack === '')
      ? html`<div class="buttons">
          ${cancelled ? html`<span role="status">${r('cancelled')}</span>` : nothing}
          ${button('', r('again'), () => void work.lay())}
        </div>`
      : nothing
  }
  ${done === undefined ? nothing : ready(done, work.staying().length, print)}
  ${button(
    { look: 'main', disabled: done === undefined },
    html`${icon('download')} <span class="cut">${r('download', { name: brushedName(name) })}</span>`,
    work.save,
  )}
  ${saved === '' ? nothing : html`<p class="note" role="status">${saved}</p>`}`;
}

function making({ chosen }: Wish, { fraction, secondsLeft }: Progress, onCancel: () => void): TemplateResult {
  const k = Math.min(chosen.size, 1 + Math.floor(fraction * chosen.size));
  const rest = secondsLeft === undefined ? '' : t('progress.left', { time: formatDuration(secondsLeft) });
  return progressBar(r('making', { k, n: chosen.size }), fraction, onCancel, rest);
}

function failed(problem: Problem): TemplateResult {
  const ofPicture = 'name' in problem.values;
  const engine = !ofPicture && (problem.code === 'InvalidArgument' || problem.code === 'InvalidFile');
  const { message, hint } = { ...problemWords(problem), ...(ofPicture && exactWords(problem)) };
  return html`<div class="problem" role="alert">
    ${icon('warn')}
    <div>
      <p><b>${engine ? r('failed') : message}</b></p>
      ${ofPicture ? nothing : engineWords(problem)}
      ${engine || hint === '' ? nothing : html`<p class="note">${hint}</p>`}
    </div>
  </div>`;
}

function ready({ seconds, surfaces }: Rebrushed, staying: number, { slicer }: SlicedFile): TemplateResult {
  const time = formatDuration(Math.abs(seconds));
  const more = r(seconds < 0 ? 'shorter' : 'longer');
  return html`<p role="status">
    ${r('ready', { n: surfaces.filter(({ replaced }) => replaced).length, time, more, slicer })}
    ${staying === 0 ? nothing : r('staying', { n: staying })}
  </p>`;
}
