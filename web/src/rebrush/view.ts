// A sliced print, to be re-brushed: all over the page, above the plate, which stays as it is. Its top faces are listed and
// seen from above; new beads are laid as soon as something is chosen, and the same kind of file is downloaded.
import { html, type PropertyValues, type TemplateResult } from 'lit';
import type { Cycle, PrintRelief, Rebrushed, SlicedFile } from 'sillon';
import { customElement, query, state } from 'lit/decorators.js';
import { download } from '../files/download.js';
import { isSliced } from '../files/open.js';
import { readable } from '../files/readable.js';
import { brushedName } from '../files/sliced.js';
import { sourceFile } from '../files/source-file.js';
import { r } from '../i18n/rebrush.js';
import { formatBytes } from '../i18n/text.js';
import { loadSpools } from '../print/own-spools.js';
import { lookOf } from '../model/filaments.js';
import { ownSpools } from '../print/machine-fields.js';
import { lampFor } from '../model/lamp.js';
import type { Stroke } from '../model/plate.js';
import { isAbort, problemOf, StudioError, type Problem } from '../model/problem.js';
import { fineResolution, type DirectionRaster } from '../model/raster.js';
import {
  boxOf,
  facesOf,
  howOf,
  lackOf,
  sides,
  type Face,
  type HandBrush,
  type Side,
  type Wish,
} from '../model/rebrush.js';
import { TimeLeft } from '../model/time-left.js';
import type { Light } from '../model/view.js';
import { StudioElement } from '../controls/element.js';
import { isTyping } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import './bench.js';
import { directionFields } from './directions.js';
import { faceList } from './faces.js';
import { foot, noWork, progressBar, type Progress } from './foot.js';
import { rebrushStyle } from './style.js';

const mostBytes = 256e6; // as the engine reads of text
const reliefSide = 1600; // cells: a few per bead of a print of 200 mm
const restAfter = 350; // [ms] without a change, after which beads are laid
const pictureFiles = 'image/*,.tga';

/** What was wanted of prints that were left with strokes of a hand on them. */
const left = new WeakMap<File, Wish>();

@customElement('sillon-rebrush')
export class RebrushView extends StudioElement {
  static override reads = ['sliced', 'theme'] as const;

  static override styles = [...StudioElement.styles, rebrushStyle];

  @query('dialog') private dialog!: HTMLDialogElement;

  @state() private print: SlicedFile | undefined;
  @state() private relief: PrintRelief | undefined;
  @state() private faces: readonly Face[] = [];
  /** Of them; bottoms where no top is meant. */
  @state() private shown: readonly Face[] = [];
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
  @state() private tilted = false;
  @state() private brush: HandBrush = { tool: 'comb', across: 8, softness: 0.5, mode: 'parallel' };
  @state() private saved = '';
  @state() private darkScheme = matchMedia('(prefers-color-scheme: dark)').matches;

  #file: File | undefined;
  #job: AbortController | undefined;
  #rest: ReturnType<typeof setTimeout> | undefined;
  readonly #end = new AbortController();

  // --- The page -----------------------------------------------------------------------------------------------------------

  override connectedCallback(): void {
    super.connectedCallback();
    loadSpools(this.studio);
    const { plate } = this.state;
    const { azimuth, elevation } = this.studio.homeLight();
    this.light = { azimuth: Math.round(azimuth), elevation: Math.round(elevation) };
    this.wish = {
      side: 'top',
      chosen: new Set(),
      way: 'angle',
      angle: plate.directions.kind === 'angle' ? plate.directions.angle : 30,
      picture: undefined,
      lamp: lampFor([], this.light),
      spool: plate.pictures.spool,
      own: plate.spool,
      fit: 'face',
      strokes: [],
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
    this.#leave();
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
    this.#leave();
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

  /** Strokes take long: they are kept, and one may go on. */
  #leave(): void {
    const file = this.#file;
    if (file === undefined || this.wish.strokes.length === 0) return;
    left.set(file, this.wish);
    const goOn = {
      label: r('goOn'),
      run: () => {
        this.studio.store.set({ sliced: file, dialog: 'rebrush' });
      },
    };
    this.studio.tell({ text: r('kept', { name: file.name }), actions: [goOn], stays: true });
  }

  #onKey = (event: KeyboardEvent): void => {
    const { way, strokes } = this.wish;
    const undoes = (event.ctrlKey || event.metaKey) && !event.shiftKey && event.key.toLowerCase() === 'z';
    if (!undoes || way !== 'hand' || strokes.length === 0 || isTyping(event)) return;
    event.preventDefault();
    this.#want({ strokes: strokes.slice(0, -1) });
  };

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
    this.wish = { ...this.wish, strokes: [] };
    this.progress = { fraction: 0, secondsLeft: undefined };
    const { signal } = job;
    try {
      if (file.size > mostBytes) {
        const values = { name: file.name, mb: Math.ceil(file.size / 1e6), most: mostBytes / 1e6 };
        throw new StudioError('TooLarge', {}, r('tooLarge', values));
      }
      const engine = await this.studio.services.engine();
      // One after the other in one worker, which reads the file once. Each takes about half of the time.
      const told = (begin: number) => ({
        signal,
        onProgress: ({ fraction }: { fraction: number }): void => {
          if (!signal.aborted) this.progress = { fraction: begin + fraction / 2, secondsLeft: undefined };
        },
      });
      const print = await engine.listSurfaces(file, told(0));
      if (signal.aborted) return;
      // What is seen of the print is no reason to refuse it.
      this.relief = await engine.printRelief(file, reliefSide, told(0.5)).catch(() => undefined);
      if (signal.aborted as boolean) return;
      this.print = print;
      const free = (side: Side): boolean => facesOf(print.surfaces, side).some(({ left }) => left === '');
      const kept = left.get(file);
      const side = kept?.side ?? (!free('top') && free('bottom') ? 'bottom' : 'top');
      this.wish = { ...this.wish, ...this.#all(side), ...kept };
      this.progress = undefined;
      if (this.wish.chosen.size > 0) void this.#lay();
    } catch (error) {
      if (signal.aborted) return;
      this.progress = undefined;
      if (!isAbort(error)) this.problem = problemOf(error);
    }
  }

  /** All faces of a side that can be replaced. */
  #all(side: Side): Pick<Wish, 'side' | 'chosen'> {
    this.faces = facesOf(this.print?.surfaces ?? [], side);
    this.shown = side === 'bottom' ? this.faces : this.faces.filter((face) => face.side === 'top');
    return { side, chosen: new Set(this.#free().map(({ index }) => index)) };
  }

  /** The view from aside is fetched when it is wanted. */
  #tilt = async (): Promise<void> => {
    if (!this.tilted)
      await this.#try(async () => {
        await import('./tilted.js');
      });
    this.tilted = !this.tilted;
  };

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
    const { print } = this;
    if (file === undefined || print === undefined) return;
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
      const drawn = await this.#drawn(wish);
      const engine = await services.engine();
      if (signal.aborted) return;
      const how = howOf(wish, this.#free(), plate, drawn, print.nozzle);
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

  /** What the engine cannot draw by itself. */
  async #drawn(wish: Wish): Promise<DirectionRaster | undefined> {
    const { services } = this.studio;
    if (wish.way === 'hand') {
      const { handRaster } = await import('./hand.js');
      return handRaster(wish.strokes, boxOf(wish, this.faces), wish.angle, fineResolution);
    }
    const solved = this.state.plate.directions.kind === 'lamp'; // the engine solves for it
    return wish.way === 'plate' && !solved ? services.directions() : undefined;
  }

  #cancel = (): void => {
    clearTimeout(this.#rest);
    this.#job?.abort();
    this.progress = undefined;
    this.cancelled = true;
  };

  #free = (): Face[] => this.faces.filter(({ left }) => left === '');

  /** Those that the file has. */
  #sides({ surfaces }: SlicedFile): readonly Side[] {
    const has = (side: Side): boolean => surfaces.some((surface) => surface.side === side);
    return sides.filter((side) => (side === 'both' ? has('top') && has('bottom') : has(side)));
  }

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
      @keydown=${this.#onKey}
      @close=${() => {
        if (this.isConnected) this.studio.store.set({ dialog: undefined, sliced: undefined });
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
      return html`<div class="alone">${progressBar(r('reading', { name }), this.progress.fraction, this.#close)}</div>`;
    }
    return html`<div class="alone">
      ${noWork(name, this.print, this.faces, this.problem)}
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
    const done = this.fresh ? this.done : undefined;
    const lamps = wish.way === 'picture' ? { azimuth: wish.lamp[0], elevation: wish.lamp[1] } : light;
    const pictures = { ...plate.pictures, spool: wish.spool, slopes: null };
    const filament = lookOf({ ...plate, pictures, spool: wish.own });
    const dark = theme === 'auto' ? this.darkScheme : theme === 'dark';
    const toggle = (event: CustomEvent<number>): void => {
      this.#toggle(event.detail);
    };
    const tilts = this.relief !== undefined;
    const brush = wish.way === 'hand' ? this.brush : undefined;
    const strokes = this.fresh ? [] : wish.strokes;
    const draw = (event: CustomEvent<Stroke>): void => {
      this.#want({ strokes: [...this.wish.strokes, event.detail] });
    };
    return html`${
        this.tilted && tilts
          ? html`<sillon-rebrush-tilted
              .relief=${this.relief}
              .faces=${this.faces}
              .side=${wish.side}
              .chosen=${wish.chosen}
              .laid=${this.laid}
              .marked=${this.marked}
              .light=${lamps}
              .filament=${filament}
              .brush=${brush}
              .strokes=${strokes}
              .dark=${dark}
              @toggle-face=${toggle}
              @tilt=${this.#tilt}
              @stroke=${draw}
            ></sillon-rebrush-tilted>`
          : html`<sillon-rebrush-bench
              .relief=${this.relief}
              .faces=${this.shown}
              .chosen=${wish.chosen}
              .laid=${this.laid}
              .marked=${this.marked}
              .home=${lamps}
              .filament=${filament}
              .lit=${wish.way === 'picture'}
              .brush=${brush}
              .strokes=${strokes}
              .dark=${dark}
              .tilts=${tilts}
              @toggle-face=${toggle}
              @tilt=${this.#tilt}
              @stroke=${draw}
            ></sillon-rebrush-bench>`
      }
      <div class="side">
        <div class="scroll">
          <section>
            <p class="note">
              ${r('print', { program: print.program, n: print.layers, size: formatBytes(sliced?.size ?? 0) })}
            </p>
            <div class="buttons">${this.#another()}</div>
          </section>
          ${faceList({
            faces: this.faces,
            side: wish.side,
            sides: this.#sides(print),
            chosen: wish.chosen,
            done,
            onSide: (side) => {
              this.#want(this.#all(side));
            },
            onChoose: (chosen) => {
              this.#want({ chosen });
            },
            onToggle: (index) => {
              this.#toggle(index);
            },
            onMark: (index) => {
              this.marked = index;
            },
          })}
          ${directionFields({
            wish,
            spools: ownSpools(this.studio),
            brush: this.brush,
            done,
            light,
            onWant: (change) => {
              this.#want(change);
            },
            onBrush: (change) => {
              this.brush = { ...this.brush, ...change };
            },
            onLight: (next) => {
              this.light = next;
            },
            onPickPicture: () => void this.#pick(pictureFiles),
          })}
          <p class="note">${r('untried')}</p>
        </div>
        <div class="foot">
          ${foot({
            wish,
            print,
            name: brushedName(sliced?.name ?? ''),
            progress: this.progress,
            problem: this.problem,
            cancelled: this.cancelled,
            done,
            saved: this.saved,
            onCancel: this.#cancel,
            onAgain: () => void this.#lay(),
            onSave: this.#save,
          })}
        </div>
      </div>`;
  }
}
