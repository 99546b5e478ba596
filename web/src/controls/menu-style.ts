// Styles of the rows of a menu: an icon, the action, and a note about it.
import { css } from 'lit';

export const menuStyle = css`
  .item {
    display: grid;
    grid-template-columns: auto 1fr;
    justify-items: start;
    gap: 0 12px;
    width: 100%;
    padding: 8px 10px;
    border-color: transparent;
    background: none;
    text-align: left;
  }
  .item:hover {
    background: var(--hover);
  }
  .item .icon {
    grid-row: span 2;
    color: var(--accent);
  }
  .item:disabled .icon {
    color: inherit;
  }
  hr {
    margin: 6px 10px;
    border: 0;
    border-top: 1px solid var(--line);
  }
`;
