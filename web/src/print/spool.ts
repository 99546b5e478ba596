// A spool as a round swatch, in its colour `--colour` and with the shine of wound filament.
import { css } from 'lit';

export const spoolColour = css`
  conic-gradient(
    from 20deg,
    rgb(255 255 255 / 0.5),
    transparent 50deg 150deg,
    rgb(255 255 255 / 0.35) 190deg,
    transparent 230deg 320deg,
    rgb(255 255 255 / 0.5)
  ),
  var(--colour)
`;
