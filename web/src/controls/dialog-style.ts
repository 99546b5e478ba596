// Styles of sheets above the page.
import { css } from 'lit';

export const dialogStyle = css`
  kbd {
    padding: 1px 6px;
    border: 1px solid var(--line);
    border-bottom-width: 2px;
    border-radius: var(--radius);
    background: var(--raised);
    color: var(--soft);
    font: inherit;
    font-size: var(--note);
    white-space: nowrap;
  }
  dialog {
    width: min(760px, calc(100vw - 24px));
    max-height: calc(100dvh - 24px);
    padding: 0;
    color: var(--ink);
    overflow: hidden;
  }
  dialog::backdrop {
    background: var(--veil);
  }
  dialog[open] {
    display: flex;
    flex-direction: column;
  }
  dialog > .head {
    display: flex;
    align-items: center;
    justify-content: space-between;
    gap: 12px;
    padding: 16px 16px 12px 24px;
  }
  dialog > sillon-notices {
    flex: none;
    width: 100%;
    max-height: 40%;
  }
  .body {
    display: grid;
    gap: 14px;
    padding: 0 24px 24px;
    overflow: auto;
  }
  dialog .end {
    position: sticky;
    bottom: -24px; /* down to the sheet's edge */
    margin-bottom: -24px;
    display: flex;
    flex-wrap: wrap;
    justify-content: end;
    gap: 8px;
    padding-block: 10px 24px;
    background: var(--surface);
  }
  @media (max-width: 560px) {
    dialog > .head {
      padding: 12px 12px 8px 16px;
    }
    dialog > .body {
      padding: 0 16px 16px;
    }
  }
  @media (prefers-reduced-motion: no-preference) {
    dialog[open] {
      animation: rise var(--calm) cubic-bezier(0.2, 0.8, 0.2, 1);
    }
    @keyframes rise {
      from {
        opacity: 0;
        transform: translateY(8px);
      }
    }
  }
`;
