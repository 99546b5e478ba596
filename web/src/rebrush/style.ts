import { css } from 'lit';

export const rebrushStyle = css`
  dialog {
    width: 100vw;
    max-width: none;
    height: 100dvh;
    max-height: none;
    border: 0;
    border-radius: 0;
    box-shadow: none;
  }
  dialog[open] {
    display: grid;
    grid-template: auto auto minmax(0, 1fr) / minmax(0, 1fr) 360px;
  }
  /* What is told behind the sheet could be neither read nor pressed. */
  dialog > .told {
    grid-column: 1 / -1;
    justify-self: stretch;
    width: auto;
    max-height: 30dvh;
  }
  dialog > .head {
    grid-column: 1 / -1;
    min-height: var(--bar);
    padding: 8px 12px;
    border-bottom: 1px solid var(--line);
    justify-content: start;
  }
  .head h2 {
    flex: 1;
    min-width: 0;
    font-size: var(--lead);
  }
  .head h2:focus {
    outline: none; /* where reading begins: there is nothing to press */
  }
  .side {
    display: grid;
    grid-template: minmax(0, 1fr) auto / minmax(0, 1fr);
    min-height: 0;
    border-left: 1px solid var(--line);
  }
  .scroll {
    display: grid;
    grid-template-columns: minmax(0, 1fr);
    align-content: start;
    gap: 22px;
    padding: 16px;
    overflow: auto;
    overscroll-behavior: contain;
    scrollbar-width: thin;
    scrollbar-color: var(--line) transparent;
  }
  section {
    display: grid;
    grid-template-columns: minmax(0, 1fr);
    gap: 10px;
    min-width: 0;
  }
  .title {
    display: flex;
    align-items: baseline;
    gap: 4px 10px;
    flex-wrap: wrap;
  }
  .title h3 {
    flex: 1;
  }
  .faces {
    display: grid;
    max-height: 264px;
    overflow: auto;
    border: 1px solid var(--line);
    border-radius: var(--radius);
    background: var(--raised);
    scrollbar-width: thin;
  }
  .faces label {
    display: grid;
    grid-template-columns: auto 1fr auto;
    align-items: center;
    gap: 0 10px;
    min-height: 40px;
    padding: 5px 10px;
    cursor: pointer;
  }
  .faces li + li {
    border-top: 1px solid var(--line);
  }
  .faces label:has(:focus-visible) {
    outline: 2px solid var(--accent);
    outline-offset: -2px;
  }
  .faces input {
    width: 16px;
    height: 16px;
    margin: 0;
    accent-color: var(--accent);
  }
  .faces .what {
    display: grid;
    min-width: 0;
    overflow-wrap: anywhere;
  }
  @media (hover: hover) {
    .faces label:hover {
      background: var(--hover);
    }
  }
  details ul {
    display: grid;
    gap: 4px;
    padding-left: 2px;
  }
  .angle,
  .stands {
    display: grid;
    grid-template-columns: auto 1fr auto;
    align-items: center;
    gap: 4px 12px;
  }
  .angle sillon-dial,
  .stands sillon-dial {
    width: 52px;
    height: 52px;
  }
  .stands > span {
    display: grid;
    grid-column: span 2;
  }
  .picture {
    display: grid;
    grid-template-columns: 64px 1fr auto;
    align-items: center;
    gap: 10px;
  }
  .picture img {
    width: 64px;
    height: 64px;
    object-fit: cover;
    border-radius: var(--radius);
  }
  .picture b {
    font-weight: 500;
  }
  .foot {
    display: grid;
    grid-template-columns: minmax(0, 1fr);
    gap: 10px;
    padding: 12px 16px calc(12px + env(safe-area-inset-bottom));
    border-top: 1px solid var(--line);
  }
  .foot button.main {
    min-height: calc(var(--control) + 8px);
  }
  .foot button.main span {
    min-width: 0;
  }
  .job {
    display: grid;
    grid-template-columns: 1fr auto;
    align-items: center;
    gap: 6px 10px;
  }
  .bar {
    grid-column: 1 / -1;
    height: 3px;
    border-radius: 2px;
    background: var(--line);
    overflow: hidden;
  }
  .bar div {
    height: 100%;
    width: calc(100% * var(--share));
    background: var(--accent);
  }
  .problem {
    display: grid;
    grid-template-columns: auto 1fr;
    gap: 8px;
    padding: 10px 12px;
    border-radius: var(--radius);
    background: var(--bad-tint);
  }
  .problem .icon {
    color: var(--bad);
  }
  .problem p {
    overflow-wrap: anywhere;
  }
  .problem div {
    display: grid;
    gap: 4px;
  }
  .alone {
    grid-column: 1 / -1;
    display: grid;
    place-content: center;
    gap: 16px;
    width: min(560px, 100%);
    margin: auto;
    padding: 24px;
  }
  .alone .job {
    width: min(420px, 80vw);
  }
  .bar.unknown div {
    width: 30%;
  }
  @media (prefers-reduced-motion: no-preference) {
    .bar.unknown div {
      animation: pass 1.2s linear infinite;
    }
    @keyframes pass {
      from {
        transform: translateX(-100%);
      }
      to {
        transform: translateX(340%);
      }
    }
  }
  @media (max-width: 720px) {
    dialog[open] {
      grid-template: auto auto minmax(0, 2fr) minmax(0, 3fr) / minmax(0, 1fr);
    }
    .side {
      border-left: 0;
      border-top: 1px solid var(--line);
    }
    .faces {
      max-height: none;
    }
    .back span {
      position: absolute;
      clip-path: inset(50%);
    }
  }
  /* A low page scrolls as a whole: the bench is not worth its room there. */
  @media (max-height: 480px) {
    dialog[open] {
      grid-template: auto auto minmax(0, 1fr) / minmax(0, 1fr) minmax(0, 1fr);
    }
    .side {
      display: block;
      overflow: auto;
    }
    .scroll,
    .faces {
      overflow: visible;
      max-height: none;
    }
  }
`;

/** Styles of the buttons over the print. */
export const zoomButtons = css`
  .zoom {
    position: absolute;
    right: 8px;
    bottom: 8px;
    display: flex;
  }
`;
