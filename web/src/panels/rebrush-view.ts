// A sliced print, to be re-brushed: all over the page, above the plate, which stays as it is. Its top faces are listed and
// seen from above; new beads are laid as soon as something is chosen, and the same kind of file is downloaded.
import { css, html, nothing, type PropertyValues, type TemplateResult } from 'lit';
import type { Cycle, PrintRelief, Rebrushed, SlicedFile } from 'sillon';
import { customElement, query, state } from 'lit/decorators.js';
import { live } from 'lit/directives/live.js';
import { download } from '../files/download.js';
import { isSliced } from '../files/open.js';
import { readable } from '../files/readable.js';
import { brushedName } from '../files/sliced.js';
import { sourceFile } from '../files/source-file.js';
import { r, type RebrushTextId } from '../i18n/rebrush.js';
import { filamentLabel, problemWords } from '../i18n/say.js';
import { formatBytes, formatDuration, formatNumber, t } from '../i18n/text.js';
import { filaments, lookOf } from '../model/filaments.js';
import { lampFor } from '../model/lamp.js';
import { isAbort, problemOf, StudioError, type Problem } from '../model/problem.js';
import { fits, howOf, lackOf, topsOf, type Face, type Wish } from '../model/rebrush.js';
import { TimeLeft } from '../model/time-left.js';
import type { Light } from '../model/view.js';
import './dial.js';
import { StudioElement } from './element.js';
import { numberInput, segments, select } from './fields.js';
import { icon } from './icons.js';
import './rebrush-bench.js';
import { thumbnail } from './thumbnail.js';

const mostBytes = 256e6; // as the engine reads of text
const reliefSide = 1600; // cells: a few per bead of a print of 200 mm
const restAfter = 350; // [ms] without a change, after which beads are laid
const pictureFiles = 'image/*,.tga';

interface Progress {
  fraction: number;
  secondsLeft: number | undefined;
}

@customElement('sillon-rebrush')
export class RebrushView extends StudioElement {
  static override reads = ['sliced', 'theme'] as const;

  static override styles = [
    ...StudioElement.styles,
    css`
      dialog {
        width: 100vw;
        max-width: none;
        height: 100dvh;
        max-height: none;
        border: 0;
        border-radius: 0;
        box-shadow: none;
      }
      dialog[open] {
        display: grid;
        grid-template: auto minmax(0, 1fr) / minmax(0, 1fr) 360px;
      }
      dialog > .head {
        grid-column: 1 / -1;
        min-height: var(--bar);
        padding: 8px 12px;
        border-bottom: 1px solid var(--line);
        justify-content: start;
      }
      .head h2 {
        flex: 1;
        min-width: 0;
        overflow: hidden;
        font-size: var(--lead);
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      .head h2:focus {
        outline: none; /* where reading begins: there is nothing to press */
      }
      .side {
        display: grid;
        grid-template: minmax(0, 1fr) auto / minmax(0, 1fr);
        min-height: 0;
        border-left: 1px solid var(--line);
      }
      .scroll {
        display: grid;
        grid-template-columns: minmax(0, 1fr);
        align-content: start;
        gap: 22px;
        padding: 16px;
        overflow: auto;
        overscroll-behavior: contain;
        scrollbar-width: thin;
        scrollbar-color: var(--line) transparent;
      }
      section {
        display: grid;
        grid-template-columns: minmax(0, 1fr);
        gap: 10px;
        min-width: 0;
      }
      .title {
        display: flex;
        align-items: baseline;
        gap: 4px 10px;
        flex-wrap: wrap;
      }
      .title h3 {
        flex: 1;
      }
      .faces {
        display: grid;
        max-height: 264px;
        overflow: auto;
        border: 1px solid var(--line);
        border-radius: var(--radius);
        background: var(--raised);
        scrollbar-width: thin;
      }
      .faces label {
        display: grid;
        grid-template-columns: auto 1fr auto;
        align-items: center;
        gap: 0 10px;
        min-height: 40px;
        padding: 5px 10px;
        cursor: pointer;
      }
      .faces li + li {
        border-top: 1px solid var(--line);
      }
      .faces label:has(:focus-visible) {
        outline: 2px solid var(--accent);
        outline-offset: -2px;
      }
      .faces input {
        width: 16px;
        height: 16px;
        margin: 0;
        accent-color: var(--accent);
      }
      .faces .what {
        display: grid;
        min-width: 0;
        overflow-wrap: anywhere;
      }
      @media (hover: hover) {
        .faces label:hover {
          background: var(--hover);
        }
      }
      details ul {
        display: grid;
        gap: 4px;
        padding-left: 2px;
      }
      .angle,
      .stands {
        display: grid;
        grid-template-columns: auto 1fr auto;
        align-items: center;
        gap: 4px 12px;
      }
      .angle sillon-dial,
      .stands sillon-dial {
        width: 52px;
        height: 52px;
      }
      .stands > span {
        display: grid;
        grid-column: span 2;
      }
      .picture {
        display: grid;
        grid-template-columns: 64px 1fr auto;
        align-items: center;
        gap: 10px;
      }
      .picture img {
        width: 64px;
        height: 64px;
        object-fit: cover;
        border-radius: var(--radius);
      }
      .picture b {
        overflow: hidden;
        font-weight: 500;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      .foot {
        display: grid;
        grid-template-columns: minmax(0, 1fr);
        gap: 10px;
        padding: 12px 16px calc(12px + env(safe-area-inset-bottom));
        border-top: 1px solid var(--line);
      }
      .foot button.main {
        min-height: calc(var(--control) + 8px);
      }
      .foot button.main span {
        min-width: 0;
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      .job {
        display: grid;
        grid-template-columns: 1fr auto;
        align-items: center;
        gap: 6px 10px;
      }
      .bar {
        grid-column: 1 / -1;
        height: 3px;
        border-radius: 2px;
        background: var(--line);
        overflow: hidden;
      }
      .bar div {
        height: 100%;
        width: calc(100% * var(--share));
        background: var(--accent);
      }
      .problem {
        display: grid;
        grid-template-columns: auto 1fr;
        gap: 8px;
        padding: 10px 12px;
        border-radius: var(--radius);
        background: var(--bad-tint);
      }
      .problem .icon {
        color: var(--bad);
      }
      .problem p {
        overflow-wrap: anywhere;
      }
      .problem div {
        display: grid;
        gap: 4px;
      }
      .buttons {
        display: flex;
        flex-wrap: wrap;
        gap: 8px;
      }
      .alone {
        grid-column: 1 / -1;
        display: grid;
        place-content: center;
        gap: 16px;
        width: min(560px, 100%);
        margin: auto;
        padding: 24px;
      }
      .alone .job {
        width: min(420px, 80vw);
      }
      .bar.unknown div {
        width: 30%;
      }
      @media (prefers-reduced-motion: no-preference) {
        .bar.unknown div {
          animation: pass 1.2s linear infinite;
        }
        @keyframes pass {
          from {
            transform: translateX(-100%);
          }
          to {
            transform: translateX(340%);
          }
        }
      }
      @media (max-width: 720px) {
        dialog[open] {
          grid-template: auto minmax(0, 2fr) minmax(0, 3fr) / minmax(0, 1fr);
        }
        .side {
          border-left: 0;
          border-top: 1px solid var(--line);
        }
        .faces {
          max-height: none;
        }
        .back span {
          position: absolute;
          clip-path: inset(50%);
        }
      }
      /* A low page scrolls as a whole: the bench is not worth its room there. */
      @media (max-height: 480px) {
        dialog[open] {
          grid-template: auto minmax(0, 1fr) / minmax(0, 1fr) minmax(0, 1fr);
        }
        .side {
          display: block;
          overflow: auto;
        }
        .scroll,
        .faces {
          overflow: visible;
          max-height: none;
        }
      }
    `,
  ];

  @query('dialog') private dialog!: HTMLDialogElement;

  @state() private print: SlicedFile | undefined;
  @state() private relief: PrintRelief | undefined;
  @state() private faces: readonly Face[] = [];
  @state() private wish!: Wish;
  @state() private done: Rebrushed | undefined;
  /** Of the choices as they are now. */
  @state() private fresh = false;
  @state() private laid: ReadonlyMap<number, readonly Cycle[]> = new Map<number, readonly Cycle[]>();
  @state() private progress: Progress | undefined;
  @state() private cancelled = false;
  @state() private problem: Problem | undefined;
  @state() private marked: number | undefined;
  @state() private light!: Light;
  @state() private saved = '';
  @state() private darkScheme = matchMedia('(prefers-color-scheme: dark)').matches;

  #file: File | undefined;
  #job: AbortController | undefined;
  #rest: ReturnType<typeof setTimeout> | undefined;
  readonly #end = new AbortController();

  // --- The page -----------------------------------------------------------------------------------------------------------

  override connectedCallback(): void {
    super.connectedCallback();
    const { plate } = this.state;
    const { azimuth, elevation } = this.studio.homeLight();
    this.light = { azimuth: Math.round(azimuth), elevation: Math.round(elevation) };
    this.wish = {
      chosen: new Set(),
      way: 'angle',
      angle: plate.directions.kind === 'angle' ? plate.directions.angle : 30,
      picture: undefined,
      lamp: lampFor([], this.light),
      spool: plate.filament,
      fit: 'face',
    };
    const { signal } = this.#end;
    // Before the page below hears of them.
    for (const name of ['dragover', 'drop', 'paste'] as const) {
      addEventListener(name, this.#onFiles, { signal, capture: true });
    }
    matchMedia('(prefers-color-scheme: dark)').addEventListener(
      'change',
      ({ matches }) => {
        this.darkScheme = matches;
      },
      { signal },
    );
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearTimeout(this.#rest);
    this.#job?.abort();
    this.#end.abort();
  }

  override firstUpdated(): void {
    this.dialog.showModal();
  }

  override updated(_changed: PropertyValues): void {
    const { sliced } = this.state;
    if (sliced === undefined || sliced === this.#file) return;
    this.#file = sliced;
    void this.#read(sliced);
  }

  #onFiles = (event: DragEvent | ClipboardEvent): void => {
    const transfer = event instanceof DragEvent ? event.dataTransfer : event.clipboardData;
    if (transfer === null || !transfer.types.includes('Files')) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    if (event.type !== 'dragover') void this.#take([...transfer.files]);
  };

  /** Another print, or a picture. */
  async #take(files: readonly File[]): Promise<void> {
    const [file] = files;
    if (file === undefined) return;
    if (await isSliced([file])) {
      this.studio.store.set({ sliced: file });
      return;
    }
    if (this.print === undefined) return;
    await this.#try(async () => {
      const given = await readable(file);
      const bytes = new Uint8Array(await given.arrayBuffer());
      await (await this.studio.services.engine()).decodePicture(bytes);
      const picture = await sourceFile(given.name, bytes);
      this.#want({ picture, way: 'picture', lamp: lampFor([], this.light) });
    });
  }

  async #pick(accept: string): Promise<void> {
    await this.#take(await this.studio.pick(accept));
  }

  async #try(action: () => Promise<void>): Promise<void> {
    try {
      await action();
    } catch (error) {
      if (!isAbort(error)) this.problem = problemOf(error);
    }
  }

  // --- The print ------------------------------------------------------------------------------------------------------------

  async #read(file: File): Promise<void> {
    clearTimeout(this.#rest);
    this.#job?.abort();
    const job = new AbortController();
    this.#job = job;
    this.print = undefined;
    this.relief = undefined;
    this.done = undefined;
    this.problem = undefined;
    this.saved = '';
    this.faces = [];
    this.laid = new Map();
    this.progress = { fraction: 0, secondsLeft: undefined };
    const { signal } = job;
    try {
      if (file.size > mostBytes) {
        const values = { name: file.name, mb: Math.ceil(file.size / 1e6), most: mostBytes / 1e6 };
        throw new StudioError('TooLarge', {}, r('tooLarge', values));
      }
      const engine = await this.studio.services.engine();
      // In workers of their own, side by side. What is seen of the print is no reason to refuse it.
      const seen = engine.printRelief(file, reliefSide, { signal }).catch(() => undefined);
      const print = await engine.listSurfaces(file, { signal });
      if (signal.aborted) return;
      const faces = topsOf(print.surfaces);
      const free = faces.filter(({ left }) => left === '').map(({ index }) => index);
      this.relief = await seen;
      if (signal.aborted as boolean) return;
      this.print = print;
      this.faces = faces;
      this.wish = { ...this.wish, chosen: new Set(free) };
      this.progress = undefined;
      if (free.length > 0) void this.#lay();
    } catch (error) {
      if (signal.aborted) return;
      this.progress = undefined;
      if (!isAbort(error)) this.problem = problemOf(error);
    }
  }

  /** What is wanted now; beads follow. */
  #want(change: Partial<Wish>): void {
    this.wish = { ...this.wish, ...change };
    this.problem = undefined;
    this.fresh = false;
    this.saved = '';
    this.cancelled = false;
    this.#job?.abort();
    this.progress = undefined;
    clearTimeout(this.#rest);
    if (lackOf(this.wish) !== '') return;
    this.progress = { fraction: 0, secondsLeft: undefined };
    this.#rest = setTimeout(() => void this.#lay(), restAfter);
  }

  async #lay(): Promise<void> {
    const file = this.#file;
    if (file === undefined) return;
    this.#job?.abort();
    const job = new AbortController();
    this.#job = job;
    const { signal } = job;
    const { wish } = this;
    this.fresh = false;
    this.cancelled = false;
    this.problem = undefined;
    this.progress = { fraction: 0, secondsLeft: undefined };
    const timeLeft = new TimeLeft(performance.now());
    try {
      const { services } = this.studio;
      const { plate } = this.state;
      const drawn = wish.way === 'plate' && plate.directions.kind !== 'lamp' ? await services.directions() : undefined;
      const engine = await services.engine();
      if (signal.aborted) return;
      const how = howOf(wish, this.#free(), plate, drawn);
      const done = await engine.rebrush(file, how, {
        signal,
        onProgress: ({ fraction }) => {
          if (signal.aborted) return;
          this.progress = { fraction, secondsLeft: timeLeft.estimate(fraction, performance.now()) };
        },
      });
      if (signal.aborted as boolean) return;
      this.done = done;
      this.laid = new Map(done.surfaces.map(({ index, cycles }) => [index, cycles]));
      this.fresh = true;
    } catch (error) {
      if (signal.aborted || isAbort(error)) return;
      this.problem = problemOf(error);
    }
    this.progress = undefined;
  }

  #cancel = (): void => {
    clearTimeout(this.#rest);
    this.#job?.abort();
    this.progress = undefined;
    this.cancelled = true;
  };

  #free = (): Face[] => this.faces.filter(({ left }) => left === '');

  #toggle(index: number): void {
    if (!this.#free().some((face) => face.index === index)) return;
    const chosen = new Set(this.wish.chosen);
    if (!chosen.delete(index)) chosen.add(index);
    this.#want({ chosen });
  }

  #save = (): void => {
    if (this.done === undefined || this.#file === undefined) return;
    const name = brushedName(this.#file.name);
    download(this.done.blob, name); // the visitor's own file: no page around this one is given it
    this.saved = r('saved', { name });
  };

  #close = (): void => {
    this.dialog.close();
  };

  // --- What is shown ----------------------------------------------------------------------------------------------------------

  override render(): TemplateResult {
    const name = this.state.sliced?.name ?? '';
    return html`<dialog
      aria-labelledby="title"
      @close=${() => {
        this.studio.store.set({ dialog: undefined, sliced: undefined });
      }}
    >
      <div class="head">
        <button type="button" class="back" @click=${this.#close} aria-label=${r('back')}>
          ${icon('previous', 16)} <span>${r('back')}</span>
        </button>
        <h2 id="title" title=${name} tabindex="-1" autofocus>${r('title', { name })}</h2>
      </div>
      ${this.print === undefined || this.#free().length === 0 ? this.#alone(name) : this.#work(this.print)}
    </dialog>`;
  }

  /** While it is read, and where nothing can be done with it. */
  #alone(name: string): TemplateResult {
    if (this.progress !== undefined) {
      return html`<div class="alone">${this.#bar(r('reading', { name }), undefined)}</div>`;
    }
    const { print, problem } = this;
    const left = this.#leftReasons(this.faces);
    const message =
      print === undefined ? r('unreadable', { name }) : r(this.faces.length === 0 ? 'noTops' : 'noFaces', { name });
    return html`<div class="alone">
      <div class="problem" role="alert">
        ${icon('warn')}
        <div>
          <p><b>${message}</b></p>
          ${problem === undefined ? nothing : html`<p>${problem.detail}</p>`}
          ${print === undefined ? html`<p class="note">${r('unreadableHelp')}</p>` : left}
        </div>
      </div>
      <div class="buttons">
        <button type="button" class="main" @click=${this.#close}>${r('back')}</button>
        ${this.#another()}
      </div>
    </div>`;
  }

  #another = (): TemplateResult =>
    html`<button type="button" @click=${() => void this.#pick('')}>${icon('open', 16)} ${r('another')}</button>`;

  #work(print: SlicedFile): TemplateResult {
    const { wish, light } = this;
    const { plate, theme, sliced } = this.state;
    const lamps = wish.way === 'picture' ? { azimuth: wish.lamp[0], elevation: wish.lamp[1] } : light;
    return html`<sillon-rebrush-bench
        .relief=${this.relief}
        .faces=${this.faces}
        .chosen=${wish.chosen}
        .laid=${this.laid}
        .marked=${this.marked}
        .home=${lamps}
        .filament=${lookOf({ ...plate, filament: wish.spool })}
        .lit=${wish.way === 'picture'}
        .dark=${theme === 'auto' ? this.darkScheme : theme === 'dark'}
        @toggle-face=${(event: CustomEvent<number>) => {
          this.#toggle(event.detail);
        }}
      ></sillon-rebrush-bench>
      <div class="side">
        <div class="scroll">
          <section>
            <p class="note">
              ${r('print', { program: print.program, n: print.layers, size: formatBytes(sliced?.size ?? 0) })}
            </p>
            <div class="buttons">${this.#another()}</div>
          </section>
          ${this.#list()} ${this.#directions()}
          <p class="note">${r('untried')}</p>
        </div>
        <div class="foot">${this.#foot(print)}</div>
      </div>`;
  }

  #list(): TemplateResult {
    const { wish } = this;
    const free = this.#free();
    const rest = this.faces.filter(({ left }) => left !== '');
    const chosen = free.filter(({ index }) => wish.chosen.has(index));
    const area = chosen.reduce((sum, { areaMm2 }) => sum + areaMm2, 0);
    return html`<section>
      <div class="title">
        <h3 id="faces">${r('faces')}</h3>
        <button
          type="button"
          class="link"
          @click=${() => {
            this.#want({ chosen: new Set(free.map(({ index }) => index)) });
          }}
        >
          ${r('all')}
        </button>
        <button
          type="button"
          class="link"
          @click=${() => {
            this.#want({ chosen: new Set() });
          }}
        >
          ${r('none')}
        </button>
      </div>
      <ul class="faces" aria-labelledby="faces">
        ${free.map((face) => this.#face(face))}
      </ul>
      <p class="note" role="status">
        ${r('chosen', { n: chosen.length, all: free.length, area: formatNumber(area, 0) })}
      </p>
      ${
        rest.length === 0
          ? nothing
          : html`<details>
              <summary>${icon('fold', 16)} ${r('left', { n: rest.length })}</summary>
              ${this.#leftReasons(rest)}
            </details>`
      }
    </section>`;
  }

  #face(face: Face): TemplateResult {
    const { index, layer, z, areaMm2, object } = face;
    const made = this.fresh ? this.done?.surfaces.find((one) => one.index === index) : undefined;
    const mark = (marked: number | undefined) => () => {
      this.marked = marked;
    };
    return html`<li @pointerenter=${mark(index)} @pointerleave=${mark(undefined)}>
      <label>
        <input
          type="checkbox"
          .checked=${live(this.wish.chosen.has(index))}
          @change=${() => {
            this.#toggle(index);
          }}
          @focus=${mark(index)}
          @blur=${mark(undefined)}
        />
        <span class="what"
          ><span>${r('face', { layer, z: formatNumber(z) })}</span>${
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
  #leftReasons(faces: readonly Face[]): TemplateResult | typeof nothing {
    if (faces.length === 0) return nothing;
    const groups = grouped(faces);
    return html`<ul>
      ${[...groups].map(([reason, list]) => {
        const area = formatNumber(
          list.reduce((sum, { areaMm2 }) => sum + areaMm2, 0),
          1,
        );
        const why = reason === '' ? (list[0]?.left ?? '') : r(`left.${reason}` as RebrushTextId);
        return html`<li class="note">${r('why', { why, n: list.length, area })}</li>`;
      })}
    </ul>`;
  }

  #directions(): TemplateResult {
    const { wish } = this;
    const { way } = wish;
    return html`<section>
      ${segments({
        id: 'way',
        label: r('directions'),
        value: way,
        options: [
          { value: 'angle', label: r('way.angle'), icon: 'angle' },
          { value: 'plate', label: r('way.plate'), icon: 'directions' },
          { value: 'picture', label: r('way.picture'), icon: 'lamp' },
        ],
        onChoose: (next) => {
          this.#want({ way: next });
        },
      })}
      ${way === 'angle' ? this.#angle() : nothing}
      ${way === 'plate' ? html`<p class="note">${r('plate.help')}</p>` : nothing}
      ${way === 'picture' ? this.#picture() : nothing}
      ${
        way === 'angle'
          ? nothing
          : select({
              id: 'fit',
              label: r('fit'),
              value: wish.fit,
              options: fits.map((value) => ({ value, label: r(`fit.${value}`) })),
              onChoose: (fit) => {
                this.#want({ fit });
              },
            })
      }
      ${way === 'picture' ? this.#lamp() : this.#light()}
    </section>`;
  }

  #angle(): TemplateResult {
    const { angle } = this.wish;
    const set = (value: number): void => {
      this.#want({ angle: value });
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

  #picture(): TemplateResult {
    const { picture } = this.wish;
    const choose = (): void => void this.#pick(pictureFiles);
    if (picture === undefined) {
      return html`<p class="note">${r('picture.help')}</p>
        <div class="buttons">
          <button type="button" class="main" @click=${choose}>${icon('open', 16)} ${r('picture.choose')}</button>
        </div>`;
    }
    const seen = this.fresh ? (this.done?.surfaces ?? []).flatMap(({ pictures }) => pictures.map((one) => one.r)) : [];
    const mean = seen.reduce((sum, one) => sum + one, 0) / seen.length;
    return html`<div class="picture">
        ${thumbnail(picture)}<b title=${picture.name}>${picture.name}</b>
        <button type="button" class="plain" @click=${choose}>${t('verb.replace')}</button>
      </div>
      ${
        seen.length === 0
          ? nothing
          : html`<p class="note">${r('picture.seen', { percent: Math.round(100 * Math.max(0, mean)) })}</p>`
      }
      ${select({
        id: 'spool',
        label: r('spool'),
        value: this.wish.spool,
        options: filaments.map((filament) => ({ value: filament.key, label: filamentLabel(filament) })),
        onChoose: (spool) => {
          this.#want({ spool });
        },
      })}`;
  }

  /** Of the picture: it is solved for it. */
  #lamp(): TemplateResult {
    const [azimuth, elevation] = this.wish.lamp;
    return this.#stands('lamp', azimuth, elevation, 15, 80, (lamp) => {
      this.#want({ lamp });
    });
  }

  /** Only to look at the beads. */
  #light(): TemplateResult {
    const { azimuth, elevation } = this.light;
    return this.#stands('light', azimuth, elevation, 5, 90, ([a, e]) => {
      this.light = { azimuth: a, elevation: e };
    });
  }

  #stands(
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

  #bar(what: string, fraction: number | undefined, rest = ''): TemplateResult {
    const percent = fraction === undefined ? undefined : Math.floor(100 * fraction);
    return html`<div class="job">
      <span role="status">${what}</span>
      <button type="button" @click=${fraction === undefined ? this.#close : this.#cancel}>${t('verb.cancel')}</button>
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

  #foot(print: SlicedFile): TemplateResult {
    const { progress, problem, fresh, done, wish } = this;
    const lack = lackOf(wish);
    const name = brushedName(this.state.sliced?.name ?? '');
    return html`${
        progress === undefined
          ? nothing
          : this.#bar(
              r('making', {
                k: Math.min(wish.chosen.size, 1 + Math.floor(progress.fraction * wish.chosen.size)),
                n: wish.chosen.size,
              }),
              progress.fraction,
              progress.secondsLeft === undefined
                ? ''
                : t('progress.left', { time: formatDuration(progress.secondsLeft) }),
            )
      }
      ${problem === undefined ? nothing : this.#failed(problem)}
      ${lack === '' ? nothing : html`<p class="note" role="status">${r(lack)}</p>`}
      ${
        this.cancelled || (problem !== undefined && lack === '')
          ? html`<div class="buttons">
              ${this.cancelled ? html`<span role="status">${r('cancelled')}</span>` : nothing}
              <button type="button" @click=${() => void this.#lay()}>${r('again')}</button>
            </div>`
          : nothing
      }
      ${fresh && done !== undefined ? this.#ready(done, print) : nothing}
      <button type="button" class="main" ?disabled=${!fresh} @click=${this.#save}>
        ${icon('download')} <span>${r('download', { name })}</span>
      </button>
      ${this.saved === '' ? nothing : html`<p class="note" role="status">${this.saved}</p>`}`;
  }

  #failed(problem: Problem): TemplateResult {
    const engine = problem.code === 'InvalidArgument' || problem.code === 'InvalidFile';
    const { message, hint } = problemWords(problem);
    return html`<div class="problem" role="alert">
      ${icon('warn')}
      <div>
        <p><b>${engine ? r('failed') : message}</b></p>
        ${problem.detail === '' ? nothing : html`<p>${problem.detail}</p>`}
        ${engine || hint === '' ? nothing : html`<p class="note">${hint}</p>`}
      </div>
    </div>`;
  }

  #ready({ seconds, surfaces }: Rebrushed, { slicer }: SlicedFile): TemplateResult {
    const n = surfaces.filter(({ replaced }) => replaced).length;
    const time = formatDuration(Math.abs(seconds));
    return html`<p role="status">${r('ready', { n, time, more: r(seconds < 0 ? 'shorter' : 'longer'), slicer })}</p>`;
  }
}

/** By the reason why they are left. */
function grouped(faces: readonly Face[]): Map<Face['reason'], Face[]> {
  const groups = new Map<Face['reason'], Face[]>();
  for (const face of faces) groups.set(face.reason, [...(groups.get(face.reason) ?? []), face]);
  return groups;
}
