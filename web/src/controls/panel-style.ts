import { css } from 'lit';

export const panelStyle = css`
  :host {
    display: block;
  }
  section {
    display: grid;
    gap: 12px;
    padding: 18px 20px;
    border-bottom: 1px solid var(--line);
  }
  section:last-of-type {
    border-bottom: 0;
  }
  @media (max-width: 720px) {
    section:first-of-type {
      padding-top: 4px; /* below the sheet's grip */
    }
  }
  .buttons {
    display: flex;
    flex-wrap: wrap;
    gap: 6px;
  }
  .pair {
    display: grid;
    grid-template-columns: 1fr auto 1fr;
    align-items: center;
    gap: 8px;
    margin-top: 4px;
    color: var(--soft);
  }
  .pair .measure {
    width: 100%;
    min-width: 0;
  }
  .stacked {
    grid-template-columns: 1fr;
  }
  .rows {
    display: grid;
    gap: 14px;
    margin-top: 12px;
  }
  .warning {
    display: flex;
    align-items: start;
    gap: 6px;
    color: var(--bad);
    font-size: var(--note);
  }
  .angle {
    display: grid;
    grid-template-columns: 1fr auto auto;
    align-items: center;
    gap: 10px;
  }
`;
