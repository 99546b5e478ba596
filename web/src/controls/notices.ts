// Shows notices, which pass, and problems, which stay until they are dismissed.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement, property } from 'lit/decorators.js';
import { problemWords } from '../i18n/say.js';
import { t } from '../i18n/text.js';
import { StudioElement } from './element.js';
import { icon } from './icons.js';
import { same } from '../model/problem.js';
import type { Notice, Shown } from '../studio/shown.js';
import { button } from './button.js';

const loadExact = () => import('../i18n/say-problem.js');
const loadLinked = () => import('./linked.js');

/** Tells whether two texts say the same: in English, many problems are shown in the engine's own words, which then
 * are no further details. */
const sameWords = (one: string, other: string): boolean => lettersOf(one) === lettersOf(other);
const lettersOf = (text: string): string => text.toLowerCase().replaceAll(/[\s.]+/g, '');

@customElement('sillon-notices')
export class Notices extends StudioElement {
  static override reads = ['notices', 'problem'] as const;

  static override styles = css`
    :host {
      position: relative; /* before the plate */
      display: block;
      justify-self: end;
      width: min(424px, 100%);
      overflow: auto; /* where there is little room */
      scrollbar-width: thin;
      pointer-events: none;
    }
    .notice {
      margin: 4px 12px 8px;
      display: grid;
      grid-template-columns: auto 1fr auto;
      align-items: start;
      gap: 4px 10px;
      padding: 10px 8px 10px 14px;
      box-shadow: 0 1px 4px var(--shade);
      pointer-events: auto;
      overflow-wrap: anywhere;
    }
    .notice > .icon {
      margin-top: 1px;
      color: var(--accent);
    }
    .problem {
      border-color: var(--bad);
      background: var(--bad-tint);
    }
    .problem > .icon {
      color: var(--bad);
    }
    .problem b {
      display: block;
    }
    .problem details {
      font-size: var(--note);
    }
    .problem summary {
      min-height: 26px;
    }
    .link {
      margin-right: 8px;
      text-align: start;
    }
    .close {
      min-height: 24px;
      width: 24px;
      padding: 0;
    }
    .actions {
      display: flex;
      gap: 6px;
      margin-top: 6px;
    }
    @media (pointer: coarse) {
      .notice {
        align-items: center;
        padding: 0 0 0 12px; /* a line as high as its button */
      }
      .problem {
        padding: 8px 0 8px 12px;
      }
      .close {
        min-height: 44px;
        width: 44px;
      }
    }
    @media (max-width: 720px) {
      :host {
        width: 100%;
      }
      .notice {
        margin: 4px 6px 6px;
      }
    }
  `;

  /** Notices that are shown elsewhere. */
  @property({ attribute: false }) known: Partial<Pick<Shown, 'notices' | 'problem'>> = {};

  override render(): TemplateResult {
    const { known } = this;
    const notices = this.state.notices.filter((notice) => !known.notices?.includes(notice));
    const problem = this.state.problem === known.problem ? undefined : this.state.problem;
    return html`<div role="alert">
        ${problem === undefined ? nothing : this.#problem(problem)}
        ${notices.map(({ problem: told, id }) =>
          told === undefined || (problem !== undefined && same(told, problem)) ? nothing : this.#problem(told, id),
        )}
      </div>
      <div role="status">
        ${notices.filter((notice) => notice.problem === undefined).map((notice) => this.#word(notice))}
      </div>`;
  }

  /** Moves the focus on before a focused button goes: to the surrounding sheet, or to the plate. */
  #refocus(): void {
    const sheet = this.closest('dialog')?.querySelector<HTMLElement>('.body');
    (sheet ?? this.studio.stage)?.focus();
  }

  #close(close: () => void): TemplateResult {
    return button({ look: 'plain close', label: t('verb.dismiss') }, icon('close', 14), () => {
      this.#refocus();
      close();
    });
  }

  #word({ id, text, actions }: Notice): TemplateResult {
    return html`<div class="notice board">
      ${icon('check')}
      <div>
        ${text}
        ${actions?.map(({ label, run }) =>
          button('link', label, () => {
            this.#refocus(); // the focus comes back to it from whatever `run` opens
            this.studio.dismiss(id);
            run();
          }),
        )}
      </div>
      ${this.#close(() => this.studio.dismiss(id))}
    </div>`;
  }

  /** Returns a problem with its hint and actions. @param id  of its notice; left out: it comes from the engine, and a
   * retry may help */
  #problem(problem: NonNullable<Notice['problem']>, id?: number): TemplateResult {
    // Words about a part that could not be loaded must be here already: their own part could not be loaded either.
    const told = problem.code === 'PartMissing' ? undefined : this.lazy(loadExact, true)?.exactWords(problem);
    const { message, hint, detail } = { ...problemWords(problem), ...told };
    // If the page has no words of its own, the engine's sentence names the setting and the amount.
    const named = told === undefined && (problem.code === 'InvalidArgument' || problem.code === 'DoesNotFit');
    // Names of settings become links to their fields.
    const links = told === undefined ? undefined : this.lazy(loadLinked, true);
    const said = (text: string): unknown => links?.linked(this.studio, text) ?? text;
    const actions: TemplateResult[] = [];
    if (id === undefined) {
      if (this.studio.store.canUndo)
        actions.push(button('', html`${icon('undo', 16)} ${t('verb.undo')}`, () => this.studio.store.undo()));
      actions.push(button('', t('verb.retry'), () => this.studio.services.retry()));
    }
    if (problem.code === 'PartMissing') actions.push(button('', t('verb.reload'), () => location.reload()));
    return html`<div class="notice board problem">
      ${icon('warn')}
      <div>
        <b>${said(message)}</b>${said(hint)}
        ${
          detail === '' || sameWords(detail, message)
            ? nothing
            : html`<details ?open=${named}>
                <summary>${icon('fold', 14)} ${t('problem.details')}</summary>
                ${detail}
              </details>`
        }
        ${actions.length > 0 ? html`<div class="actions">${actions}</div>` : nothing}
      </div>
      ${this.#close(() => {
        if (id === undefined) this.studio.store.set({ problem: undefined });
        else this.studio.dismiss(id);
      })}
    </div>`;
  }
}
