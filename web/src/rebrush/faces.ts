// Lists the faces of a sliced print, with the reasons why some are left as they are.
import { html, nothing, type TemplateResult } from 'lit';
import { live } from 'lit/directives/live.js';
import { words as faceWords } from '../i18n/en/core/faces.js';
import { r, type RebrushTextId } from '../i18n/rebrush.js';
import { formatNumber } from '../i18n/text.js';
import type { SlicedSurface } from 'sillon';
import { areaOf, objectOf, type Face } from '../model/rebrush.js';
import { segments } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import type { PrintWork } from './work.js';
import { button } from '../controls/button.js';

/** Returns the section of the faces. @param onMark  called with the face under the pointer; undefined: none */
export function faceList(work: PrintWork, onMark: (index: number | undefined) => void): TemplateResult {
  const { side } = work.wish;
  const free = work.free();
  const rest = work.known.faces.filter(({ left }) => left !== '');
  const staying = work.staying();
  const chosen = free.filter(({ index }) => work.wish.chosen.has(index));
  const choose = (label: string, faces: readonly Face[]): TemplateResult =>
    button('link', label, () => work.want({ chosen: new Set(faces.map(({ index }) => index)) }));
  return html`<section>
    <div class="title">
      <h3 id="faces">${r('faces')}</h3>
      ${choose(r('all'), free)} ${choose(r('none'), [])}
    </div>
    ${
      work.sides().length < 2
        ? nothing
        : segments({
            id: 'side',
            label: r('side'),
            value: side,
            options: work.sides().map((value) => ({ value, label: r(`side.${value}`) })),
            onChoose: (next) => work.wantSide(next),
          })
    }
    ${side === 'top' ? nothing : html`<p class="note">${r(`side.${side}.help`)}</p>`}
    <ul class="faces" aria-labelledby="faces">
      ${free.map((face) => faceRow(face, work, onMark))}
    </ul>
    <p class="note" role="status">
      ${r('chosen', { n: chosen.length, all: free.length, area: formatNumber(areaOf(chosen), 0) })}
      ${staying.length === 0 ? nothing : r('staying', { n: staying.length })}
    </p>
    ${leftReasons(staying)}
    ${
      rest.length === 0
        ? nothing
        : html`<details>
            <summary>${icon('fold', 16)} ${r('left', { n: rest.length })}</summary>
            ${leftReasons(rest)}
          </details>`
    }
  </section>`;
}

/** Returns the row of a face: its checkbox, layer, area and result. */
function faceRow(
  { index, side, layer, z, areaMm2, object }: Face,
  work: PrintWork,
  onMark: (index: number | undefined) => void,
): TemplateResult {
  const made = work.known.done?.surfaces.find((one) => one.index === index);
  const mark = (marked: number | undefined) => () => onMark(marked);
  return html`<li @pointerenter=${mark(index)} @pointerleave=${mark(undefined)}>
    <label>
      <input
        type="checkbox"
        .checked=${live(work.wish.chosen.has(index))}
        @change=${() => work.toggle(index)}
        @focus=${mark(index)}
        @blur=${mark(undefined)}
      />
      <span class="what"
        ><span>${r(side === 'top' ? 'face' : 'bottomFace', { layer, z: formatNumber(z) })}</span>${
          object === '' ? nothing : html`<span class="note">${objectText(object, work)}</span>`
        }${
          made === undefined
            ? nothing
            : html`<span class="note">${made.replaced ? r('done') : r('keeps', { why: whyText(made) })}</span>`
        }</span
      >
      <span class="figures">${r('area', { area: formatNumber(areaMm2, areaMm2 < 10 ? 1 : 0) })}</span>
    </label>
  </li>`;
}

function objectText(label: string, { known }: PrintWork): string {
  const object = objectOf(label, known.names);
  return typeof object === 'string' ? object : r('object', { n: object });
}

/** Returns the sentence of a reason's code; undefined: the page has none, and the engine's own words are English. */
export const reasonText = (reason: string): string | undefined =>
  Object.hasOwn(faceWords, `rebrush.left.${reason}`) ? r(`left.${reason}` as RebrushTextId) : undefined;
const whyText = ({ reason, left }: SlicedSurface): string => reasonText(reason) ?? left;

/** Returns one line per reason. */
export function leftReasons(faces: readonly SlicedSurface[]): TemplateResult | typeof nothing {
  if (faces.length === 0) return nothing;
  const groups = new Map<SlicedSurface['reason'], SlicedSurface[]>();
  for (const face of faces) groups.set(face.reason, [...(groups.get(face.reason) ?? []), face]);
  return html`<ul>
    ${[...groups.values()].map((list) => {
      const why = whyText(list[0] as SlicedSurface);
      return html`<li class="note">${r('why', { why, n: list.length, area: formatNumber(areaOf(list), 1) })}</li>`;
    })}
  </ul>`;
}
