// The hand and the brushes, beside the plate.
import { css, html, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import type { Tool } from '../model/state.js';
import { StudioElement } from '../controls/element.js';
import { icon, type IconName } from '../controls/icons.js';

const tools: readonly (readonly [Tool, IconName, string])[] = [
  ['pan', 'hand', 'V'],
  ['comb', 'comb', 'B'],
  ['mode', 'mode', 'M'],
  ['erase', 'erase', 'E'],
];

@customElement('sillon-tools')
export class ToolPalette extends StudioElement {
  static override reads = ['tool'] as const;

  static override styles = css`
    :host {
      display: flex;
      flex-direction: column;
      gap: 2px;
      padding: 3px;
    }
    button.square {
      width: calc(var(--control) + 4px);
      min-height: calc(var(--control) + 4px);
    }
  `;

  override render(): TemplateResult {
    return html`${tools.map(
      ([tool, name, key]) =>
        html`<button
          class="plain square"
          aria-label=${t(`tool.${tool}`)}
          aria-keyshortcuts=${key}
          aria-pressed=${String(this.state.tool === tool)}
          title="${t(`tool.${tool}`)} (${key})"
          @click=${() => this.studio.setTool(tool)}
        >
          ${icon(name, 20)}
        </button>`,
    )}`;
  }
}
