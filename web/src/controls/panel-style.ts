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
  .pair {
    display: grid;
    grid-template-columns: 1fr auto 1fr;
    align-items: center;
    gap: 8px;
    margin-top: 4px;
    color: var(--soft);
  }
  .size {
    display: grid;
    grid-template-columns: 1fr auto 1fr;
    align-items: end;
    gap: 8px;
  }
  :is(.pair, .size, .plate) .measure {
    width: 100%;
    min-width: 0;
  }
  :is(.size, .plate) label {
    display: block;
    margin-bottom: 4px;
  }
  .stacked {
    grid-template-columns: 1fr;
  }
  .rows {
    display: grid;
    gap: 14px;
    margin-top: 12px;
  }
  .angle {
    display: grid;
    grid-template-columns: 1fr auto auto;
    align-items: center;
    gap: 10px;
  }
`;
