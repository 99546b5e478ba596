// Menu of the files that can be downloaded, below the reasons why the plate may disappoint.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { words } from '../i18n/en/export.js';
import { warningText } from '../i18n/say-core.js';
import { say, t } from '../i18n/text.js';
import { isOf } from '../model/result.js';
import '../quality/doubts-list.js';
import { StudioElement } from '../controls/element.js';
import { icon, type IconName } from '../controls/icons.js';
import { menuStyle } from '../controls/menu-style.js';
import type { Product } from '../studio/studio.js';
import { button } from '../controls/button.js';

/** All files of a plate, with their icons. */
export const products: readonly (readonly [Product, IconName])[] = [
  ['gcode', 'print'],
  ['body', 'body'],
  ['zones', 'body'],
  ['svg', 'toolpath'],
  ['png', 'camera'],
  ['loop', 'video'],
  ['view', 'sun'],
  ['project', 'file'],
];

@customElement('sillon-downloads')
export class Downloads extends StudioElement {
  static override reads = ['plate', 'result'] as const;

  static override styles = [
    menuStyle,
    css`
      :host {
        display: block;
      }
      sillon-doubts,
      p {
        padding: 4px 10px 0;
      }
      p {
        max-width: 24rem;
      }
    `,
  ];

  override render(): TemplateResult {
    const { plate, result } = this.state;
    const { print } = plate;
    const known = result !== undefined && !result.coarse && isOf(result, plate) ? result.report.warnings : [];
    // Warnings about layers: letters, codes and pictures that nobody will see.
    const unseen = known.filter(({ values }) => 'layer' in values);
    return html`<sillon-doubts .studio=${this.studio}></sillon-doubts>
      ${unseen.map(
        (warning) =>
          html`<p class="warning" role="status">${icon('warn', 16)} <span>${warningText(warning)}</span></p>`,
      )}
      ${products.map(([product, name]) => {
        const missing = product === 'body' && print.base === 0;
        const help: keyof typeof words = missing ? 'export.body.none' : `export.${product}.help`;
        const save = (): void => void this.studio.save(product);
        return this.#item(name, t(`export.${product}`), say(words, help), save, missing);
      })}
      <hr />
      ${this.#item('share', t('verb.share'), say(words, 'export.link.help'), this.studio.opens('share'))}`;
  }

  #item(name: IconName, label: string, help: string, run: () => void, disabled = false): TemplateResult {
    return button(
      { look: 'item', disabled },
      html`${icon(name, 20)}<span>${label}</span>${help === '' ? nothing : html`<span class="note">${help}</span>`}`,
      () => {
        this.dispatchEvent(new Event('done'));
        run();
      },
    );
  }
}
