// The faces of a sliced print as a list, and why others are left.
import { html, nothing, type TemplateResult } from 'lit';
import type { Rebrushed } from 'sillon';
import { live } from 'lit/directives/live.js';
import { r, type RebrushTextId } from '../i18n/rebrush.js';
import { formatNumber } from '../i18n/text.js';
import { areaOf, type Face, type Side } from '../model/rebrush.js';
import { segments } from '../controls/fields.js';
import { icon } from '../controls/icons.js';

export interface FaceList {
  faces: readonly Face[];
  side: Side;
  /** That can be chosen from. */
  sides: readonly Side[];
  chosen: ReadonlySet<number>;
  /** What was made of the choices as they are now. */
  done: Rebrushed | undefined;
  onSide: (side: Side) => void;
  onChoose: (chosen: ReadonlySet<number>) => void;
  onToggle: (index: number) => void;
  /** A face is pointed at; undefined: none is. */
  onMark: (index: number | undefined) => void;
}

export function faceList(list: FaceList): TemplateResult {
  const free = list.faces.filter(({ left }) => left === '');
  const rest = list.faces.filter(({ left }) => left !== '');
  const chosen = free.filter(({ index }) => list.chosen.has(index));
  const choose = (label: string, faces: readonly Face[]): TemplateResult =>
    html`<button
      type="button"
      class="link"
      @click=${() => {
        list.onChoose(new Set(faces.map(({ index }) => index)));
      }}
    >
      ${label}
    </button>`;
  return html`<section>
    <div class="title">
      <h3 id="faces">${r('faces')}</h3>
      ${choose(r('all'), free)} ${choose(r('none'), [])}
    </div>
    ${
      list.sides.length < 2
        ? nothing
        : segments({
            id: 'side',
            label: r('side'),
            value: list.side,
            options: list.sides.map((value) => ({ value, label: r(`side.${value}`) })),
            onChoose: list.onSide,
          })
    }
    ${list.side === 'top' ? nothing : html`<p class="note">${r(`side.${list.side}.help`)}</p>`}
    <ul class="faces" aria-labelledby="faces">
      ${free.map((face) => faceRow(face, list))}
    </ul>
    <p class="note" role="status">
      ${r('chosen', { n: chosen.length, all: free.length, area: formatNumber(areaOf(chosen), 0) })}
    </p>
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

function faceRow({ index, side, layer, z, areaMm2, object }: Face, list: FaceList): TemplateResult {
  const made = list.done?.surfaces.find((one) => one.index === index);
  const mark = (marked: number | undefined) => () => {
    list.onMark(marked);
  };
  return html`<li @pointerenter=${mark(index)} @pointerleave=${mark(undefined)}>
    <label>
      <input
        type="checkbox"
        .checked=${live(list.chosen.has(index))}
        @change=${() => {
          list.onToggle(index);
        }}
        @focus=${mark(index)}
        @blur=${mark(undefined)}
      />
      <span class="what"
        ><span>${r(side === 'top' ? 'face' : 'bottomFace', { layer, z: formatNumber(z) })}</span>${
          object === '' ? nothing : html`<span class="note">${object}</span>`
        }${
          made === undefined
            ? nothing
            : html`<span class="note">${made.replaced ? r('done') : r('keeps', { why: made.left })}</span>`
        }</span
      >
      <span class="figures">${r('area', { area: formatNumber(areaMm2, areaMm2 < 10 ? 1 : 0) })}</span>
    </label>
  </li>`;
}

/** One line for each reason. */
export function leftReasons(faces: readonly Face[]): TemplateResult | typeof nothing {
  if (faces.length === 0) return nothing;
  const groups = new Map<Face['reason'], Face[]>();
  for (const face of faces) groups.set(face.reason, [...(groups.get(face.reason) ?? []), face]);
  return html`<ul>
    ${[...groups].map(([reason, list]) => {
      const why = reason === '' ? (list[0]?.left ?? '') : r(`left.${reason}` as RebrushTextId);
      return html`<li class="note">${r('why', { why, n: list.length, area: formatNumber(areaOf(list), 1) })}</li>`;
    })}
  </ul>`;
}
