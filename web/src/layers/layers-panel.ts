// The panel of layers: cards for the ground, tiles that add layers on top, a list once there are several layers, and
// the fields of the chosen one.
import { html, nothing, type PropertyValues, type SVGTemplateResult, type TemplateResult } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';
import { panelStyle } from '../controls/panel-style.js';
import { DrawnChoices } from '../controls/drawn-choices.js';
import { l, layerLabel, layerName, layerNameIn } from '../i18n/layers.js';
import { warningText } from '../i18n/say-core.js';
import { t } from '../i18n/text.js';
import { groundFill, groundOf, isBare, isPictureFill, type Fill } from '../model/fills.js';
import { changeLayer, layerOf, raised, withoutLayer } from '../model/layer-list.js';
import { lackOf, type LayerKind } from '../model/layers.js';
import type { Plate, PlateLayer } from '../model/plate.js';
import { addLayer, duplicate } from './add-layer.js';
import { frameIn } from './arranging.js';
import { followBoxes } from './boxes.js';
import { brushFields } from './brush-fields.js';
import { fillCards, type FillGroup } from './fill-cards.js';
import { kindIcon, layerIcon } from './icons.js';
import { foldedFields, kindFields, modeFields } from './kind-fields.js';
import { layersStyle } from './layers-style.js';
import { middleFields, placeFields } from './place-fields.js';
import { dragRow, rowTaken } from './row-drag.js';
import { startKinds, startStyle, startTiles } from './start.js';
import { tile } from './tiles.js';
import { warnedLayers } from '../model/warned.js';
import { button } from '../controls/button.js';

/** Kinds in the order of the tiles, the most wanted first. */
const offered: readonly LayerKind[] = [
  'text',
  'code',
  'drawing',
  'picture',
  'border',
  'pattern',
  'direction',
  'tones',
  'map',
];
/** Number of tiles shown before `allTiles`. */
const first = 3;

@customElement('sillon-layers-panel')
export class LayersPanel extends StudioElement {
  static override reads = [
    'plate',
    'layer',
    'cropping',
    'layerBoxes',
    'result',
    'tool',
    'brush',
    'scan',
    'welcome',
  ] as const;

  static override styles = [panelStyle, layersStyle, startStyle];

  @state() private adding = false;
  @state() private allTiles = false;
  @state() private locked = true;
  @state() private unfolded = false;
  /** Id of the layer whose row is being dragged. */
  @state() private held: number | undefined;
  #focus = '';
  readonly #pictures = new DrawnChoices<Fill>(this, () => this.studio.services.fillPictures);

  override connectedCallback(): void {
    super.connectedCallback();
    followBoxes(this.studio);
  }

  override render(): TemplateResult {
    const { plate, layer, tool, welcome } = this.state;
    const layers = [...plate.layers].reverse();
    const warned = warnedLayers(this.state);
    const ground = groundOf(plate);
    const bare = isBare(plate);
    const chosen = bare ? ground : layerOf(plate, layer);
    return html`<section aria-labelledby="layers-title">
        <h2 id="layers-title">${bare ? t('start.title') : l('title')}</h2>
        ${bare ? this.#start() : this.#list(layers, chosen, warned)}
        ${!bare && chosen === ground ? this.#cards() : nothing}
      </section>
      ${
        tool === 'pan'
          ? nothing
          : html`<section aria-labelledby="edit-title">
              <h3 id="edit-title">${t('section.edit')}</h3>
              ${brushFields(this.studio)}
            </section>`
      }
      ${chosen === undefined || welcome ? nothing : this.#fields(chosen, chosen === ground)} `;
  }

  #list(
    layers: readonly PlateLayer[],
    chosen: PlateLayer | undefined,
    warned: ReturnType<typeof warnedLayers>,
  ): TemplateResult {
    return html`<ul aria-label=${l('list')} @keydown=${this.#onListKey} @pointerdown=${this.#onListDown}>
        ${layers.map((one) => this.#row(one, one === chosen, warned.has(one)))}
      </ul>
      ${
        /* Below the list, whose rows would else change their places under a hand that drags one. */
        layers.flatMap((one) =>
          (warned.get(one) ?? []).map(
            (words) =>
              html`<p class="warning" role="status">
                <b>${layerNameIn(this.state.plate.layers, one)}</b> ${warningText(words)}
              </p>`,
          ),
        )
      }
      ${this.#adder()}`;
  }

  #start(): TemplateResult {
    const { plate, welcome } = this.state;
    const fill = groundFill(plate);
    const more = (): void => {
      this.allTiles = !this.allTiles;
    };
    return html`${welcome ? html`<p class="note">${t('start.what')}</p>` : nothing}
    ${startTiles(this.studio, (kind) => void this.#add(kind), more, this.allTiles)}
    ${
      this.allTiles
        ? html`${this.#cards()}
            <h3>${l('add')}</h3>
            ${this.#tiles()}`
        : fill === undefined || welcome
          ? html`<p class="note">${t('start.drop')}</p>`
          : this.#cards([isPictureFill(fill) ? 'pictures' : 'patterns'])
    }`;
  }

  #cards(groups?: readonly FillGroup[]): TemplateResult {
    const fill = groundFill(this.state.plate);
    return html`${fillCards(this.studio, (one) => this.#pictures.url(one), groups)}
    ${fill === undefined ? nothing : html`<p class="note">${t(`source.${fill}.help`)}</p>`}`;
  }

  /** Adds layers behind a button, since tiles would take the room of the fields where there is a list already. */
  #adder(): TemplateResult {
    return html`<button
        id="add"
        aria-expanded=${String(this.adding)}
        aria-controls="kinds"
        @click=${() => {
          this.adding = !this.adding;
        }}
      >
        ${icon('plus', 16)} ${l('add')}
      </button>
      ${this.adding ? this.#tiles() : nothing}`;
  }

  #tiles(): TemplateResult {
    const added = isBare(this.state.plate) ? offered.filter((kind) => !startKinds.has(kind)) : offered;
    const kinds = this.allTiles ? added : added.slice(0, first);
    return html`<div class="tiles" id="kinds" role="group" aria-label=${l('add')}>
      ${kinds.map((kind) =>
        button('', html`${tile(kind)}<span>${l(`kind.${kind}`)}</span>`, () => void this.#add(kind)),
      )}
      ${
        this.allTiles
          ? nothing
          : html`<button
              id="more-kinds"
              @click=${() => {
                this.allTiles = true;
              }}
            >
              ${icon('more', 22)}<span>${l('others')}</span>
            </button>`
      }
    </div>`;
  }

  async #add(kind: LayerKind): Promise<void> {
    if (!(await addLayer(this.studio, kind))) return;
    this.adding = false;
    this.allTiles = false;
    this.#focus = kind === 'text' || kind === 'code' ? '#layer-text' : '[aria-pressed=true].row';
    this.requestUpdate();
  }

  #row(layer: PlateLayer, chosen: boolean, warned: boolean): TemplateResult {
    const name = layerNameIn(this.state.plate.layers, layer);
    const lack = lackOf(layer);
    const look = `${chosen ? 'chosen' : ''} ${this.held === layer.id ? 'held' : ''} ${warned ? 'warned' : ''}`;
    return html`<li class=${look} data-layer=${layer.id}>
      <span class="grip" title=${l('drag')} aria-hidden="true">${layerIcon('grip', 16)}</span>
      ${button(
        { look: 'plain row', pressed: chosen },
        html`${lack === undefined && !warned ? kindIcon(layer) : icon('warn', 18)}
          <span class=${layer.visible ? 'name cut' : 'name cut off'}>${name}</span>`,
        () => this.studio.store.set({ layer: chosen ? undefined : layer.id, cropping: false, tool: 'pan' }),
      )}
      ${button(
        { look: 'plain square', name: l(layer.visible ? 'hide' : 'show', { name }) },
        layerIcon(layer.visible ? 'eye' : 'hidden'),
        () => this.#change((plate) => changeLayer(plate, layer.id, ({ visible }) => ({ visible: !visible }))),
      )}
      ${chosen ? this.#actions(layer, name) : nothing}
    </li>`;
  }

  #actions(layer: PlateLayer, name: string): TemplateResult {
    const { id } = layer;
    const { layers } = this.state.plate;
    const action = (
      what: 'up' | 'down' | 'duplicate' | 'delete',
      image: SVGTemplateResult,
      disabled: boolean,
      run: () => void,
    ): TemplateResult => button({ look: 'plain square', name: l(what, { name }), disabled: disabled }, image, run);
    const raise = (by: number) => (): void => this.#change((plate) => raised(plate, id, by));
    return html`<div class="actions">
      ${action('up', layerIcon('up', 16), layers.at(-1)?.id === id, raise(1))}
      ${action('down', layerIcon('down', 16), layers[0]?.id === id, raise(-1))}
      ${action('duplicate', icon('copy', 16), false, () => void duplicate(this.studio, layer))}
      ${action('delete', icon('bin', 16), false, () => this.#remove(id))}
    </div>`;
  }

  /** Deletes a layer and moves the focus to the row that takes its place. */
  #remove(id: number): void {
    const { layers } = this.state.plate;
    const at = layers.findIndex((layer) => layer.id === id);
    const next = layers[at - 1] ?? layers[at + 1];
    this.#change((plate) => withoutLayer(plate, id));
    this.studio.store.set({ layer: next?.id, cropping: false });
    this.#focus = next === undefined ? '.tiles button' : '[aria-pressed=true].row, input[type=radio]:checked';
  }

  /** Changes the plate as one undo step of its own. */
  #change(change: (plate: Plate) => Plate): void {
    this.studio.settle();
    this.studio.change(change);
  }

  #onListKey = (event: KeyboardEvent): void => {
    const row = (event.target as HTMLElement).closest<HTMLElement>('button.row');
    const id = Number(row?.closest<HTMLElement>('li')?.dataset['layer']);
    if (row === null || Number.isNaN(id)) return;
    const rows = [...this.renderRoot.querySelectorAll<HTMLElement>('button.row')];
    const by = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (by !== undefined && event.altKey) {
      this.#change((plate) => raised(plate, id, -by));
      this.#focus = `li[data-layer='${id}'] .row`;
    } else if (by !== undefined) rows[rows.indexOf(row) + by]?.focus();
    else if (event.key === 'Delete') this.#remove(id);
    else return;
    event.preventDefault();
  };

  #onListDown = (event: PointerEvent): void => {
    const id = rowTaken(event);
    if (id === undefined) return;
    dragRow(this.studio, id, event, {
      rows: () => [...this.renderRoot.querySelectorAll<HTMLElement>('li[data-layer]')],
      hold: (held) => {
        this.held = held;
        if (held === undefined) this.#focus = `li[data-layer='${id}'] .row`;
      },
    });
  };

  protected override updated(_changed: PropertyValues): void {
    this.renderRoot.querySelector('.held')?.scrollIntoView({ block: 'nearest' });
    if (this.#focus === '') return;
    const wanted = this.renderRoot.querySelector<HTMLElement>(this.#focus);
    if (wanted === null) return;
    this.#focus = '';
    wanted.focus();
    if (wanted instanceof HTMLTextAreaElement) wanted.select();
  }

  // --- The chosen one -------------------------------------------------------------------------------------------------------

  #fields(layer: PlateLayer, ground: boolean): TemplateResult {
    const lack = lackOf(layer);
    return html`<section aria-labelledby="layer-title">
        <h3 id="layer-title">
          ${ground ? layerName({ ...layer, file: null, pictures: [] }) : l(`kind.${layer.kind}`)}
        </h3>
        ${kindFields(this.studio, layer)}
        ${
          lack === undefined
            ? nothing
            : html`<p class="warning">${icon('warn', 16)} <span>${l(`lack.${lack}`)}</span></p>`
        }
      </section>
      ${ground ? this.#groundFields(layer) : this.#topFields(layer)}`;
  }

  #groundFields(layer: PlateLayer): TemplateResult {
    return html`${
        layer.kind === 'pattern'
          ? html`<section aria-labelledby="layer-place-title">
              <h3 id="layer-place-title">${layerLabel({ id: 'layers.at' })}</h3>
              ${middleFields(this.studio, layer)}
            </section>`
          : nothing
      }
      <section aria-labelledby="modes-title">
        <h3 id="modes-title">${t('section.modes')}</h3>
        ${modeFields(this.studio, layer)}
      </section>`;
  }

  #topFields(layer: PlateLayer): TemplateResult | typeof nothing {
    if (layer.kind === 'strokes') return nothing;
    return html`${
        layer.kind === 'border'
          ? nothing
          : html`<section aria-labelledby="layer-place-title">
              <h3 id="layer-place-title">${layerLabel({ id: 'layers.at' })}</h3>
              ${placeFields(this.studio, layer, frameIn(this.state, layer), {
                locked: this.locked,
                toggle: () => {
                  this.locked = !this.locked;
                },
              })}
              <p class="note">
                ${l('hand')} ${layer.kind === 'pattern' && layer.pattern === 'waves' ? l('hand.waves') : nothing}
              </p>
            </section>`
      }
      <section>
        <details
          .open=${this.unfolded}
          @toggle=${(event: Event) => {
            this.unfolded = (event.currentTarget as HTMLDetailsElement).open;
          }}
        >
          <summary>${icon('fold', 16)} ${l('more')}</summary>
          <div class="rows">${this.unfolded ? foldedFields(this.studio, layer) : nothing}</div>
        </details>
      </section>`;
  }
}
