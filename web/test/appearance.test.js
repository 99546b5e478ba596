// The light of the views' shader against the core's, for every spool and lamp on a grid of directions. The shader's text is
// run as JavaScript: its scalars are written alike in both.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

const read = (path) => readFileSync(new URL(path, import.meta.url), 'utf8');
const made = read('../src/model/appearance.ts');
const constant = (name) => Number(new RegExp(`${name}: ([\\d.]+)`).exec(made)[1]);
const shaders = read('../src/views/shaders.ts');

/** float highlightOf(...) of the shader, as a function. */
function highlightOf() {
  const glsl = /export const highlightOfBead = `([^`]*)`/.exec(shaders)[1];
  const script = glsl
    .replaceAll(/\$\{appearance\.(\w+)\.toFixed\(4\)\}/g, (_, name) => constant(name).toFixed(4))
    .replace('float highlightOf(', 'function highlightOf(')
    .replaceAll(/(?<=[(,] ?)float (?=\w+[,)])/g, '')
    .replaceAll(/\b(?:float|int) (?=\w+ =)/g, 'let ')
    .replaceAll('float(k)', 'k')
    .replaceAll('exp(', 'Math.exp(');
  return new Function(`${script}; return highlightOf;`)();
}

const radians = (degrees) => (degrees * Math.PI) / 180;

test('the shader sends the light that the core sends, for every spool, lamp and direction', () => {
  const highlight = highlightOf();
  const diffuse = constant('diffuse');
  const tilt = Math.cos(radians(45)) / (1 + Math.sin(radians(45)));
  let compared = 0;
  for (const [key, { slopes, light }] of Object.entries(JSON.parse(read('light.json')))) {
    for (const [lamp, table] of Object.entries(light)) {
      const variance = slopes.map((slope) => Math.tan(radians(slope)) ** 2 + constant(lamp) ** 2);
      const at = (angle) => highlight(tilt * Math.cos(angle), tilt * Math.sin(angle), ...variance, 0, 1);
      const brightest = Math.max(at(0), at(Math.PI / 2));
      for (const [step, expected] of table.entries()) {
        const angle = radians(60 - (180 * step) / table.length); // from the bead to the lamp
        const seen = diffuse + (1 - diffuse) * Math.min(1, at(angle) / brightest);
        assert.ok(Math.abs(seen - expected) < 2e-3, `${key}, ${lamp}, direction ${step}: ${seen}, not ${expected}`);
        compared += 1;
      }
    }
  }
  assert.equal(compared, 5 * 3 * 36);
});

test('what is seen of one place of a bead is the light of its slope there', () => {
  const highlight = highlightOf();
  const slope = constant('profileSlope') * 0.5;
  assert.equal(highlight(0, slope, 0.01, 0.1, 0.5, 0), 1);
  assert.ok(highlight(0, slope, 0.01, 0.1, -0.5, 0) < 0.9);
});
