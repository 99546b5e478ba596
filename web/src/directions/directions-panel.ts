// Where the beads' directions come from, what they do elsewhere, and the brushes that change both.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import {
  fileKinds,
  generatorKinds,
  newFileDirections,
  newGenerator,
  newLampDirections,
  type FileKind,
} from '../model/defaults.js';
import { lampFor } from '../model/lamp.js';
import { filesFor, filesIn, leaving, type Kind } from '../model/left.js';
import { modeChoices, pageOf, type DirectionSource, type SourceFile } from '../model/plate.js';
import { StudioElement } from '../controls/element.js';
import { DrawnChoices } from '../controls/drawn-choices.js';
import { cards, numberField, select, type Option } from '../controls/fields.js';
import { fileChip } from '../controls/file-chip.js';
import { icon } from '../controls/icons.js';
import './lamps-panel.js';
import { panelStyle } from '../controls/panel-style.js';
import { sourceField } from './source-field.js';
import { sourceRows } from './source-rows.js';

const loadColours = (): Promise<unknown> => import('./colours-panel.js');

const pictures = '.png,.jpg,.jpeg,image/*';
const isFileKind = (kind: Kind): kind is FileKind => (fileKinds as readonly string[]).includes(kind);

@customElement('sillon-directions-panel')
export class DirectionsPanel extends StudioElement {
  static override reads = ['plate', 'tool', 'brush', 'scan'] as const;

  static override styles = [
    ...StudioElement.styles,
    panelStyle,
    css`
      .strokes {
        display: flex;
        align-items: center;
        justify-content: space-between;
        min-height: var(--control);
      }
    `,
  ];

  readonly #pictures = new DrawnChoices<Kind>(this, () => this.studio.services.kindPictures);

  override render(): TemplateResult {
    const { directions } = this.state.plate;
    return html`
      <section aria-labelledby="directions-title">
        <h2 id="directions-title">${t('section.directions')}</h2>
        ${this.#picker(directions)}
        <p class="note">${t(`source.${directions.kind}.help`)}</p>
        ${'file' in directions ? fileChip(this.studio, directions.file, pictures) : nothing}
        ${directions.kind === 'lamp' ? html`<sillon-lamps .studio=${this.studio}></sillon-lamps>` : nothing}
        ${
          directions.kind === 'colours' && this.lazy(loadColours)
            ? html`<sillon-colours .studio=${this.studio}></sillon-colours>`
            : nothing
        }
        ${this.state.scan === undefined ? nothing : html`<sillon-scan-note .studio=${this.studio}></sillon-scan-note>`}
        ${sourceRows(directions).map((row) => sourceField(this.studio, row))}
      </section>
      ${directions.kind === 'lamp' ? nothing : this.#brushes()} ${this.#modes()}
    `;
  }

  #picker({ kind }: DirectionSource): TemplateResult {
    const option = (value: Kind): Option<Kind> => ({
      value,
      label: t(`source.${value}`),
      icon: value,
      picture: this.#pictures.url(value),
    });
    const group = (id: 'pictures' | 'patterns', kinds: readonly Kind[]): TemplateResult =>
      html`<h3>${t(`source.${id}`)}</h3>
        ${cards<Kind>({
          id: `source-${id}`,
          label: t(`source.${id}`),
          value: kind,
          options: kinds.map(option),
          onChoose: (chosen) => {
            void this.#choose(chosen);
          },
        })}`;
    const patterns = generatorKinds.filter((one) => one !== 'text' && one !== 'qr');
    return html`${group('pictures', ['lamp', 'tone', 'edges', 'levels', 'colours', 'map', 'text', 'qr'])}
    ${group('patterns', patterns)}`;
  }

  async #choose(kind: Kind): Promise<void> {
    const { directions } = this.state.plate;
    if (kind === directions.kind) return;
    const left = this.studio.left.directions.get(kind);
    if (!isFileKind(kind) && kind !== 'lamp' && kind !== 'colours') {
      this.#set(left ?? newGenerator(kind));
      return;
    }
    const file = this.#fileFor(kind);
    if (left !== undefined && file !== undefined && filesIn(left).includes(file)) {
      this.#set(left);
      return;
    }
    if (file !== undefined) {
      await this.#use(kind, file);
      return;
    }
    this.requestUpdate(); // the card stays as it was until a picture is there
    const files = await this.studio.pick(pictures);
    if (files.length === 0) return;
    await this.studio.open(files, kind === 'colours' ? kind : undefined);
    const chosen = this.#fileFor(kind);
    if (chosen !== undefined && this.state.plate.directions.kind !== kind) await this.#use(kind, chosen);
  }

  /** That which may tell such directions. */
  #fileFor(kind: FileKind | 'lamp' | 'colours'): SourceFile | undefined {
    const { plate } = this.state;
    if (kind === 'colours' && plate.shape.kind === 'file') return plate.shape.file;
    const isSvg = ({ bytes }: SourceFile): boolean => bytes.type === 'image/svg+xml';
    return filesFor(plate, this.studio.left).find((file) => kind !== 'lamp' || !isSvg(file)); // solved for pixels alone
  }

  async #use(kind: FileKind | 'lamp' | 'colours', file: SourceFile): Promise<void> {
    if (kind !== 'colours') {
      this.#set(this.#ofFile(kind, file));
      return;
    }
    await this.studio.attempt(async () => {
      const [{ coloursOf }, running] = await Promise.all([import('../files/drawn.js'), this.studio.services.engine()]);
      this.#set(await coloursOf(file, running));
    });
  }

  #ofFile(kind: FileKind | 'lamp', file: SourceFile): DirectionSource {
    if (kind !== 'lamp') return newFileDirections(kind, file);
    return newLampDirections([{ file, lamp: lampFor([], this.studio.homeLight()) }]);
  }

  #set(directions: DirectionSource): void {
    this.studio.left = leaving(this.state.plate, this.studio.left);
    this.studio.change((plate) => ({ ...plate, directions }));
  }

  #brushes(): TemplateResult {
    const { tool, brush, plate } = this.state;
    const setBrush = (change: Partial<typeof brush>): void => {
      this.studio.store.set({ brush: { ...this.state.brush, ...change } });
    };
    const drawing = tool !== 'pan';
    const [wide] = pageOf(plate);
    return html`<section aria-labelledby="edit-title">
      <h3 id="edit-title">${t('section.edit')}</h3>
      <p class="note">${t(`tool.${tool}.help`)}</p>
      ${
        tool === 'mode'
          ? select({
              id: 'brush-mode',
              label: t('section.modes'),
              value: brush.mode,
              options: modeChoices.map((value) => ({ value, label: t(`mode.${value}`) })),
              onChoose: (mode) => {
                setBrush({ mode });
              },
            })
          : nothing
      }
      ${
        drawing
          ? html`${numberField({
              id: 'brush-radius',
              label: t('tool.radius'),
              value: Math.round(brush.radius * 2 * wide * 10) / 10,
              min: 0.1,
              max: wide,
              step: 0.1,
              usual: [0.1, Math.max(1, Math.round(wide / 2))],
              unit: 'mm',
              onInput: (across) => {
                setBrush({ radius: across / 2 / wide });
              },
              onSettle: () => undefined,
            })}
            ${numberField({
              id: 'brush-softness',
              label: t('tool.softness'),
              value: Math.round(brush.softness * 100),
              min: 0,
              max: 100,
              step: 1,
              usual: [0, 100],
              unit: '%',
              onInput: (percent) => {
                setBrush({ softness: percent / 100 });
              },
              onSettle: () => undefined,
            })}`
          : nothing
      }
      ${
        plate.strokes.length > 0
          ? html`<div class="strokes">
              <span class="note">${t('tool.strokes', { n: plate.strokes.length })}</span>
              <button
                type="button"
                @click=${() => {
                  this.studio.change((now) => ({ ...now, strokes: [] }));
                }}
              >
                ${icon('erase', 16)} ${t('tool.clear')}
              </button>
            </div>`
          : nothing
      }
    </section>`;
  }

  #modes(): TemplateResult {
    const { mode, file } = this.state.plate.modes;
    const set = (change: { mode?: typeof mode; file?: SourceFile | undefined }): void => {
      this.studio.change((plate) => {
        const { file: kept, ...next } = { ...plate.modes, ...change };
        return { ...plate, modes: kept === undefined ? next : { ...next, file: kept } };
      });
    };
    return html`<section aria-labelledby="modes-title">
      <h3 id="modes-title">${t('section.modes')}</h3>
      ${select({
        id: 'mode-base',
        label: t('modes.base'),
        value: mode,
        options: modeChoices.map((value) => ({ value, label: t(`mode.${value}`) })),
        onChoose: (mode) => {
          set({ mode });
        },
      })}
      <p class="note">${t(`mode.${mode}.help`)}</p>
      ${
        file === undefined
          ? nothing
          : html`<p>${t('modes.map')}</p>
              ${fileChip(this.studio, file, pictures, () => {
                set({ file: undefined });
              })}`
      }
    </section>`;
  }
}
