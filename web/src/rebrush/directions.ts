// Which way the new beads of a sliced print lie: the choices, and under which lamp they are looked at.
import { html, nothing, type TemplateResult } from 'lit';
import type { Rebrushed } from 'sillon';
import { live } from 'lit/directives/live.js';
import { r } from '../i18n/rebrush.js';
import { filamentLabel } from '../print/filament-name.js';
import { t } from '../i18n/text.js';
import { filamentOf, filaments } from '../model/filaments.js';
import { modeChoices, type OwnSpool } from '../model/plate.js';
import { fits, type HandBrush, type Wish } from '../model/rebrush.js';
import type { Light } from '../model/view.js';
import '../controls/dial.js';
import { numberField, numberInput, segments, select } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import { thumbnail } from '../controls/thumbnail.js';

export interface DirectionFields {
  wish: Wish;
  /** The visitor's own. */
  spools: readonly OwnSpool[];
  brush: HandBrush;
  /** What was made of the choices as they are now. */
  done: Rebrushed | undefined;
  /** Under which the beads are looked at. */
  light: Light;
  onWant: (change: Partial<Wish>) => void;
  onBrush: (change: Partial<HandBrush>) => void;
  onLight: (light: Light) => void;
  onPickPicture: () => void;
}

export function directionFields(fields: DirectionFields): TemplateResult {
  const { wish, onWant } = fields;
  const { way } = wish;
  return html`<section>
    ${segments({
      id: 'way',
      label: r('directions'),
      value: way,
      options: [
        { value: 'angle', label: r('way.angle'), icon: 'angle' },
        { value: 'hand', label: r('way.hand'), icon: 'comb' },
        { value: 'plate', label: r('way.plate'), icon: 'directions' },
        { value: 'picture', label: r('way.picture'), icon: 'lamp' },
      ],
      onChoose: (next) => {
        onWant({ way: next });
      },
    })}
    ${way === 'angle' || way === 'hand' ? angleField(fields) : nothing} ${way === 'hand' ? handFields(fields) : nothing}
    ${way === 'plate' ? html`<p class="note">${r('plate.help')}</p>` : nothing}
    ${way === 'picture' ? pictureFields(fields) : nothing}
    ${
      way === 'plate' || way === 'picture'
        ? select({
            id: 'fit',
            label: r('fit'),
            value: wish.fit,
            options: fits.map((value) => ({ value, label: r(`fit.${value}`) })),
            onChoose: (fit) => {
              onWant({ fit });
            },
          })
        : nothing
    }
    ${way === 'picture' ? lampField(fields) : lightField(fields)}
  </section>`;
}

function angleField({ wish, onWant }: DirectionFields): TemplateResult {
  const { angle } = wish;
  const set = (value: number): void => {
    onWant({ angle: value });
  };
  const field = { id: 'angle', label: r('angle'), value: angle, min: -360, max: 360, step: 1, unit: '°' };
  return html`<div class="field angle">
    <sillon-dial
      .label=${r('angle')}
      .value=${angle}
      @turn=${(event: CustomEvent<number>) => {
        set(event.detail);
      }}
    ></sillon-dial>
    <label for="angle">${r('angle')}</label>
    ${numberInput({ ...field, onInput: set, onSettle: () => undefined })}
    <p class="error" id="angle-error" role="status" hidden></p>
  </div>`;
}

function handFields({ wish, brush, onWant, onBrush }: DirectionFields): TemplateResult {
  const { tool } = brush;
  const { strokes } = wish;
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
      onChoose: (chosen) => {
        onBrush({ tool: chosen });
      },
    })}
    <p class="note">${tool === 'pan' ? r('hand.help') : t(`tool.${tool}.help`)}</p>
    ${
      tool === 'mode'
        ? select({
            id: 'hand-mode',
            label: t('section.modes'),
            value: brush.mode,
            options: modeChoices.map((value) => ({ value, label: t(`mode.${value}`) })),
            onChoose: (mode) => {
              onBrush({ mode });
            },
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
            onInput: (across) => {
              onBrush({ across });
            },
            onSettle: () => undefined,
          })
    }
    ${
      strokes.length === 0
        ? nothing
        : html`<div class="buttons">
            <span class="note">${t('tool.strokes', { n: strokes.length })}</span>
            <button
              type="button"
              @click=${() => {
                onWant({ strokes: strokes.slice(0, -1) });
              }}
            >
              ${icon('undo', 16)} ${r('hand.undo')}
            </button>
            <button
              type="button"
              @click=${() => {
                onWant({ strokes: [] });
              }}
            >
              ${icon('erase', 16)} ${t('tool.clear')}
            </button>
          </div>`
    }`;
}

/** Of a picture, that is worth a word. */
const leastCut = 0.03;

function pictureFields({ wish, spools, done, onWant, onPickPicture }: DirectionFields): TemplateResult {
  const { picture } = wish;
  if (picture === undefined) {
    return html`<p class="note">${r('picture.help')}</p>
      <div class="buttons">
        <button type="button" class="main" @click=${onPickPicture}>${icon('open', 16)} ${r('picture.choose')}</button>
      </div>`;
  }
  const seen = (done?.surfaces ?? []).flatMap(({ pictures }) => pictures.map((one) => one.r));
  const mean = seen.reduce((sum, one) => sum + one, 0) / seen.length;
  const cut = Math.max(0, ...(done?.surfaces ?? []).flatMap(({ pictures }) => pictures.map(({ leftOut }) => leftOut)));
  return html`<div class="picture">
      ${thumbnail(picture)}<b title=${picture.name}>${picture.name}</b>
      <button type="button" class="plain" @click=${onPickPicture}>${t('verb.replace')}</button>
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
        onWant(own === undefined ? { spool: filamentOf(key).key, own } : { own });
      },
    })}`;
}

/** Of the picture: it is solved for it. */
function lampField({ wish, onWant }: DirectionFields): TemplateResult {
  const [azimuth, elevation] = wish.lamp;
  return standField('lamp', azimuth, elevation, 15, 80, (lamp) => {
    onWant({ lamp });
  });
}

/** Only to look at the beads. */
function lightField({ light, onLight }: DirectionFields): TemplateResult {
  return standField('light', light.azimuth, light.elevation, 5, 90, ([azimuth, elevation]) => {
    onLight({ azimuth, elevation });
  });
}

function standField(
  name: 'lamp' | 'light',
  azimuth: number,
  elevation: number,
  lowest: number,
  highest: number,
  set: (light: [number, number]) => void,
): TemplateResult {
  return html`<div class="stands">
    <sillon-dial
      kind="light"
      .label=${r(name)}
      .value=${azimuth}
      .min=${0}
      .max=${360}
      @turn=${(event: CustomEvent<number>) => {
        set([event.detail % 360, elevation]);
      }}
    ></sillon-dial>
    <span
      ><span
        >${name === 'lamp' ? t('lamp.stands', { azimuth, elevation }) : r('light.stands', { azimuth, elevation })}</span
      ><input
        type="range"
        min=${lowest}
        max=${highest}
        step="1"
        aria-label=${r('height')}
        aria-valuetext="${elevation}°"
        .value=${live(String(elevation))}
        .style=${`--share: ${(elevation - lowest) / (highest - lowest)}`}
        @input=${(event: Event) => {
          set([azimuth, Number((event.currentTarget as HTMLInputElement).value)]);
        }}
    /></span>
  </div>`;
}
