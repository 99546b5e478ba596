// Dialog with a link to the plate and a text about what the link cannot carry, and with a moving picture for
// messengers.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { words } from '../i18n/en/export.js';
import { words as linksWords } from '../i18n/en/links.js';
import { say, t } from '../i18n/text.js';
import { DialogElement } from '../controls/dialog.js';
import { icon } from '../controls/icons.js';
import type { Shown } from '../studio/shown.js';
import { button } from '../controls/button.js';

@customElement('sillon-share')
export class Share extends DialogElement {
  static override styles = css`
    dialog {
      width: min(520px, calc(100vw - 24px));
    }
    .link {
      display: grid;
      grid-template-columns: 1fr auto;
      gap: 8px;
    }
    img {
      justify-self: center;
      max-width: 100%;
      max-height: 40vh;
      border-radius: var(--radius);
    }
  `;

  @state() private url = '';
  @state() private told = '';
  @state() private copied = false;
  @state() private making = false;
  @state() private loop: { file: File; url: string } | undefined;

  protected override heading = (): string => t('verb.share');

  override connectedCallback(): void {
    super.connectedCallback();
    this.#make();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#dropLoop();
  }

  protected override onState({ plate }: Readonly<Shown>, { plate: before }: Readonly<Shown>): void {
    if (plate !== before) this.#make();
  }

  #make(): void {
    const { plate } = this.state;
    this.url = '';
    this.copied = false;
    this.#dropLoop();
    void this.studio.attempt(async () => {
      const { url, told } = await this.studio.services.link(plate);
      if (plate !== this.state.plate) return; // the plate has changed, so another link is being made
      this.url = url;
      this.told = told;
    });
  }

  protected override body(): TemplateResult {
    return html`
      <p>${say(words, 'export.link.help')} ${this.told}</p>
      <div class="link">
        <input type="text" readonly aria-label=${t('verb.share')} .value=${this.url} @focus=${this.#select} />
        ${button(
          { look: 'main', disabled: this.url === '' },
          html`${icon(this.copied ? 'check' : 'share')} ${t(this.copied ? 'verb.copied' : 'export.link')}`,
          this.#copy,
        )}
      </div>
      <div class="buttons">
        ${
          'share' in navigator
            ? button('', html`${icon('share')} ${t('verb.share')}`, () => {
                // Closing the browser's dialog without a choice is no error.
                navigator.share({ title: say(linksWords, 'app.name'), url: this.url }).catch(() => undefined);
              })
            : ''
        }
        ${button('', html`${icon('file')} ${t('export.project')}`, () => void this.studio.save('project'))}
        ${button(
          { disabled: this.making || this.loop !== undefined },
          html`${icon('video')} ${t('export.loop')}`,
          this.#makeLoop,
        )}
      </div>
      ${this.loop === undefined ? nothing : this.#moving(this.loop)}
      <p class="note" role="status">
        ${this.making ? t('capture.making') : this.copied ? say(linksWords, 'link.copied') : ''}
      </p>
    `;
  }

  /** Shows the finished picture with a button to share it. Browsers share a file only right after a press, and
   * making the picture takes longer than that. */
  #moving({ file, url }: { file: File; url: string }): TemplateResult {
    const shares = 'canShare' in navigator && navigator.canShare({ files: [file] });
    return html`<img src=${url} alt=${t('export.loop')} />
      <div class="buttons">
        ${
          shares
            ? button('main', html`${icon('share')} ${t('verb.share')}`, () => {
                navigator.share({ files: [file] }).catch(() => undefined);
              })
            : nothing
        }
        ${button('', html`${icon('download')} ${t('verb.download')}`, () => this.studio.deliver(file, file.name))}
      </div>`;
  }

  #makeLoop = (): void => {
    const { plate } = this.state;
    this.making = true;
    void this.studio
      .attempt(async () => {
        const { blob, name } = await this.studio.make('loop');
        if (plate !== this.state.plate || !this.isConnected) return;
        const file = new File([blob], name, { type: blob.type });
        this.loop = { file, url: URL.createObjectURL(file) };
      })
      .finally(() => {
        this.making = false;
      });
  };

  #dropLoop(): void {
    if (this.loop !== undefined) URL.revokeObjectURL(this.loop.url);
    this.loop = undefined;
  }

  #select = (event: Event): void => (event.currentTarget as HTMLInputElement).select();

  #copy = async (): Promise<void> => {
    try {
      await navigator.clipboard.writeText(this.url);
      this.copied = true;
    } catch {
      // If copying is not allowed, the link is selected, ready for Ctrl C.
      this.renderRoot.querySelector<HTMLInputElement>('.link input')?.focus();
    }
  };
}
