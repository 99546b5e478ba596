// Styles of buttons, fields and text in all elements.
import { css } from 'lit';

export const controls = css`
  *,
  *::before,
  *::after {
    box-sizing: border-box;
  }
  :host {
    color: var(--ink);
    font: var(--text) / 1.45 var(--font);
  }
  :host([hidden]),
  [hidden] {
    display: none !important;
  }
  h1,
  h2,
  h3,
  p,
  ul,
  dl,
  dd,
  figure,
  ol {
    margin: 0;
    padding: 0;
    border: 0;
    min-width: 0;
  }
  ul {
    list-style: none;
  }
  figcaption {
    margin-top: 4px;
  }
  h2 {
    font-size: var(--title);
    font-weight: 600;
    letter-spacing: -0.01em;
    line-height: 1.25;
  }
  b {
    font-weight: 600;
  }
  h3 {
    font-size: var(--small);
    font-weight: 600;
    letter-spacing: 0.07em;
    text-transform: uppercase;
    color: var(--soft);
  }
  .icon {
    flex: none;
    display: block;
  }
  .note {
    color: var(--soft);
    font-size: var(--note);
  }
  .figures {
    font-variant-numeric: tabular-nums;
  }
  .cut {
    overflow: hidden;
    text-overflow: ellipsis;
    white-space: nowrap;
  }
  p.warning {
    display: flex;
    align-items: start;
    gap: 6px;
    color: var(--bad);
    font-size: var(--note);
  }
  .buttons {
    display: flex;
    flex-wrap: wrap;
    gap: 6px;
  }
  .stack {
    display: grid;
    gap: 12px;
  }
  .board {
    border: 1px solid var(--line);
    border-radius: var(--radius-large);
    background: var(--raised);
  }
  /* Lies over the plate or the page. */
  .raft,
  dialog {
    border: 1px solid var(--line);
    border-radius: var(--radius-large);
    background: var(--surface);
    box-shadow: var(--lift);
  }
  .tag {
    padding: 2px 8px;
    border-radius: var(--radius);
    background: var(--surface);
    color: var(--soft);
    font-size: var(--note);
  }
  :focus {
    outline: none;
  }
  :focus-visible {
    outline: 2px solid var(--accent);
    outline-offset: 2px;
  }

  button,
  .button {
    display: inline-flex;
    align-items: center;
    justify-content: center;
    gap: 6px;
    min-height: var(--control);
    padding: 0 12px;
    border: 1px solid var(--line);
    border-radius: var(--radius);
    background: var(--raised);
    color: var(--ink);
    font: inherit;
    font-weight: 500;
    line-height: 1.2;
    cursor: pointer;
    user-select: none;
    touch-action: manipulation;
    transition:
      background var(--quick),
      color var(--quick),
      border-color var(--quick);
  }
  @media (hover: hover) {
    button:hover:not(:disabled) {
      background: var(--hover);
    }
  }
  button:disabled {
    color: var(--edge);
    cursor: default;
  }
  button.main {
    border-color: transparent;
    background: var(--accent);
    color: var(--on-accent);
    font-weight: 600;
  }
  @media (hover: hover) {
    button.main:hover:not(:disabled) {
      background: var(--accent-hover);
    }
  }
  button.main:disabled {
    background: var(--hover);
    color: var(--soft);
  }
  button.plain {
    border-color: transparent;
    background: none;
  }
  button.square {
    width: var(--control);
    padding: 0;
  }
  button[aria-pressed='true'],
  button[aria-expanded='true'].keeps {
    background: var(--tint);
    border-color: color-mix(in srgb, var(--accent) 45%, transparent);
    color: var(--accent);
  }
  button.link {
    min-height: 24px;
    padding: 0 2px;
    border: 0;
    background: none;
    color: var(--accent);
    text-decoration: underline;
    text-decoration-thickness: 1px;
    text-underline-offset: 3px;
  }

  input,
  select,
  textarea {
    font: inherit;
    color: var(--ink);
  }
  input[type='text'],
  select,
  textarea {
    min-height: var(--control);
    padding: 0 8px;
    border: 1px solid var(--edge);
    border-radius: var(--radius);
    background: var(--raised);
    width: 100%;
  }
  textarea {
    padding: 6px 8px;
    resize: vertical;
    min-height: 60px;
  }
  select {
    appearance: none;
    padding-right: 26px;
    text-overflow: ellipsis;
    background-image:
      linear-gradient(45deg, transparent 50%, var(--soft) 50%),
      linear-gradient(-45deg, transparent 50%, var(--soft) 50%);
    background-position:
      right 13px center,
      right 9px center;
    background-size: 4px 4px;
    background-repeat: no-repeat;
  }
  input[role='spinbutton'] {
    text-align: right;
    font-variant-numeric: tabular-nums;
  }
  input[aria-invalid='true'] {
    border-color: var(--bad);
  }
  input:focus-visible,
  select:focus-visible,
  textarea:focus-visible {
    outline-offset: 0;
  }

  input[type='range'] {
    --fill: calc(var(--share, 0.5) * (100% - 14px) + 7px);
    appearance: none;
    display: block;
    width: 100%;
    height: 22px;
    margin: 0;
    padding: 0;
    background: none;
    cursor: pointer;
    touch-action: pan-y;
  }
  input[type='range']::-webkit-slider-runnable-track {
    height: 3px;
    border-radius: 2px;
    background: linear-gradient(to right, var(--accent) var(--fill), var(--line) var(--fill));
  }
  input[type='range']::-moz-range-track {
    height: 3px;
    border-radius: 2px;
    background: linear-gradient(to right, var(--accent) var(--fill), var(--line) var(--fill));
  }
  input[type='range']::-webkit-slider-thumb {
    appearance: none;
    width: 14px;
    height: 14px;
    margin-top: -5.5px;
    border: 1.5px solid var(--accent);
    border-radius: 50%;
    background: var(--raised);
    box-shadow: 0 1px 2px var(--shade);
  }
  input[type='range']::-moz-range-thumb {
    width: 11px;
    height: 11px;
    border: 1.5px solid var(--accent);
    border-radius: 50%;
    background: var(--raised);
    box-shadow: 0 1px 2px var(--shade);
  }
  @media (pointer: coarse) {
    input[type='range'] {
      height: 32px;
      --fill: calc(var(--share, 0.5) * (100% - 22px) + 11px);
    }
    input[type='range']::-webkit-slider-thumb {
      width: 22px;
      height: 22px;
      margin-top: -9.5px;
    }
  }

  /* A label, what it names, and help that unfolds. */
  .field {
    display: grid;
    grid-template-columns: 1fr auto;
    align-items: center;
    column-gap: 8px;
    row-gap: 2px;
  }
  .field > .name {
    display: flex;
    align-items: center;
    gap: 2px;
    min-width: 0;
  }
  .scrubs {
    cursor: ew-resize;
    user-select: none;
  }
  .field > .wide,
  .field > input[type='range'],
  .field > .help {
    grid-column: 1 / -1;
  }
  .field > .help {
    margin: 2px 0 4px;
    padding: 6px 9px;
    border-left: 2px solid var(--accent);
    background: var(--sunken);
    color: var(--soft);
    font-size: var(--note);
  }
  .field > .error {
    grid-column: 1 / -1;
    color: var(--bad);
    font-size: var(--note);
  }
  .field > .wide {
    margin-top: 3px;
  }
  button.about {
    min-height: 24px;
    width: 24px;
    padding: 0;
    border: 0;
    background: none;
    color: var(--soft);
  }
  .measure {
    display: grid;
    /* Six digits stay in sight beside a unit of any length. */
    grid-template-columns: minmax(calc(6ch + 12px), 1fr) auto;
    align-items: center;
    width: max-content;
    min-width: 112px;
    border: 1px solid var(--edge);
    border-radius: var(--radius);
    background: var(--raised);
  }
  .measure input[role='spinbutton'] {
    min-height: calc(var(--control) - 4px);
    border: 0;
    padding: 0 6px;
    background: none;
    width: 0;
    min-width: 100%;
  }
  .measure .unit {
    padding-right: 7px;
    color: var(--soft);
    font-size: var(--note);
    white-space: nowrap;
  }
  .measure:focus-within {
    outline: 2px solid var(--accent);
    outline-offset: 0;
  }
  .measure input:focus-visible {
    outline: none;
  }
  .measure:has([aria-invalid='true']) {
    border-color: var(--bad);
  }

  /* One of a few. */
  .segments {
    display: grid;
    grid-template-columns: repeat(var(--columns), 1fr);
    gap: 2px;
    padding: 2px;
    border-radius: calc(var(--radius) + 2px);
    background: var(--sunken);
    box-shadow: inset 0 0 0 1px var(--line);
  }
  .segments label,
  .cards label {
    position: relative;
    display: flex;
    align-items: center;
    justify-content: center;
    gap: 6px;
    min-height: calc(var(--control) - 4px);
    padding: 0 6px;
    border-radius: var(--radius);
    color: var(--soft);
    font-weight: 500;
    text-align: center;
    cursor: pointer;
    line-height: 1.15;
  }
  .segments input,
  .cards input,
  .card input,
  .swatches input {
    position: absolute;
    inset: 0;
    width: 100%;
    height: 100%;
    margin: 0;
    opacity: 0;
    cursor: pointer;
  }
  .segments label:has(:checked) {
    background: var(--raised);
    color: var(--ink);
    box-shadow:
      0 0 0 1px var(--line),
      0 1px 2px var(--shade);
  }
  .cards {
    display: grid;
    grid-template-columns: repeat(auto-fill, minmax(max(86px, 5rem), 1fr));
    gap: 6px;
  }
  .cards label {
    flex-direction: column;
    gap: 5px;
    min-height: 62px;
    padding: 8px 4px;
    border: 1px solid var(--line);
    background: var(--raised);
    font-size: var(--note);
  }
  .cards span {
    max-width: 100%;
    overflow-wrap: anywhere;
  }
  .cards img {
    width: 48px;
    height: 48px;
    object-fit: contain;
  }
  .cards label:has(:disabled) {
    color: var(--edge);
    cursor: default;
  }
  .cards label:has(:checked) {
    border-color: var(--accent);
    background: var(--tint);
    color: var(--accent);
    box-shadow: inset 0 0 0 1px var(--accent);
  }
  @media (hover: hover) {
    .segments label:hover,
    .cards label:hover:not(:has(:checked)) {
      color: var(--ink);
    }
  }
  .segments label:has(:focus-visible),
  .cards label:has(:focus-visible) {
    outline: 2px solid var(--accent);
    outline-offset: 2px;
  }

  .switch {
    display: flex;
    align-items: center;
    justify-content: space-between;
    gap: 12px;
    min-height: var(--control);
    cursor: pointer;
  }
  .switch input {
    appearance: none;
    flex: none;
    position: relative;
    width: 34px;
    height: 20px;
    margin: 0;
    border: 1px solid var(--edge);
    border-radius: 10px;
    background: var(--sunken);
    cursor: pointer;
    transition: background var(--quick);
  }
  .switch input::after {
    content: '';
    position: absolute;
    top: 2px;
    left: 2px;
    width: 14px;
    height: 14px;
    border-radius: 50%;
    background: var(--edge);
    transition: transform var(--quick);
  }
  .switch input:checked {
    border-color: var(--accent);
    background: var(--accent);
  }
  .switch input:checked::after {
    transform: translateX(14px);
    background: var(--on-accent);
  }

  /* Where the system's colours take the place of ours, it leaves no gradients and no backgrounds. */
  @media (forced-colors: active) {
    select,
    button.main,
    input[type='range'],
    .switch input {
      forced-color-adjust: none;
    }
    button[aria-pressed='true'],
    [aria-selected='true'],
    nav [aria-expanded='true'],
    .segments label:has(:checked),
    .cards label:has(:checked) {
      forced-color-adjust: none;
      background: Highlight !important;
      color: HighlightText !important;
    }
  }

  .file {
    display: flex;
    align-items: center;
    gap: 8px;
    padding: 6px 4px 6px 10px;
    border: 1px solid var(--line);
    border-radius: var(--radius);
    background: var(--raised);
  }
  .file .what {
    flex: 1;
    min-width: 0;
    display: grid;
  }
  .file b {
    font-weight: 500;
  }

  details > summary {
    display: flex;
    align-items: center;
    gap: 6px;
    min-height: var(--control);
    color: var(--soft);
    font-weight: 500;
    cursor: pointer;
    list-style: none;
  }
  details > summary::-webkit-details-marker {
    display: none;
  }
  details > summary .icon {
    transition: transform var(--quick);
    transform: rotate(-90deg);
  }
  details[open] > summary .icon {
    transform: none;
  }
`;
