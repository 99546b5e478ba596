// A small plate for every kind of layer, as the project files that the command line and the package read.
import { copyFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { root } from './projects.js';

/** Their paths in the repository, by the names that layers give them. */
const files = {
  'angles.png': 'examples/inputs/noise.png',
  'modes.png': 'examples/inputs/logo_mode.png',
  'star.png': 'examples/inputs/star.png',
  'heart.png': 'examples/inputs/heart.png',
  'photo.png': 'examples/inputs/photo.png',
  'photo.jpg': 'tests/fuzz/seeds/picture/progressive.jpg',
  'islands.svg': 'examples/inputs/islands.svg',
  'font.ttf': 'core/data/fonts/fredoka.ttf',
};

/** A drawing in flat colours with letters; no other file of the repository has both. */
const flag = `<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="20mm" viewBox="0 0 30 20">
  <rect width="30" height="20" fill="#c02020"/><circle cx="10" cy="10" r="7" fill="#f0d020"/>
  <text x="19" y="14" font-family="Roboto Slab" font-size="11" fill="#2040c0">S</text></svg>`;

/** Layers that fill a plate: each is the lowest of one, and a patch over a direction on another. */
const filling = {
  direction: { kind: 'direction', angle: 70 },
  'direction with modes': { kind: 'direction', angle: -35, modeFile: 'modes.png' },
  'map of angles': { kind: 'map', file: 'angles.png' },
  'map of rotations': { kind: 'map', file: 'angles.png', encoding: 'rotation', cropMin: [0.3, 0], cropMax: [0.7, 1] },
  'map of tangents': { kind: 'map', file: 'photo.png', encoding: 'tangent' },
  'one picture': { kind: 'picture', pictures: [{ file: 'star.png', lamp: [60, 45] }] },
  'two pictures': {
    kind: 'picture',
    pictures: [
      { file: 'star.png', lamp: null },
      { file: 'heart.png', lamp: null },
    ],
  },
  'radial pattern': { kind: 'pattern', angle: 30 },
  'spiral pattern': { kind: 'pattern', pattern: 'spiral', waveLength: 12 },
  'waves pattern': { kind: 'pattern', pattern: 'waves', amplitude: 35, waveLength: 14 },
  'noise pattern': { kind: 'pattern', pattern: 'noise', amplitude: 60, waveLength: 9, seed: 7 },
  'echo pattern': { kind: 'pattern', pattern: 'echo', file: 'islands.svg', mask: 'page', angle: 10 },
  'echo pattern of letters': { kind: 'pattern', pattern: 'echo', text: 'Sil\nlon', align: 'left', mask: 'page' },
  'tones by brightness': { kind: 'tones', file: 'photo.png', contrast: 1.5, smoothing: 0.5 },
  'tones by levels': { kind: 'tones', by: 'levels', file: 'photo.jpg', from: 15, to: 80, threshold: 0.4 },
  'tones by edges': { kind: 'tones', by: 'edges', file: 'photo.png', smoothing: 1, angle: 20 },
  'tones by colours': {
    kind: 'tones',
    by: 'colours',
    file: 'flag.svg',
    colours: [
      { colour: '#c02020', angle: 30 },
      { colour: '#f0d020', angle: -50 },
      { colour: '#2040c0', angle: 85 },
    ],
  },
};
const patch = { size: [20, 18], at: [14, 16], rotation: 15, mirror: true, soft: 1.5 };

/** Layers that show what they are on others alone. */
const lying = {
  text: { kind: 'text', text: 'Anna\nΑ–Ω', font: 'Roboto Slab', textSize: 6, align: 'right' },
  'text from right to left': { kind: 'text', text: 'הרצל 12', font: 'font.ttf', textSize: 5, fill: 'along' },
  'text on a circle': {
    kind: 'text',
    text: 'AROUND',
    font: 'Caveat',
    textSize: 5,
    circle: -11,
    fill: 'angle',
    angle: 65,
    ground: -10,
  },
  code: { kind: 'code', text: 'SILLON', size: [26, 26], rotation: 10, angle: 45 },
  'code of low correction': { kind: 'code', text: 'https://sillon.example/ä', size: [28, 28], correction: 'low' },
  'code of quartile correction': { kind: 'code', text: '0123456789', size: [28, 28], correction: 'quartile' },
  'code of high correction': { kind: 'code', text: 'SILLON', size: [28, 28], correction: 'high', ground: 0 },
  drawing: { kind: 'drawing', file: 'islands.svg', size: [26, 0], mode: 'orthogonal' },
  'drawing with letters': { kind: 'drawing', file: 'flag.svg', size: [24, 0], fill: 'along', soft: 0.6 },
  'drawing in a disc': { kind: 'drawing', file: 'star.png', size: [22, 22], mask: 'disc', fill: 'angle', angle: 80 },
  'direction inside of a mask': {
    kind: 'direction',
    mode: 'smoothest',
    ...patch,
    mask: 'inside',
    maskFile: 'flag.svg',
  },
  'direction outside of a mask': {
    kind: 'direction',
    mode: 'parallel',
    ...patch,
    mask: 'outside',
    maskFile: 'heart.png',
  },
  border: { kind: 'border', width: 4, fill: 'along', soft: 1 },
  'border at an angle': { kind: 'border', width: 5, fill: 'angle', angle: 100 },
  strokes: {
    kind: 'strokes',
    strokes: [
      { tool: 'comb', radius: 5, soft: 0.3, points: [4, 5, 12, 9, 20, 24] },
      { tool: 'mode', mode: 'smoothest', radius: 4, soft: 0.5, points: [22, 6, 26, 12] },
      { tool: 'erase', radius: 2.5, soft: 0.5, points: [12, 9] },
    ],
  },
};

const plate = (...layers) => ({
  sillon: 1,
  shape: { builtin: 'rounded', size: [30, 30] },
  layers,
  pictures: { corrections: 0 },
  toolpath: { spacing: 0.8 },
});
const ground = { kind: 'direction', angle: 20 };
const named = (layers, suffix, make) =>
  Object.entries(layers).map(([name, layer]) => [`${name}${suffix}`, make(layer)]);

/** Projects by their names. The first shows what a layer that draws nothing would leave. */
export const plates = Object.fromEntries([
  ['ground', plate(ground)],
  ...named(filling, '', (layer) => plate(layer)),
  ...named(filling, ', a patch', (layer) => plate(ground, { ...layer, ...patch })),
  ...named(lying, '', (layer) => plate(ground, layer)),
]);

/** Writes the projects into a folder, as NAME.json, beside the files that they name. */
export function writePlates(folder) {
  for (const [name, path] of Object.entries(files)) copyFileSync(join(root, path), join(folder, name));
  writeFileSync(join(folder, 'flag.svg'), flag);
  for (const [name, project] of Object.entries(plates)) {
    writeFileSync(join(folder, `${name}.json`), JSON.stringify(project));
  }
}
