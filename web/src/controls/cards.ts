// Styles of choices as cards: an invisible radio button covers each label.
import { css } from 'lit';

export const choiceCards = css`
  .card {
    position: relative;
    display: grid;
    align-items: center;
    cursor: pointer;
  }
  .card:has(:checked) {
    border-color: var(--accent);
    background: var(--tint);
    box-shadow: inset 0 0 0 1px var(--accent);
  }
  @media (forced-colors: active) {
    .card:has(:checked) {
      outline: 3px solid Highlight;
    }
  }
  .card:has(:focus-visible) {
    outline: 2px solid var(--accent);
    outline-offset: 2px;
  }
  .words {
    display: grid;
  }
  .drawing {
    color: var(--soft);
  }
  :checked ~ .drawing {
    color: var(--accent);
  }
`;
