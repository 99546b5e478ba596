// Re-brushes a sliced print, in a sheet over the whole page; the plate below stays as it is. The top faces are listed
// and shown from above, new beads are laid as soon as something is chosen, and a file of the same kind is downloaded.
import { html, type PropertyValues, type TemplateResult } from 'lit';
import type { SlicedFile } from 'sillon';
import { customElement, query, state } from 'lit/decorators.js';
import { printOf } from '../files/sliced.js';
import { r } from '../i18n/rebrush.js';
import { formatBytes } from '../i18n/text.js';
import { loadSpools } from '../print/own-spools.js';
import { lookOf } from '../model/filaments.js';
import type { Stroke } from 'sillon';
import type { HandBrush } from '../model/rebrush.js';
import type { Light } from '../model/view.js';
import { closesByBack } from '../controls/back.js';
import { StudioElement } from '../controls/element.js';
import { isTyping } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import '../controls/notices.js';
import type { Shown } from '../studio/shown.js';
import './bench.js';
import { directionFields } from './directions.js';
import { faceList } from './faces.js';
import { foot, noWork, progressBar } from './foot.js';
import { rebrushStyle } from './style.js';
import { PrintWork } from './work.js';
import { button } from '../controls/button.js';
import { dialogStyle } from '../controls/dialog-style.js';

const pictureFiles = 'image/*,.tga';

@customElement('sillon-rebrush')
export class RebrushView extends StudioElement {
  static override reads = ['sliced', 'theme'] as const;

  static override styles = [dialogStyle, rebrushStyle];

  @query('dialog') private dialog!: HTMLDialogElement;

  @state() private marked: number | undefined;
  @state() private light!: Light;
  @state() private tilted = false;
  @state() private brush: HandBrush = { tool: 'comb', across: 8, soft: 0.5, mode: 'parallel' };
  @state() private darkScheme = matchMedia('(prefers-color-scheme: dark)').matches;

  work!: PrintWork;
  #closed?: () => void;
  /** Problem of the plate, which is shown beside the plate. */
  #known: Partial<Pick<Shown, 'problem'>> = {};
  readonly #end = new AbortController();

  // --- The page -----------------------------------------------------------------------------------------------------------

  override connectedCallback(): void {
    super.connectedCallback();
    this.#known = { problem: this.state.problem };
    loadSpools(this.studio);
    const { azimuth, elevation } = this.studio.homeLight();
    this.light = { azimuth: Math.round(azimuth), elevation: Math.round(elevation) };
    this.work = new PrintWork(this.studio, this.light, () => this.requestUpdate());
    this.#closed = closesByBack(this.#close);
    const { signal } = this.#end;
    // Capturing listeners run before those of the page below.
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
    this.work.leave();
    this.#closed?.();
    this.#end.abort();
  }

  override firstUpdated(): void {
    this.dialog.showModal();
  }

  override updated(_changed: PropertyValues): void {
    const { sliced } = this.state;
    if (sliced !== undefined) this.work.take(sliced);
  }

  #onFiles = (event: DragEvent | ClipboardEvent): void => {
    const transfer = event instanceof DragEvent ? event.dataTransfer : event.clipboardData;
    if (transfer === null || !transfer.types.includes('Files')) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    if (event.type !== 'dragover') void this.#take([...transfer.files]);
  };

  /** Takes another print, or a picture. */
  async #take(files: readonly File[]): Promise<void> {
    const [file] = files;
    if (file === undefined) return;
    if ((await printOf(file)) === 'sliced') this.studio.store.set({ sliced: file });
    else if (this.work.known.print !== undefined)
      await this.work.attempt(() => this.work.wantPicture(file, this.light));
  }

  async #pick(accept: string): Promise<void> {
    await this.#take(await this.studio.pick(accept));
  }

  #onKey = (event: KeyboardEvent): void => {
    const { way, strokes } = this.work.wish;
    const undoes = (event.ctrlKey || event.metaKey) && !event.shiftKey && event.key.toLowerCase() === 'z';
    if (!undoes || way !== 'hand' || strokes.length === 0 || isTyping(event)) return;
    event.preventDefault();
    this.work.undoStroke();
  };

  /** Switches between the views; the view at an angle is loaded on first use. */
  #tilt = async (): Promise<void> => {
    if (!this.tilted)
      await this.work.attempt(async () => {
        await import('./tilted.js');
      });
    this.tilted = !this.tilted;
  };

  #close = (): void => this.dialog.close();

  // --- Content ----------------------------------------------------------------------------------------------------------------

  override render(): TemplateResult {
    const name = this.state.sliced?.name ?? '';
    const { print } = this.work.known;
    return html`<dialog
      aria-labelledby="title"
      @keydown=${this.#onKey}
      @close=${() => {
        if (this.isConnected) this.studio.store.set({ dialog: undefined, sliced: undefined });
      }}
    >
      <div class="head">
        ${button(
          { look: 'back', label: r('back') },
          html`${icon('previous', 16)} <span>${r('back')}</span>`,
          this.#close,
        )}
        <h2 id="title" class="cut" title=${name} tabindex="-1" autofocus>${r('title', { name })}</h2>
      </div>
      <sillon-notices class="told" .studio=${this.studio} .known=${this.#known}></sillon-notices>
      ${print === undefined || this.work.free().length === 0 ? this.#alone(name) : this.#both(print)}
    </dialog>`;
  }

  /** Returns the page while a file is read, or if it offers nothing to do. */
  #alone(name: string): TemplateResult {
    const { progress } = this.work.known;
    if (progress !== undefined) {
      return html`<div class="alone">${progressBar(r('reading', { name }), progress.fraction, this.#close)}</div>`;
    }
    return html`<div class="alone">
      ${noWork(name, this.work.known)}
      <div class="buttons">${button('main', r('back'), this.#close)} ${this.#another()}</div>
    </div>`;
  }

  #another = (): TemplateResult => button('', html`${icon('open', 16)} ${r('another')}`, () => void this.#pick(''));

  /** Returns the print and, beside it, all choices. */
  #both(print: SlicedFile): TemplateResult {
    const work = this.work;
    return html`${this.#bench()}
      <div class="side">
        <div class="scroll">
          <section>
            <p class="note">
              ${r('print', {
                program: print.program,
                n: print.layers,
                size: formatBytes(this.state.sliced?.size ?? 0),
              })}
            </p>
            <div class="buttons">${this.#another()}</div>
          </section>
          ${faceList(work, (index) => {
            this.marked = index;
          })}
          ${directionFields(work, {
            brush: this.brush,
            light: this.light,
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
        <div class="foot">${foot(work, print, this.state.sliced?.name ?? '')}</div>
      </div>`;
  }

  /** Returns the print, from above or at an angle. */
  #bench(): TemplateResult {
    const { wish, known } = this.work;
    const { relief, faces, shown, laid, done } = known;
    const { plate, theme } = this.state;
    const lamps = wish.way === 'picture' ? { azimuth: wish.lamp[0], elevation: wish.lamp[1] } : this.light;
    const pictures = { ...plate.pictures, spool: wish.spool, slopes: null };
    const filament = lookOf({ ...plate, pictures, spool: wish.own });
    const dark = theme === 'auto' ? this.darkScheme : theme === 'dark';
    const toggle = (event: CustomEvent<number>): void => this.work.toggle(event.detail);
    const brush = wish.way === 'hand' ? this.brush : undefined;
    const strokes = done === undefined ? wish.strokes : [];
    const draw = (event: CustomEvent<Stroke>): void =>
      this.work.want({ strokes: [...this.work.wish.strokes, event.detail] });
    return this.tilted && relief !== undefined
      ? html`<sillon-rebrush-tilted
          .relief=${relief}
          .faces=${faces}
          .side=${wish.side}
          .chosen=${wish.chosen}
          .laid=${laid}
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
          .relief=${relief}
          .faces=${shown}
          .chosen=${wish.chosen}
          .laid=${laid}
          .marked=${this.marked}
          .home=${lamps}
          .filament=${filament}
          .lit=${wish.way === 'picture'}
          .brush=${brush}
          .strokes=${strokes}
          .dark=${dark}
          .tilts=${relief !== undefined}
          @toggle-face=${toggle}
          @tilt=${this.#tilt}
          @stroke=${draw}
        ></sillon-rebrush-bench>`;
  }
}
