// Styles for the page of calibration prints.
import { css } from 'lit';

export const printStyle = css`
  :host {
    display: grid;
    gap: 14px;
    min-height: 0;
  }
  .both {
    display: grid;
    grid-template-columns: minmax(0, 5fr) minmax(0, 6fr);
    align-items: start;
    gap: 24px;
  }
  .kinds {
    display: grid;
    gap: 6px;
  }
  .kinds .card {
    grid-template-columns: 48px minmax(0, 1fr) auto;
    gap: 4px 12px;
    min-height: 60px;
    padding: 6px 12px 6px 8px;
    transition: background var(--quick);
  }
  @media (hover: hover) {
    .kinds .card:hover:not(:has(:checked)) {
      background: var(--hover);
    }
  }
  .drawing {
    display: block;
    width: 48px;
    height: 48px;
  }
  .words span,
  .cost {
    color: var(--soft);
    font-size: var(--note);
  }
  .cost {
    white-space: nowrap;
  }
  .about-it {
    position: sticky;
    top: 0;
    display: grid;
    gap: 10px;
    justify-items: start;
    scroll-margin-top: 8px;
  }
  .about-it > .field,
  .about-it > .tried {
    width: 100%;
  }
  h3 {
    margin-top: 6px;
  }
  figure {
    width: 100%;
  }
  figure img,
  .blank {
    display: grid;
    width: 100%;
    max-height: 300px;
    object-fit: contain;
    border-radius: var(--radius-large);
    background: #262422;
  }
  .blank {
    place-content: center;
    min-height: 200px;
    background: var(--sunken);
  }
  .blank .drawing {
    width: 96px;
    height: 96px;
    color: var(--edge);
  }
  .take {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 6px 12px;
  }
  .take button {
    min-height: max(38px, var(--control));
  }
  .warned {
    display: flex;
    gap: 6px;
  }
  .warned .icon {
    margin-top: 2px;
    color: var(--accent);
  }
  .problem {
    display: flex;
    gap: 6px;
    padding: 10px 12px;
    border-radius: var(--radius-large);
    background: var(--bad-tint);
    color: var(--bad);
  }
  .tried {
    display: flex;
    flex-wrap: wrap;
    gap: 6px;
  }
  .tried .card {
    place-content: center;
    min-width: 44px;
    min-height: var(--control);
    padding: 0 8px;
    border-radius: var(--radius);
  }
  .tried .card:has(:checked) {
    color: var(--accent);
  }
  code {
    padding: 3px 8px;
    border-radius: var(--radius);
    background: var(--sunken);
    user-select: all;
  }
  @media (max-width: 860px) {
    .both {
      grid-template-columns: minmax(0, 1fr);
    }
    .about-it {
      position: static;
    }
  }
  @media (max-width: 480px) {
    .kinds .card {
      grid-template-columns: 40px minmax(0, 1fr);
    }
    .drawing {
      width: 40px;
      height: 40px;
      grid-row: span 2;
    }
    .cost {
      grid-column: 2;
    }
  }
`;
