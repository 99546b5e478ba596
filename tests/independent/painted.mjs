// What resvg paints of drawings, as shares of their pages.
//
//   node tests/independent/painted.mjs FOLDER FILE...   FOLDER holds resvg's package
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const pixels = 1600;
const [folder, ...files] = process.argv.slice(2);
const { Resvg } = createRequire(join(folder, 'package.json'))('@resvg/resvg-js');

/** `solid`: pixels in part by their share; `touched`: all on which anything is painted. */
function paintedShare(svg) {
  const fitTo = { mode: 'width', value: pixels };
  const { pixels: rgba, width, height } = new Resvg(svg, { fitTo, font: { loadSystemFonts: false } }).render();
  let solid = 0;
  let touched = 0;
  for (let k = 3; k < rgba.length; k += 4) {
    solid += rgba[k] / 255;
    touched += rgba[k] >= 2 ? 1 : 0;
  }
  return { solid: solid / (width * height), touched: touched / (width * height) };
}

console.log(JSON.stringify(files.map((file) => paintedShare(readFileSync(file, 'utf8')))));
