// View files without an engine: docs/reference/view.md.
import { png } from '../../../../wasm/test/support/png.js';

/** A plate of 40 mm whose beads go round its middle. @param side  [texels] */
export function roundView(side) {
  const texels = new Uint8Array(3 * side * side);
  for (let k = 0; k < side * side; ++k) {
    const [x, y] = [(k % side) + 0.5 - side / 2, side / 2 - Math.floor(k / side) - 0.5];
    const turn = ((Math.atan2(x, -y) / Math.PI + 1) * 256) % 256;
    texels.set([turn, Math.hypot(x, y) < side / 2 ? 255 : 0, 128], 3 * k);
  }
  return png(side, side, 3, texels, 'sillon-view 1 page 40000 40000 spacing 450 colour 201 148 46 slopes 300 1500');
}
