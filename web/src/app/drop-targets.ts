// Covers the page while files are dragged, and shows what they will become where they are dropped.
import { css, html, type TemplateResult } from 'lit';
import { customElement, query, state } from 'lit/decorators.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';
import { words } from '../i18n/en/files.js';
import { say } from '../i18n/text.js';
import { composes } from '../studio/shown.js';
import type { PointerPlace } from './take-in.js';

declare global {
  interface HTMLElementTagNameMap {
    'sillon-drop': DropTargets;
  }
}

@customElement('sillon-drop')
export class DropTargets extends StudioElement {
  static override reads = ['plate', 'panel'] as const;

  static override styles = css`
    :host {
      position: fixed;
      inset: 0;
      z-index: 10;
      display: grid;
      grid-template-rows: 1fr auto;
      gap: 12px;
      padding: 14px;
      pointer-events: none;
    }
    .target {
      display: grid;
      align-content: center;
      justify-items: center;
      gap: 8px;
      padding: 16px;
      border: 2px dashed var(--accent);
      border-radius: 14px;
      background: color-mix(in srgb, var(--surface) 92%, transparent);
      text-align: center;
    }
    b {
      font-size: var(--display);
      letter-spacing: -0.02em;
    }
    .layer {
      align-content: start;
      background: color-mix(in srgb, var(--surface) 45%, transparent); /* the place on the plate is chosen */
    }
    .layer span,
    .layer b {
      padding: 2px 14px;
      border-radius: var(--radius-large);
      background: var(--raised);
    }
    .shape {
      min-height: max(96px, 22vh);
    }
    .over {
      border-style: solid;
      border-width: 3px;
      background: color-mix(in srgb, var(--tint) 92%, transparent);
    }
    .layer.over {
      background: color-mix(in srgb, var(--tint) 45%, transparent);
    }
  `;

  @state() private over: 'layer' | 'shape' = 'layer';
  @query('.shape') private shape!: HTMLElement | null;

  override connectedCallback(): void {
    super.connectedCallback();
    this.listen('dragover', (event) => {
      this.over = this.isShape(event) ? 'shape' : 'layer';
    });
  }

  override render(): TemplateResult {
    if (!composes(this.state)) return this.#target('target', 'now', 'help');
    const look = (name: 'layer' | 'shape'): string => `target ${name} ${this.over === name ? 'over' : ''}`;
    return html`${this.#target(look('layer'), 'layer', 'layerHelp')}
    ${this.#target(look('shape'), 'shape', 'shapeHelp')}`;
  }

  #target(look: string, what: 'now' | 'layer' | 'shape', help: 'help' | 'layerHelp' | 'shapeHelp'): TemplateResult {
    const image = what === 'now' ? 'download' : what === 'layer' ? 'layers' : 'shape';
    return html`<div class=${look} role="status">
      ${icon(image, 40)}<b>${say(words, `drop.${what}`)}</b><span class="note">${say(words, `drop.${help}`)}</span>
    </div>`;
  }

  /** Tells whether a file dropped there is meant for the plate's shape. */
  isShape({ clientX: x, clientY: y }: PointerPlace): boolean {
    const box = this.shape?.getBoundingClientRect();
    return box !== undefined && x >= box.left && x <= box.right && y >= box.top && y <= box.bottom;
  }
}
