// Dialog with all plates kept in this browser, to open, rename, duplicate and delete.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { repeat } from 'lit/directives/repeat.js';
import type { Listed } from '../files/autosave.js';
import { plainName } from '../files/file-name.js';
import { words } from '../i18n/en/plates.js';
import { language, say, t } from '../i18n/text.js';
import { DialogElement } from '../controls/dialog.js';
import { icon, type IconName } from '../controls/icons.js';
import { urlOf } from '../controls/thumbnail.js';
import { button } from '../controls/button.js';

@customElement('sillon-plates')
export class Plates extends DialogElement {
  static override styles = css`
    dialog {
      width: min(980px, calc(100vw - 24px));
    }
    .plates {
      display: grid;
      grid-template-columns: repeat(auto-fill, minmax(172px, 1fr));
      gap: 12px;
    }
    .plates li {
      display: grid;
      grid-template-rows: auto auto auto;
      gap: 6px;
      padding: 8px;
    }
    .plates li.here {
      border-color: var(--accent);
    }
    .open {
      position: relative;
      display: block;
      width: 100%;
      aspect-ratio: 1;
      padding: 0;
      border-color: transparent;
      background: var(--sunken);
    }
    .open img {
      display: block;
      width: 100%;
      height: 100%;
      object-fit: contain;
    }
    .open .blank {
      display: grid;
      height: 100%;
      place-content: center;
      color: var(--edge);
    }
    .badge {
      position: absolute;
      left: 6px;
      bottom: 6px;
      font-size: var(--small);
    }
    .here .badge {
      color: var(--accent);
    }
    input.name {
      width: 100%;
      border-color: transparent;
      background: none;
      font-weight: 500;
      text-overflow: ellipsis;
    }
    input.name:hover,
    input.name:focus {
      border-color: var(--edge);
    }
    .foot {
      display: flex;
      align-items: center;
      gap: 2px;
      padding-left: 8px;
    }
    .foot .note {
      flex: 1;
      min-width: 0;
    }
    .told {
      display: flex;
      flex-wrap: wrap;
      align-items: center;
      gap: 8px 12px;
      padding: 8px 12px;
      border: 1px solid var(--line);
      border-radius: var(--radius-large);
      background: var(--tint);
    }
    .told span {
      flex: 1 1 240px;
    }
    @media (max-width: 480px) {
      .plates {
        grid-template-columns: 1fr 1fr;
        gap: 8px;
      }
      .plates li {
        padding: 4px;
      }
      .foot {
        flex-wrap: wrap;
        padding-left: 6px;
      }
      .foot .note {
        flex-basis: 100%;
      }
    }
  `;

  @state() private plates: readonly Listed[] | undefined;
  /** Plate that the visitor wants to open although another tab has it. */
  @state() private asked: Listed | undefined;
  /** Plate that the visitor wants to open although this version cannot. */
  @state() private foreign: Listed | undefined;
  @state() private deleted: { name: string; undo: () => Promise<void> } | undefined;

  protected override heading = (): string => say(words, 'plates.title');

  override connectedCallback(): void {
    super.connectedCallback();
    this.listen('focus', this.#read);
    this.#read();
  }

  #read = (): void =>
    void this.studio.attempt(async () => {
      this.plates = await this.studio.services.plates().list();
    });

  protected override body(): TemplateResult {
    return html`
      <p>${say(words, 'plates.what')}</p>
      <div role="status">${this.#told()}</div>
      ${
        this.plates === undefined
          ? nothing
          : this.plates.length === 0
            ? html`<p class="note">${say(words, 'plates.none')}</p>`
            : html`<ul class="plates">
                ${repeat(
                  this.plates,
                  ({ id }) => id,
                  (plate) => this.#plate(plate),
                )}
              </ul>`
      }
      <div class="end">
        ${button('', html`${icon('plus')} ${say(words, 'plates.new')}`, () => {
          this.close();
          this.studio.services.newPlate();
        })}
      </div>
    `;
  }

  #told(): TemplateResult | typeof nothing {
    const { asked, foreign, deleted } = this;
    if (foreign !== undefined) {
      return html`<div class="told">
        <span>${say(words, 'plates.foreignHelp', { name: this.#nameOf(foreign) })}</span>
        ${button('main', html`${icon('download', 16)} ${t('verb.download')}`, () => void this.#download(foreign))}
      </div>`;
    }
    if (asked !== undefined) {
      return html`<div class="told">
        <span>${say(words, 'plates.asked', { name: this.#nameOf(asked) })} ${say(words, 'plates.takeHelp')}</span>
        ${button('main', say(words, 'plates.take'), () => void this.#open(asked.id, true))}
        ${button('', say(words, 'plates.copy'), () => void this.#open(asked.id, false))}
      </div>`;
    }
    if (deleted === undefined) return nothing;
    return html`<div class="told">
      <span>${say(words, 'plates.deleted', { name: deleted.name })}</span>
      ${button('', html`${icon('undo', 16)} ${t('verb.undo')}`, () => {
        this.renderRoot.querySelector<HTMLElement>('.body')?.focus(); // as this button goes
        this.deleted = undefined;
        void this.#then(deleted.undo);
      })}
    </div>`;
  }

  #nameOf = ({ name }: Listed): string => name || say(words, 'plates.untitled');

  #plate(plate: Listed): TemplateResult {
    const { id, width, height, changed, picture, here, elsewhere, foreign } = plate;
    const name = this.#nameOf(plate);
    const size = say(words, 'plates.size', { width: Math.round(width), height: Math.round(height) });
    const badge = foreign ? 'plates.foreign' : here ? 'plates.here' : elsewhere ? 'plates.elsewhere' : undefined;
    const date = new Intl.DateTimeFormat(language(), { dateStyle: 'medium', timeStyle: 'short' }).format(changed);
    return html`<li class=${here ? 'board here' : 'board'}>
      <button
        class="open"
        aria-label=${say(words, 'plates.open', { name })}
        aria-current=${here ? 'true' : nothing}
        @click=${() => {
          if (foreign) this.foreign = plate;
          else if (here) this.close();
          else if (elsewhere) this.asked = plate;
          else void this.#open(id, false);
        }}
      >
        ${
          picture === undefined
            ? html`<span class="blank">${icon('directions', 40)}</span>`
            : html`<img src=${urlOf(picture)} alt="" />`
        }
        ${badge === undefined ? nothing : html`<span class="badge tag">${say(words, badge)}</span>`}
      </button>
      <input
        class="name"
        type="text"
        aria-label=${say(words, 'plates.name', { name })}
        placeholder=${say(words, 'plates.untitled')}
        maxlength="80"
        spellcheck="false"
        ?readonly=${elsewhere || foreign}
        .value=${plate.name}
        @change=${(event: Event) => void this.#rename(plate, (event.currentTarget as HTMLInputElement).value.trim())}
      />
      <div class="foot">
        <span class="note">${size}<br />${date}</span>
        ${
          foreign
            ? this.#button('download', say(words, 'plates.download', { name }), () => this.#download(plate))
            : this.#button('copy', say(words, 'plates.duplicate', { name }), () =>
                this.#then(async () => {
                  await this.studio.services.plates().duplicate(id, say(words, 'plates.copyOf', { name }));
                }),
              )
        }
        ${this.#button('bin', say(words, 'plates.delete', { name }), () => this.#remove(plate), elsewhere)}
      </div>
    </li>`;
  }

  #button(name: IconName, label: string, run: () => Promise<void>, disabled = false): TemplateResult {
    return button({ look: 'plain square', name: label, disabled }, icon(name, 16), () => void run());
  }

  /** Runs an action that may fail, and then reads the list again. */
  async #then(action: () => Promise<void>): Promise<void> {
    await this.studio.attempt(action);
    this.#read();
  }

  async #open(id: string, take: boolean): Promise<void> {
    const opened = await this.studio.attempt(() => this.studio.services.openPlate(id, take));
    if (opened) this.close();
    else this.#read();
  }

  async #rename(plate: Listed, name: string): Promise<void> {
    if (name === plate.name) return;
    await this.#then(async () => {
      if (plate.here) this.studio.change((now) => ({ ...now, name }));
      else await this.studio.services.plates().rename(plate.id, name);
      await Promise.resolve(); // by now the change is queued for saving
    });
  }

  /** Downloads a plate as it is kept, for the version that can open it. */
  async #download(plate: Listed): Promise<void> {
    await this.studio.attempt(async () => {
      const { packStored } = await import('../files/project.js');
      const packed = await packStored(await this.studio.services.plates().stored(plate.id));
      this.studio.deliver(packed, `${plainName(plate.name) || 'plate'}.sillon.zip`);
    });
  }

  async #remove(plate: Listed): Promise<void> {
    await this.#then(async () => {
      if (plate.here) {
        this.studio.services.newPlate();
        await Promise.resolve();
      }
      const undo = await this.studio.services.plates().remove(plate.id);
      this.foreign = undefined;
      this.deleted = { name: this.#nameOf(plate), undo };
    });
    await this.updateComplete;
    this.renderRoot.querySelector<HTMLElement>('.told button')?.focus(); // the focused button has gone, or will
  }
}
