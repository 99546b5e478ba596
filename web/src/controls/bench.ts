// Styles of a bench: canvases over each other that the user pans and zooms.
import { css } from 'lit';

export const bench = css`
  :host {
    position: relative;
    display: block;
    overflow: hidden;
    background: var(--bench);
    touch-action: none;
  }
  canvas {
    position: absolute;
    inset: 0;
    width: 100%;
    height: 100%;
    display: block;
  }
  .overlay {
    cursor: grab;
  }
  .overlay:focus-visible {
    outline-offset: -3px;
  }
`;
