// List of the visitor's own spools, to use, rename, delete, import and export.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { repeat } from 'lit/directives/repeat.js';
import { changeSpools, loadSpools } from './own-spools.js';
import { c } from '../i18n/calibrate.js';
import { filamentLabel } from './filament-name.js';
import { formatNumber, t } from '../i18n/text.js';
import { filaments, withSpool } from '../model/filaments.js';
import type { OwnSpool } from '../model/plate.js';
import { readSpools, spoolKey, spoolsText, withOne } from './spools.js';
import { spoolColour } from './spool.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';
import { button } from '../controls/button.js';

@customElement('sillon-spools')
export class Spools extends StudioElement {
  static override reads = ['plate', 'spools'] as const;

  static override styles = css`
    :host {
      display: grid;
      gap: 14px;
      align-content: start;
    }
    ul {
      display: grid;
      grid-template-columns: repeat(auto-fill, minmax(300px, 1fr));
      gap: 8px;
    }
    li {
      display: grid;
      grid-template-columns: 40px minmax(0, 1fr) auto auto;
      align-items: center;
      gap: 4px 10px;
      padding: 8px 8px 8px 10px;
    }
    li.here {
      border-color: var(--accent);
      background: var(--tint);
    }
    .colour {
      width: 36px;
      height: 36px;
      border-radius: 50%;
      background: ${spoolColour};
      box-shadow: inset 0 0 0 1px var(--edge);
    }
    .words {
      display: grid;
      gap: 1px;
    }
    .words input {
      width: 100%;
      margin-left: -8px;
      border-color: transparent;
      background: none;
      font-weight: 600;
    }
    .words input:hover,
    .words input:focus {
      border-color: var(--edge);
    }
    .told {
      display: flex;
      flex-wrap: wrap;
      align-items: center;
      gap: 8px;
    }
    .none {
      padding: 20px;
      border: 1px dashed var(--edge);
      border-radius: var(--radius-large);
      color: var(--soft);
      text-align: center;
    }
    @media (max-width: 400px) {
      ul {
        grid-template-columns: minmax(0, 1fr);
      }
    }
  `;

  @state() private deleted: OwnSpool | undefined;

  override connectedCallback(): void {
    super.connectedCallback();
    loadSpools(this.studio);
  }

  override render(): TemplateResult {
    const { spools = [] } = this.state;
    return html`<p>${c('spools.what')}</p>
      <div role="status">${this.#told()}</div>
      ${
        spools.length === 0
          ? html`<p class="none">${c('spools.none')}</p>`
          : html`<ul>
              ${repeat(
                spools,
                ({ key }) => key,
                (spool) => this.#spool(spool),
              )}
            </ul>`
      }
      <div class="buttons">
        ${button('', html`${icon('open', 16)} ${c('spools.import')}`, () => void this.#import())}
        ${button({ disabled: spools.length === 0 }, html`${icon('download', 16)} ${c('spools.export')}`, this.#export)}
      </div>
      <p class="note">${c('spools.give')}</p>
      <h3>${c('spools.builtIn')}</h3>
      <ul>
        ${filaments.map(
          (filament) =>
            html`<li class="board">
              ${dot(filament.colour)}<span class="words"
                ><b>${filamentLabel(filament)}</b>${slopes(filament.roughness.fine.nozzleSide)}</span
              >
            </li>`,
        )}
      </ul>`;
  }

  #told(): TemplateResult | typeof nothing {
    const { deleted } = this;
    if (deleted === undefined) return nothing;
    return html`<div class="told">
      <span>${c('spools.deleted', { name: deleted.key })}</span>
      ${button('', html`${icon('undo', 16)} ${t('verb.undo')}`, () => {
        this.deleted = undefined;
        changeSpools(this.studio, (all) => withOne(all, deleted));
      })}
    </div>`;
  }

  #spool(spool: OwnSpool): TemplateResult {
    const { key: name } = spool;
    const here = this.state.plate.spool?.key === name;
    return html`<li class=${here ? 'board here' : 'board'}>
      ${dot(spool.colour)}
      <span class="words"
        ><input
          type="text"
          aria-label=${c('spools.rename', { name })}
          maxlength="40"
          spellcheck="false"
          .value=${name}
          @change=${(event: Event) => this.#rename(spool, (event.currentTarget as HTMLInputElement).value)}
        />${slopes(spool.fine.nozzleSide)}</span
      >
      ${button({ label: c('spools.use', { name }), pressed: here }, here ? icon('check', 16) : t('verb.use'), () => {
        this.studio.settle();
        this.studio.change((plate) => withSpool(plate, here ? undefined : spool));
      })}
      ${button({ look: 'plain square', name: c('spools.delete', { name }) }, icon('bin', 16), () => {
        changeSpools(this.studio, (all) => all.filter(({ key }) => key !== name));
        this.deleted = spool;
      })}
    </li>`;
  }

  #rename(spool: OwnSpool, wanted: string): void {
    const { spools = [] } = this.state;
    const others = spools.filter(({ key }) => key !== spool.key);
    const key = spoolKey(
      wanted,
      others.map((one) => one.key),
    );
    const renamed = { ...spool, key };
    changeSpools(this.studio, (all) =>
      withOne(
        all.filter((one) => one.key !== spool.key),
        renamed,
      ),
    );
    if (this.state.plate.spool?.key === spool.key) {
      this.studio.change((plate) => withSpool(plate, renamed));
    }
    this.requestUpdate();
  }

  async #import(): Promise<void> {
    const [file] = await this.studio.pick('.json,application/json');
    if (file === undefined) return;
    try {
      const read = readSpools(await file.text());
      changeSpools(this.studio, (all) => read.reduce<readonly OwnSpool[]>(withOne, all));
      this.studio.notify(c('spools.imported', { n: read.length }));
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      this.studio.notify(c('spools.unreadable', { name: file.name, why }));
    }
  }

  #export = (): void => {
    const text = spoolsText(this.state.spools ?? []);
    this.studio.deliver(new Blob([text], { type: 'application/json' }), 'spools.json');
  };
}

const dot = (colour: readonly number[]): TemplateResult =>
  html`<span class="colour" .style=${`--colour: rgb(${colour.join(' ')})`}></span>`;

const slopes = ([along, across]: readonly [number, number]): TemplateResult =>
  html`<span class="note"
    >${c('spools.slopes', { along: formatNumber(along, 1), across: formatNumber(across, 1) })}</span
  >`;
