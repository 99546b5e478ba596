// Section of the shape and its size.
import { html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { a } from '../i18n/shaping.js';
import { formatNumber, t } from '../i18n/text.js';
import { pageOf, type Plate, type ShapeSource } from '../model/plate.js';
import { settingOf, withValue } from '../model/settings.js';
import { builtinShapes, withShape } from '../model/shapes.js';
import { StudioElement } from '../controls/element.js';
import { DrawnChoices } from '../controls/drawn-choices.js';
import { cards } from '../controls/fields.js';
import { fileChip } from '../controls/file-chip.js';
import { icon } from '../controls/icons.js';
import { linked } from '../controls/linked.js';
import { panelStyle } from '../controls/panel-style.js';
import { settingField } from '../controls/setting-field.js';
import './shape-fields.js';
import { sizeFields } from './size-fields.js';
import { thicknessField } from './thickness-field.js';

const loadDrawing = (): Promise<unknown> => import('./drawing-fields.js');

@customElement('sillon-shape-panel')
export class ShapePanel extends StudioElement {
  static override reads = ['plate', 'keepRatio', 'units'] as const;

  static override styles = panelStyle;

  readonly #pictures = new DrawnChoices<ShapeSource['kind']>(this, () => this.studio.services.shapePictures);

  override render(): TemplateResult {
    const { plate } = this.state;
    const { shape } = plate;
    return html`
      <section aria-labelledby="shape-title">
        <h2 id="shape-title">${t('section.shape')}</h2>
        ${sizeFields(this.studio)} ${this.#fit(plate)} ${thicknessField(this.studio)}
      </section>
      <section aria-labelledby="outline-title">
        <h3 id="outline-title">${a('outline')}</h3>
        ${cards<ShapeSource['kind']>({
          id: 'shape-kind',
          label: t('section.shape'),
          value: shape.kind,
          options: ([...builtinShapes, 'file'] as const).map((value) => ({
            value,
            label: a(`kind.${value}`),
            icon: value,
            picture: this.#pictures.url(value),
          })),
          onChoose: (kind) => void this.#choose(kind),
        })}
        ${this.#details(shape)}
      </section>
      <section aria-label=${t('verb.rotate')}>
        <div class="buttons">
          ${this.#action('turn', t('verb.rotateLeft'), () => this.#turn(90))}
          ${this.#action('mirror', t('verb.mirror'), () => this.#mirror())}
        </div>
        ${settingField(this.studio, 'print.rotate')}
      </section>
    `;
  }

  #action(name: 'turn' | 'mirror', label: string, run: () => void): TemplateResult {
    const pressed = name === 'mirror' ? String(this.state.plate.print.mirror) : nothing;
    return html`<button aria-pressed=${pressed} @click=${run}>${icon(name, 16)} ${label}</button>`;
  }

  #turn(by: number): void {
    const setting = settingOf('print.rotate');
    this.studio.change((plate) => {
      const turned = plate.print.rotate + by;
      return withValue(plate, setting, turned > 180 ? turned - 360 : turned);
    });
  }

  #mirror(): void {
    this.studio.change((plate) => withValue(plate, settingOf('print.mirror'), !plate.print.mirror));
  }

  async #choose(kind: ShapeSource['kind']): Promise<void> {
    const { shape, width, height } = this.state.plate;
    if (shape.kind === 'file') this.studio.left = { ...this.studio.left, shape: { shape, width, height } };
    const { shape: left } = this.studio.left;
    if (kind === 'file') {
      if (left !== undefined) {
        this.studio.change((plate) => ({ ...plate, ...left }));
        return;
      }
      this.requestUpdate(); // the card stays as it was until a file is there
      await this.studio.open(await this.studio.pick('.svg,.svgz,.png,.jpg,.jpeg,image/*'));
      return;
    }
    this.studio.change((plate) => withShape(plate, kind));
  }

  #details(shape: ShapeSource): TemplateResult | typeof nothing {
    const more = html`<sillon-shape-fields class="stack" .studio=${this.studio}></sillon-shape-fields>`;
    if (shape.kind !== 'file') return more;
    return html`${fileChip(this.studio, shape.file, '.svg,.svgz,.png,.jpg,.jpeg,image/*')}
    ${
      this.lazy(loadDrawing)
        ? html`<sillon-drawing-fields class="stack" .studio=${this.studio}></sillon-drawing-fields>`
        : nothing
    }
    ${more}`;
  }

  #fit(plate: Plate): TemplateResult {
    const { printer, toolpath } = plate;
    const bed = [printer.bedMax[0] - printer.bedMin[0], printer.bedMax[1] - printer.bedMin[1]] as const;
    const box = this.studio.boxOnBed();
    const beads = Math.floor(Math.min(...pageOf(plate)) / toolpath.spacing);
    const tooLarge = box[0] > bed[0] || box[1] > bed[1];
    return html`<p class="note figures">
        ${a('size.onBed', {
          width: formatNumber(box[0], 1),
          height: formatNumber(box[1], 1),
          bedWidth: bed[0],
          bedHeight: bed[1],
        })}
      </p>
      ${tooLarge ? html`<p class="warning" role="status">${icon('warn', 16)} ${a('size.tooLarge')}</p>` : nothing}
      ${
        beads < 5
          ? html`<p class="warning" role="status">
              ${icon('warn', 16)} <span>${linked(this.studio, a('size.tooThin', { n: beads }))}</span>
            </p>`
          : nothing
      }`;
  }
}
