// Dialog with the roles of the files that were opened last. The page has guessed them, and the visitor can change them.
import { css, html, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { words } from '../i18n/en/files.js';
import { formatBytes, say, t } from '../i18n/text.js';
import { DialogElement } from '../controls/dialog.js';
import type { Opened, Role } from '../model/file-role.js';
import { button } from '../controls/button.js';

const pictureSide = 192; // [pixels] for 64 CSS pixels on a screen with a pixel ratio of 3

@customElement('sillon-files')
export class Files extends DialogElement {
  static override reads = ['opened'] as const;

  static override styles = css`
    dialog {
      width: min(560px, calc(100vw - 24px));
    }
    .files {
      display: grid;
      gap: 16px;
    }
    .files li {
      display: grid;
      grid-template-columns: 64px 1fr;
      gap: 4px 14px;
      align-items: start;
    }
    .files img,
    .files .blank {
      width: 64px;
      height: 64px;
      object-fit: contain;
      border: 1px solid var(--line);
      border-radius: var(--radius);
      background: var(--sunken);
      grid-row: span 3;
    }
    .files label {
      overflow-wrap: anywhere;
      font-weight: 500;
    }
  `;

  readonly #pictures = new Map<string, string>();

  protected override heading = (): string => say(words, 'files.what');

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    for (const url of this.#pictures.values()) URL.revokeObjectURL(url);
    this.#pictures.clear();
  }

  protected override body(): TemplateResult {
    const { opened } = this.state;
    return html`
      <p>${say(words, 'files.guess')}</p>
      <ul class="files">
        ${opened?.files.map((file, k) => this.#row(file, k))}
      </ul>
      <div class="end">${button('main', t('verb.done'), () => this.close())}</div>
    `;
  }

  #row({ source, role, roles, notes }: Opened, k: number): TemplateResult {
    const id = `role-${k}`;
    return html`<li>
      ${this.#picture(source)}
      <label for=${id}>${source.name} <span class="note">${formatBytes(source.bytes.size)}</span></label>
      <select
        id=${id}
        class="wide"
        aria-describedby="${id}-help"
        @change=${(event: Event) => {
          const next = (event.currentTarget as HTMLSelectElement).value as Role;
          void this.studio.attempt(() => this.studio.services.setRole(k, next));
        }}
      >
        ${roles.map((name) => html`<option value=${name} ?selected=${name === role}>${say(words, `role.${name}`)}</option>`)}
      </select>
      <p class="note" id="${id}-help">
        ${[`role.${role}.help` as const, ...notes.map((note) => `files.${note}` as const)].map((word) => `${say(words, word)} `)}
      </p>
    </li>`;
  }

  #picture({ id, bytes }: Opened['source']): TemplateResult {
    const isDrawing = bytes.type === 'image/svg+xml';
    if (!this.#pictures.has(id) && bytes.type.startsWith('image/')) {
      this.#pictures.set(id, isDrawing ? '' : URL.createObjectURL(bytes));
      if (isDrawing) void this.#draw(id, bytes);
    }
    const url = this.#pictures.get(id) ?? '';
    return url === '' ? html`<span class="blank"></span>` : html`<img src=${url} alt="" />`;
  }

  async #draw(id: string, drawing: Blob): Promise<void> {
    try {
      const [{ smallPng }, running] = await Promise.all([import('../files/drawn.js'), this.studio.services.engine()]);
      const png = await smallPng(drawing, running, pictureSide);
      if (!this.isConnected) return;
      this.#pictures.set(id, URL.createObjectURL(png));
      this.requestUpdate();
    } catch {
      // The picture stays blank when the drawing cannot be painted.
    }
  }
}
