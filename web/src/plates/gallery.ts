// Dialog with the plates to begin with.
import { css, html, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import { DialogElement } from '../controls/dialog.js';
import type { Example } from '../model/example.js';
import { examples } from './examples.js';
import { templates } from './templates.js';
import { button } from '../controls/button.js';

@customElement('sillon-gallery')
export class Gallery extends DialogElement {
  static override styles = css`
    dialog {
      width: min(980px, calc(100vw - 24px));
    }
    .plates {
      display: grid;
      grid-template-columns: repeat(auto-fill, minmax(140px, 1fr));
      gap: 10px;
    }
    .plates button {
      display: grid;
      grid-template: auto 1fr / 1fr;
      align-items: start;
      gap: 6px;
      width: 100%;
      height: 100%;
      padding: 8px 8px 10px;
      border-color: transparent;
      background: none;
      font-weight: 500;
    }
    .plates button:hover {
      background: var(--hover);
    }
    .plates .picture {
      aspect-ratio: 1; /* also before the picture is there, which takes no room then */
    }
    .plates img {
      display: block;
      width: 100%;
      height: 100%;
      object-fit: contain;
    }
  `;

  protected override heading = (): string => t('section.gallery');

  protected override body(): TemplateResult {
    return html`<ul class="plates">
      ${[...examples.slice(0, 1), ...templates, ...examples.slice(1)].map(
        (example) =>
          html`<li>
            ${button(
              '',
              html`<span class="picture"
                  ><img src="gallery/${example.id}.webp" alt="" width="320" height="320" loading="lazy"
                /></span>
                <span>${t(`example.${example.id}`)}</span>`,
              () => void this.#open(example),
            )}
          </li>`,
      )}
    </ul>`;
  }

  async #open(example: Example): Promise<void> {
    this.close();
    const opened = await this.studio.attempt(() => this.studio.services.openExample(example));
    // The Layers section has the words and pictures that visitors replace with their own.
    if (opened && example.layers.length > 1 && this.studio.store.state.panel !== '') this.studio.setPanel('layers');
  }
}
