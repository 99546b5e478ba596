// Pictures under lamps: which, where each lamp stands, and what this spool can show of them.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { formatNumber, t } from '../i18n/text.js';
import {
  greySteps,
  lampSizes,
  lampsOf,
  leastSeen,
  mostPictures,
  samePictures,
  seenOfDirections,
  weaknessesOf,
  type LampSource,
} from '../model/lamp.js';
import type { LampPicture } from '../model/plate.js';
import '../controls/dial.js';
import { StudioElement } from '../controls/element.js';
import { segments } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import { panelStyle } from '../controls/panel-style.js';
import { thumbnail } from '../controls/thumbnail.js';

const pictureFiles = '.png,.jpg,.jpeg,image/*';
const mostSteps = 30; // of grey, under the best lamps and spools
type SizeName = keyof typeof lampSizes;

@customElement('sillon-lamps')
export class LampsPanel extends StudioElement {
  static override reads = ['plate', 'result', 'lamp'] as const;

  static override styles = [
    ...StudioElement.styles,
    panelStyle,
    css`
      :host {
        display: grid;
        gap: 12px;
      }
      li {
        display: grid;
        grid-template-columns: 52px 1fr auto;
        align-items: center;
        gap: 4px 10px;
        padding: 8px;
        border: 1px solid var(--line);
        border-radius: var(--radius-large);
      }
      ul {
        display: grid;
        gap: 8px;
      }
      img {
        width: 52px;
        height: 52px;
        object-fit: cover;
        border-radius: var(--radius);
      }
      .what {
        min-width: 0;
      }
      .what b {
        display: block;
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
        font-weight: 500;
      }
      .stands {
        grid-column: 1 / -1;
        display: grid;
        grid-template-columns: auto 1fr;
        align-items: center;
        gap: 4px 10px;
      }
      .stands sillon-dial {
        grid-row: span 2;
        width: 48px;
        height: 48px;
      }
      meter {
        grid-column: 1 / -1;
        width: 100%;
        height: 8px;
      }
      .gauge {
        grid-column: 1 / -1;
      }
    `,
  ];

  override render(): TemplateResult | typeof nothing {
    const { plate, result } = this.state;
    const { directions } = plate;
    if (directions.kind !== 'lamp') return nothing;
    const size = (Object.keys(lampSizes) as SizeName[]).find((name) => lampSizes[name] === plate.pictures.lampSize);
    const same = result?.plate.directions === directions && samePictures(result.plate, plate);
    const seen = same ? seenOfDirections(result.report.pictures) : undefined;
    return html`
      <ul>
        ${directions.pictures.map((picture, k) => this.#picture(directions, picture, k, seen?.[k]?.contrast))}
      </ul>
      <div class="buttons">
        <button type="button" ?disabled=${directions.pictures.length >= mostPictures} @click=${() => void this.#add()}>
          ${icon('plus', 16)} ${t('lamp.add')}
        </button>
      </div>
      ${segments<SizeName>({
        id: 'lamp-size',
        label: t('lamp.size'),
        help: t('lamp.size.help'),
        value: size,
        options: (Object.keys(lampSizes) as SizeName[]).map((value) => ({ value, label: t(`lamp.size.${value}`) })),
        onChoose: (name) => {
          this.studio.change((now) => ({ ...now, pictures: { ...now.pictures, lampSize: lampSizes[name] } }));
        },
      })}
      ${weaknessesOf(plate, seen).map(
        (weakness) =>
          html`<p class="warning">${icon('warn', 16)} <span>${t(`lamp.weak.${weakness}`, leastSeen(seen))}</span></p>`,
      )}
      ${plate.strokes.length > 0 ? html`<p class="note">${t('lamp.strokes', { n: plate.strokes.length })}</p>` : nothing}
    `;
  }

  #picture(source: LampSource, picture: LampPicture, k: number, contrast: number | undefined): TemplateResult {
    const light = lampsOf({ ...source, pictures: [picture] }, undefined)[0] ?? this.studio.lamps()[k];
    const name = picture.file.name;
    return html`<li>
      ${thumbnail(picture.file)}
      <span class="what"
        ><b title=${name}>${name}</b
        ><span class="note">
          ${
            light === undefined
              ? nothing
              : t('lamp.stands', { azimuth: Math.round(light.azimuth), elevation: Math.round(light.elevation) })
          }</span
        ></span
      >
      ${
        source.pictures.length > 1
          ? html`<button
              type="button"
              class="plain square"
              aria-label="${t('verb.remove')}: ${name}"
              @click=${() => {
                this.#set({ ...source, pictures: source.pictures.filter((_, other) => other !== k) });
                this.studio.showLamp(0);
              }}
            >
              ${icon('close', 16)}
            </button>`
          : nothing
      }
      <div class="stands">
        <sillon-dial
          kind="light"
          .label="${t('light.azimuth')}: ${name}"
          .value=${Math.round(light?.azimuth ?? 0)}
          .min=${0}
          .max=${360}
          @turn=${(event: CustomEvent<number>) => {
            this.#stand(k, [event.detail % 360, light?.elevation ?? 45], 'turn');
          }}
          @settle=${() => {
            this.studio.settle();
          }}
        ></sillon-dial>
        <button
          type="button"
          @click=${() => {
            const { azimuth, elevation } = this.state.light;
            this.#stand(k, [Math.round(azimuth) % 360, Math.min(80, Math.max(15, Math.round(elevation)))]);
          }}
        >
          ${t('lamp.here')}
        </button>
        <button
          type="button"
          aria-pressed=${String(picture.lamp === null)}
          @click=${() => {
            this.#stand(k, null);
          }}
        >
          ${t('lamp.best')}
        </button>
      </div>
      ${contrast === undefined ? nothing : this.#gauge(contrast)}
    </li>`;
  }

  /** What this spool shows under this lamp, as measured on the plate. */
  #gauge(contrast: number): TemplateResult {
    const steps = greySteps(contrast);
    const words = t('lamp.gauge', { contrast: formatNumber(contrast, 1), n: steps });
    return html`<meter
        min="0"
        max=${mostSteps}
        low="12"
        optimum=${mostSteps}
        .value=${steps}
        aria-label=${words}
      ></meter>
      <span class="note gauge">${words}</span>`;
  }

  #stand(k: number, lamp: [number, number] | null, gesture?: string): void {
    const { directions } = this.state.plate;
    if (directions.kind !== 'lamp') return;
    const pictures = directions.pictures.map((one, other) => (other === k ? { ...one, lamp } : one));
    this.#set({ ...directions, pictures }, gesture === undefined ? undefined : `lamp.${k}`);
    this.studio.showLamp(k);
  }

  async #add(): Promise<void> {
    const [file] = await this.studio.pick(pictureFiles);
    if (file !== undefined) await this.studio.open([file], 'more');
  }

  #set(directions: LampSource, gesture?: string): void {
    this.studio.change((plate) => ({ ...plate, directions }), gesture);
  }
}
