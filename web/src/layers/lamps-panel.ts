// Pictures under lamps: the files, the place of each lamp, and the contrast that the spool can show.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement, property } from 'lit/decorators.js';
import { formatNumber, t } from '../i18n/text.js';
import { appearance } from '../model/appearance.js';
import { groundOf } from '../model/fills.js';
import {
  greySteps,
  lampFor,
  lampSizes,
  layersLamp,
  leastSeen,
  lightOf,
  mostPictures,
  seenOfLayer,
  shownPictures,
  weaknessesOf,
} from '../model/lamp.js';
import { completeLayers } from '../model/layers.js';
import type { LampPicture, PlateLayer } from '../model/plate.js';
import { isOf } from '../model/result.js';
import { table } from '../model/setting-table.js';
import '../controls/dial.js';
import { StudioElement } from '../controls/element.js';
import { numberField, segments } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import { panelStyle } from '../controls/panel-style.js';
import { thumbnail } from '../controls/thumbnail.js';
import { chosenFile, pictureFiles } from './add-layer.js';
import { changeIn } from './layer-field.js';
import { replacePicture } from './replace-file.js';
import { button } from '../controls/button.js';

const mostSteps = 30; // grey steps under the best lamps and spools, the end of the gauge
type SizeName = keyof typeof lampSizes;

@customElement('sillon-lamps')
export class LampsPanel extends StudioElement {
  static override reads = ['plate', 'result', 'lamp'] as const;

  @property({ attribute: false }) layer!: PlateLayer;

  static override styles = [
    panelStyle,
    css`
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
      .ends {
        display: flex;
      }
      .what b {
        display: block;
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

  override render(): TemplateResult {
    const { plate, result } = this.state;
    const { pictures } = this.layer;
    const ground = groundOf(plate) === this.layer;
    const of = completeLayers(plate).findIndex(({ id }) => id === this.layer.id);
    const seen = result !== undefined && isOf(result, plate) ? seenOfLayer(result.report.pictures, of) : undefined;
    return html`
      <ul>
        ${pictures.map((picture, k) => this.#picture(picture, k, seen?.[k]?.contrast))}
      </ul>
      <div class="buttons">
        ${button(
          { disabled: pictures.length >= mostPictures },
          html`${icon('plus', 16)} ${t('lamp.add')}`,
          () => void this.#add(),
        )}
      </div>
      ${ground ? this.#shared() : nothing}
      ${
        ground
          ? weaknessesOf(plate, seen).map(
              (weakness) =>
                html`<p class="warning">
                  ${icon('warn', 16)} <span>${t(`lamp.weak.${weakness}`, leastSeen(seen))}</span>
                </p>`,
            )
          : nothing
      }
    `;
  }

  /** Makes the fields that all pictures of the plate share. */
  #shared(): TemplateResult {
    const { pictures } = this.state.plate;
    const set = (change: Partial<typeof pictures>, gesture?: string): void =>
      this.studio.change((now) => ({ ...now, pictures: { ...now.pictures, ...change } }), gesture);
    const onSettle = (): void => this.studio.settle();
    const { smoothness, localContrast } = table.pictures;
    return html`${segments<SizeName>({
      id: 'lamp-size',
      label: t('lamp.size'),
      help: t('lamp.size.help'),
      value: (Object.keys(lampSizes) as SizeName[]).find((name) => lampSizes[name] === pictures.lampSize),
      options: (Object.keys(lampSizes) as SizeName[]).map((value) => ({ value, label: t(`lamp.size.${value}`) })),
      onChoose: (name) => set({ lampSize: lampSizes[name] }),
    })}
    ${numberField({
      id: 'source-smoothness',
      label: t('field.calm'),
      value: pictures.smoothness,
      min: smoothness.low,
      max: smoothness.high,
      step: 0.01,
      usual: [0.01, 0.5],
      unit: '',
      onInput: (value) => set({ smoothness: value }, 'pictures.smoothness'),
      onSettle,
    })}
    ${numberField({
      id: 'source-localContrast',
      label: t('field.localContrast'),
      value: Math.round(100 * pictures.localContrast),
      min: 0,
      max: 100 * localContrast.high,
      step: 1,
      usual: [0, 100 * localContrast.high],
      unit: '%',
      onInput: (percent) => set({ localContrast: percent / 100 }, 'pictures.localContrast'),
      onSettle,
    })}`;
  }

  /** Tells whether the light turns to the pictures of this layer. */
  #isShown = (): boolean => shownPictures(this.state.plate) === this.layer.pictures;

  #picture(picture: LampPicture, k: number, contrast: number | undefined): TemplateResult {
    const shown = this.#isShown() ? this.studio.lamps()[k] : undefined;
    const light = picture.lamp === null ? (shown ?? lightOf(layersLamp)) : lightOf(picture.lamp);
    const name = picture.file.name;
    const { pictures } = this.layer;
    return html`<li>
      ${thumbnail(picture.file)}
      <span class="what"
        ><b class="cut" title=${name}>${name}</b
        ><span class="note"
          >${t('lamp.stands', { azimuth: Math.round(light.azimuth), elevation: Math.round(light.elevation) })}</span
        ></span
      >
      <span class="ends">
        ${button(
          { look: 'plain square', label: `${t('verb.replace')}: ${name}`, title: t('verb.replace') },
          icon('open', 16),
          () => void this.#replace(k),
        )}
        ${
          pictures.length > 1
            ? button({ look: 'plain square', label: `${t('verb.remove')}: ${name}` }, icon('close', 16), () => {
                this.#set(pictures.filter((_, other) => other !== k));
                if (this.#isShown()) this.studio.showLamp(0);
              })
            : nothing
        }
      </span>
      <div class="stands">
        <sillon-dial
          kind="light"
          .label="${t('light.azimuth')}: ${name}"
          .value=${Math.round(light.azimuth)}
          .min=${0}
          .max=${360}
          @turn=${(event: CustomEvent<number>) => this.#stand(k, [event.detail % 360, light.elevation], 'turn')}
          @settle=${() => this.studio.settle()}
        ></sillon-dial>
        ${button({ label: `${t('lamp.here')}: ${name}` }, t('lamp.here'), () => {
          const { azimuth, elevation } = this.state.light;
          this.#stand(k, [Math.round(azimuth) % 360, Math.min(80, Math.max(15, Math.round(elevation)))]);
        })}
        ${button({ label: `${t('lamp.best')}: ${name}`, pressed: picture.lamp === null }, t('lamp.best'), () =>
          this.#stand(k, null),
        )}
      </div>
      ${contrast === undefined ? nothing : this.#gauge(contrast)}
    </li>`;
  }

  /** The contrast that this spool shows under this lamp, as measured on the plate. */
  #gauge(contrast: number): TemplateResult {
    const steps = greySteps(contrast);
    const seen = contrast < appearance.weakContrast ? 'faint' : 'clear';
    const words = t(`lamp.gauge.${seen}`, { contrast: formatNumber(contrast, 1), n: steps });
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
    const pictures = this.layer.pictures.map((one, other) => (other === k ? { ...one, lamp } : one));
    this.#set(pictures, gesture === undefined ? undefined : `lamp.${this.layer.id}.${k}`);
    if (this.#isShown()) this.studio.showLamp(k);
  }

  async #add(): Promise<void> {
    const file = await chosenFile(this.studio, pictureFiles);
    if (file === undefined) return;
    const { pictures } = this.layer;
    this.#set([...pictures, { file, lamp: lampFor(pictures, this.studio.homeLight()) }]);
  }

  async #replace(k: number): Promise<void> {
    const file = await chosenFile(this.studio, pictureFiles);
    if (file === undefined) return;
    await replacePicture(this.studio, this.layer, k, file);
  }

  #set(pictures: readonly LampPicture[], gesture?: string): void {
    changeIn(this.studio, this.layer, () => ({ pictures }), gesture);
  }
}
