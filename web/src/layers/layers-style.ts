// Styles of the list of layers, and of the tiles that add to it.
import { css } from 'lit';

export const layersStyle = css`
  ul {
    display: grid;
    gap: 2px;
  }
  li {
    display: grid;
    grid-template-columns: auto minmax(0, 1fr) auto;
    align-items: center;
    border: 1px solid transparent;
    border-radius: var(--radius-large);
  }
  li.chosen {
    border-color: color-mix(in srgb, var(--accent) 45%, transparent);
    background: var(--tint);
  }
  .held {
    box-shadow: var(--lift);
  }
  .grip {
    display: grid;
    place-items: center;
    align-self: stretch;
    width: max(24px, calc(var(--control) * 0.75));
    color: var(--soft);
    cursor: grab;
    touch-action: none; /* else the panel would scroll */
  }
  .held .grip {
    cursor: grabbing;
  }
  li > button.row:first-child {
    grid-column: 1 / 3;
  }
  li button.row,
  li.below button {
    justify-content: start;
    gap: 10px;
    min-height: calc(var(--control) + 6px);
    padding: 0 8px;
    text-align: left;
  }
  li.chosen button.row {
    border-color: transparent;
    background: none;
  }
  .off {
    color: var(--soft);
    text-decoration: line-through;
  }
  li .actions {
    grid-column: 1 / -1;
    display: flex;
    gap: 2px;
    padding: 0 4px 4px;
  }
  li .actions button:last-child {
    margin-left: auto;
  }
  li.warned .row > .icon {
    color: var(--bad);
  }
  li.below {
    margin-top: 2px;
    border-top: 1px dashed var(--line);
    border-radius: 0;
  }
  li.below button {
    grid-column: 1 / -1;
    color: var(--soft);
  }
  .strokes {
    display: flex;
    align-items: center;
    justify-content: space-between;
    min-height: var(--control);
  }
  .tiles {
    display: grid;
    grid-template-columns: repeat(auto-fill, minmax(max(64px, 4rem), 1fr));
    gap: 6px;
  }
  .tiles button {
    flex-direction: column;
    justify-content: start;
    gap: 6px;
    padding: 6px 3px 8px;
    font-size: var(--small);
  }
  .tiles span {
    max-width: 100%;
    overflow-wrap: anywhere;
  }
  .tile {
    display: block;
    width: 100%;
    max-width: 80px;
    stroke-width: 1.2;
  }
  .tile .below {
    color: var(--edge);
    stroke: var(--edge);
  }
  .tile .above {
    stroke: var(--accent);
    stroke-width: 1.5;
  }
  .size > span {
    width: var(--control);
  }
  .rows:empty {
    display: none;
  }
`;
