// The keys of shortcuts.ts, in readable form.
import { words } from '../i18n/en/help.js';
import { say } from '../i18n/text.js';

interface Shortcut {
  /** Keys as the help sheet shows them; several are alternatives. */
  shown: readonly string[];
  text: keyof typeof words;
}

export const shortcuts: readonly Shortcut[] = [
  { shown: ['?'], text: 'keys.help' },
  { shown: ['Ctrl K'], text: 'keys.palette' },
  { shown: ['Ctrl O'], text: 'keys.open' },
  { shown: ['Ctrl S'], text: 'keys.save' },
  { shown: ['Ctrl Shift S'], text: 'keys.file' },
  { shown: ['Ctrl P'], text: 'keys.card' },
  { shown: ['Ctrl Z'], text: 'keys.undo' },
  { shown: ['Ctrl Shift Z', 'Ctrl Y'], text: 'keys.redo' },
  { shown: ['1', '2', '3', '4'], text: 'keys.views' },
  { shown: ['← ↑ → ↓'], text: 'keys.move' },
  { shown: ['← ↑ → ↓', 'Shift', 'Alt'], text: 'keys.layer' },
  { shown: ['Del'], text: 'keys.layerDelete' },
  { shown: ['+', '-'], text: 'keys.zoom' },
  { shown: ['0'], text: 'keys.fit' },
  { shown: ['V', 'B', 'M', 'E'], text: 'keys.tools' },
  { shown: ['[', ']'], text: 'keys.radius' },
  { shown: [',', '.'], text: 'keys.light' },
  { shown: ['C'], text: 'keys.compare' },
  { shown: ['P'], text: 'keys.play' },
  { shown: ['Esc'], text: 'keys.cancel' },
];

const keyNames = { Ctrl: 'key.ctrl', Shift: 'key.shift', Esc: 'key.escape', Del: 'key.delete' } as const;

/** Returns keys by their names on the keyboard, such as "Ctrl Shift Z". */
export const keysText = (keys: string): string =>
  keys
    .split(' ')
    .map((key) => (key in keyNames ? say(words, keyNames[key as keyof typeof keyNames]) : key))
    .join(' ');
