// A link that carries the settings, and what it cannot carry.
import { css, html, type TemplateResult } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { words } from '../i18n/en/export.js';
import { words as linksWords } from '../i18n/en/links.js';
import { say, t } from '../i18n/text.js';
import { DialogElement } from '../controls/dialog.js';
import { icon } from '../controls/icons.js';
import type { Shown } from '../studio/shown.js';

@customElement('sillon-share')
export class Share extends DialogElement {
  static override styles = [
    ...DialogElement.styles,
    css`
      dialog {
        width: min(520px, calc(100vw - 24px));
      }
      .body {
        display: grid;
        gap: 12px;
      }
      .link {
        display: grid;
        grid-template-columns: 1fr auto;
        gap: 8px;
      }
      .buttons {
        display: flex;
        flex-wrap: wrap;
        gap: 8px;
      }
    `,
  ];

  @state() private url = '';
  @state() private told = '';
  @state() private copied = false;

  protected override heading = (): string => t('verb.share');

  override connectedCallback(): void {
    super.connectedCallback();
    this.#make();
  }

  protected override onState({ plate }: Readonly<Shown>, { plate: before }: Readonly<Shown>): void {
    if (plate !== before) this.#make();
  }

  #make(): void {
    const { plate } = this.state;
    this.url = '';
    this.copied = false;
    void this.studio.attempt(async () => {
      const { url, told } = await this.studio.services.link(plate);
      if (plate !== this.state.plate) return; // another is on its way
      this.url = url;
      this.told = told;
    });
  }

  protected override body(): TemplateResult {
    return html`
      <p>${say(words, 'export.link.help')} ${this.told}</p>
      <div class="link">
        <input type="text" readonly aria-label=${t('verb.share')} .value=${this.url} @focus=${this.#select} />
        <button type="button" class="main" ?disabled=${this.url === ''} @click=${this.#copy}>
          ${icon(this.copied ? 'check' : 'share')} ${t(this.copied ? 'verb.copied' : 'export.link')}
        </button>
      </div>
      <div class="buttons">
        ${
          'share' in navigator
            ? html`<button
                type="button"
                @click=${() => {
                  // Closed without choosing: nothing went wrong.
                  navigator.share({ title: say(linksWords, 'app.name'), url: this.url }).catch(() => undefined);
                }}
              >
                ${icon('share')} ${t('verb.share')}
              </button>`
            : ''
        }
        <button
          type="button"
          @click=${() => {
            void this.studio.save('project');
          }}
        >
          ${icon('file')} ${t('export.project')}
        </button>
      </div>
      <p class="note" role="status">${this.copied ? say(linksWords, 'link.copied') : ''}</p>
    `;
  }

  #select = (event: Event): void => {
    (event.currentTarget as HTMLInputElement).select();
  };

  #copy = async (): Promise<void> => {
    try {
      await navigator.clipboard.writeText(this.url);
      this.copied = true;
    } catch {
      // Not allowed here: the link stands selected, ready for Ctrl C.
      this.renderRoot.querySelector<HTMLInputElement>('.link input')?.focus();
    }
  };
}
