// Styles for photographs beside the values read from them.
import { css } from 'lit';

export const photoStyle = css`
  :host {
    display: grid;
    gap: 14px;
  }
  .both {
    display: grid;
    grid-template-columns: minmax(0, 1fr) minmax(0, 1fr);
    align-items: start;
    gap: 24px;
  }
  .left,
  .right {
    display: grid;
    gap: 12px;
    justify-items: start;
  }
  .left > .field {
    width: 100%;
  }
  .drop {
    display: grid;
    width: 100%;
    border-radius: var(--radius-large);
    place-content: center;
    justify-items: center;
    gap: 10px;
    min-height: 260px;
    padding: 20px;
    border: 2px dashed var(--edge);
    color: var(--soft);
    text-align: center;
  }
  .over {
    border-color: var(--accent);
    outline: 2px solid var(--accent);
  }
  .shots {
    display: grid;
    width: 100%;
  }
  .shots li {
    display: grid;
    grid-template-columns: 88px minmax(0, 1fr) auto;
    align-items: center;
    gap: 4px 12px;
    padding: 8px;
  }
  .shots li + li {
    border-top: 1px solid var(--line);
  }
  .shots img {
    display: block;
    width: 88px;
    height: 66px;
    object-fit: cover;
    border-radius: var(--radius);
    background: var(--sunken);
  }
  .told {
    display: grid;
    gap: 2px;
  }
  .shots .title {
    font-weight: 600;
  }
  .why {
    font-size: var(--note);
  }
  .why b {
    color: var(--bad);
  }
  figure img {
    display: block;
    width: 100%;
    max-height: 420px;
    object-fit: contain;
    border-radius: var(--radius-large);
    background: var(--sunken);
  }
  figure {
    width: 100%;
  }
  ol {
    display: grid;
    gap: 6px;
    padding-left: 20px;
  }
  h2 {
    display: flex;
    align-items: center;
    gap: 8px;
  }
  dl {
    display: grid;
    width: 100%;
  }
  dl div {
    display: grid;
    grid-template-columns: minmax(0, 1fr) fit-content(65%);
    align-items: baseline;
    gap: 16px;
    padding: 9px 14px;
  }
  dl div + div {
    border-top: 1px solid var(--line);
  }
  dt {
    color: var(--soft);
  }
  dd {
    font-weight: 600;
    text-align: end;
  }
  .refused {
    display: grid;
    gap: 8px;
    padding: 14px 16px;
    border-radius: var(--radius-large);
    background: var(--bad-tint);
    color: var(--bad);
  }
  .refused p {
    color: var(--ink);
  }
  .keep {
    display: grid;
    grid-template-columns: auto minmax(0, 1fr) auto;
    align-items: end;
    gap: 12px;
    width: 100%;
  }
  .colour {
    width: 36px;
    height: 36px;
    border-radius: 50%;
    background: var(--colour);
    box-shadow: inset 0 0 0 1px var(--edge);
  }
  .busy {
    color: var(--soft);
  }
  @media (max-width: 760px) {
    .both {
      grid-template-columns: minmax(0, 1fr);
    }
  }
  @media (max-width: 420px) {
    .shots li {
      grid-template-columns: 64px minmax(0, 1fr) auto;
    }
    .shots img {
      width: 64px;
      height: 48px;
    }
    .keep {
      grid-template-columns: auto minmax(0, 1fr);
    }
    .keep button {
      grid-column: 1 / -1;
    }
  }
`;
