// A sheet above the page. Escape, its close button, a click beside it and Back close it. Notices that come while it is
// open are shown in it, because nothing behind it can be reached.
import { html, type CSSResultGroup, type CSSResultOrNative, type TemplateResult } from 'lit';
import { query } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import { closesByBack } from './back.js';
import { StudioElement } from './element.js';
import { icon } from './icons.js';
import type { Shown } from '../studio/shown.js';
import { button } from './button.js';
import { dialogStyle } from './dialog-style.js';

export abstract class DialogElement extends StudioElement {
  protected static override finalizeStyles(own: CSSResultGroup = []): CSSResultOrNative[] {
    return super.finalizeStyles([dialogStyle, own]);
  }

  @query('dialog') private dialog!: HTMLDialogElement;
  #afterwards?: () => void;
  #closed?: () => void;
  /** Notices from before the sheet opened. */
  #known: Pick<Shown, 'notices' | 'problem'> | undefined;

  protected abstract heading(): string;
  protected abstract body(): TemplateResult;

  override connectedCallback(): void {
    super.connectedCallback();
    this.#known = this.state;
    this.#closed = closesByBack(() => this.close());
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#closed?.();
  }

  override render(): TemplateResult {
    return html`<dialog
      aria-labelledby="title"
      @close=${() => {
        // The event comes late: what was opened meanwhile has taken this sheet's place, and stays.
        if (this.isConnected) this.studio.show(undefined);
        // The element that had the focus before may be gone.
        if (document.activeElement === document.body || this.matches(':focus-within')) this.studio.stage?.focus();
        this.#afterwards?.();
      }}
      @click=${(event: MouseEvent) => {
        if (event.target === this.dialog) this.close();
      }}
    >
      <div class="head">
        <h2 id="title">${this.heading()}</h2>
        ${button({ look: 'plain square', label: t('verb.close') }, icon('close'), () => this.close())}
      </div>
      <sillon-notices .studio=${this.studio} .known=${this.#known}></sillon-notices>
      <div class="body" tabindex="0">${this.body()}</div>
    </dialog>`;
  }

  override firstUpdated(): void {
    this.dialog.showModal();
    // The browser would focus the close button, which is hardly ever wanted.
    const fields = 'input:not([type=file]), select, textarea, button';
    const [first] = this.dialog.querySelectorAll<HTMLElement>(`.body :is(${fields}):not([disabled])`);
    (first ?? this.dialog.querySelector<HTMLElement>('.body'))?.focus();
  }

  /** Closes the sheet. @param afterwards  runs once the sheet is gone, so that a sheet that it opens stays open */
  protected close(afterwards?: () => void): void {
    this.#afterwards = afterwards;
    this.dialog.close();
  }
}
