// Buttons as functions of plain data.
import { html, nothing, type TemplateResult } from 'lit';

interface Look {
  /** Classes of controls.ts, such as 'main', 'plain' or 'link'. */
  look?: string;
  /** Name of a button whose content is no text; it is also its title. */
  name?: string;
  /** Name alone, and title alone. */
  label?: string;
  title?: string;
  /** Its shortcut, as ARIA writes it. */
  keys?: string;
  disabled?: boolean;
  /** State of a switch. */
  pressed?: boolean | undefined;
}

/** Returns a button. @param how  its look; a text gives its classes alone @param content  a text, an icon, or both */
export function button(how: Look | string, content: unknown, run: (event: Event) => unknown): TemplateResult {
  const {
    look = '',
    name,
    label = name,
    title = name,
    keys,
    disabled = false,
    pressed,
  } = typeof how === 'string' ? { look: how } : how;
  return html`<button
    class=${look || nothing}
    aria-label=${label ?? nothing}
    title=${title ?? nothing}
    aria-keyshortcuts=${keys ?? nothing}
    aria-pressed=${pressed ?? nothing}
    ?disabled=${disabled}
    @click=${run}
  >
    ${content}
  </button>`;
}
