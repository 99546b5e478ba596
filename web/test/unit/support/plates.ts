// Plates with one of everything.
import type { Stroke } from 'sillon';
import { filledWith } from '../../../src/model/fills.js';
import { layerKinds, newLayer, withLayer } from '../../../src/model/layer-list.js';
import type { LayerKind, LayerValues } from '../../../src/model/layers.js';
import { newPlate } from '../../../src/model/new-plate.js';
import type { Plate, SourceFile } from '../../../src/model/plate.js';

export interface Files {
  drawing: SourceFile;
  photo: SourceFile;
  modes: SourceFile;
  font: SourceFile;
}

/** As the core writes them: with all that a tool has. */
export const strokes: readonly Stroke[] = [
  { tool: 'comb', radius: 4, soft: 0.5, points: [1, 2, 3, 4.5] },
  { tool: 'mode', radius: 2, soft: 0, mode: 'orthogonal', points: [1, 2] },
  { tool: 'erase', radius: 0.5, soft: 1, points: [] },
];

/** Layers of every kind, with files of every sort, above the ground of a new plate. */
export function layered({ drawing, photo, modes, font }: Files): Plate {
  const own: Partial<Record<LayerKind, Partial<LayerValues>>> = {
    map: { file: photo, encoding: 'tangent', modeFile: modes, mode: 'parallel' },
    picture: { pictures: [{ file: photo, lamp: null }], cropMin: [0.1, 0.2] },
    tones: { file: photo, by: 'colours', colours: [{ colour: '#00ff7f', angle: -45 }] },
    drawing: { file: drawing, ground: 20 },
    strokes: { strokes: [...strokes] },
  };
  const pictures = [
    { file: photo, lamp: [10, 40] },
    { file: modes, lamp: [-20, 30.5] },
    { file: photo, lamp: null },
  ] as const;
  const made = layerKinds.map((kind) => newLayer(newPlate(), kind, own[kind]));
  const more = [
    newLayer(newPlate(), 'text', { font, text: 'A\nB', maskFile: drawing, mask: 'inside', at: [3, 4.5] }),
    newLayer(newPlate(), 'picture', { pictures, visible: false }),
    newLayer(newPlate(), 'pattern', { pattern: 'spiral', waveLength: 12, soft: 2 }),
    newLayer(newPlate(), 'pattern', { pattern: 'noise', seed: 7, mode: 'smoothest', mirror: true }),
    newLayer(newPlate(), 'pattern', { pattern: 'echo', text: 'A', font: 'Caveat' }),
    newLayer(newPlate(), 'pattern', { pattern: 'echo', file: drawing }),
    ...(['brightness', 'levels', 'edges'] as const).map((by) =>
      newLayer(newPlate(), 'tones', { file: photo, by, threshold: 0.25, contrast: 2, smoothing: 1.5 }),
    ),
  ];
  return [...made, ...more].reduce(withLayer, filledWith(newPlate(), 'direction', { angle: 12 }));
}

/** Layers that nobody has finished: each lacks something. */
export function unfinished({ drawing }: Pick<Files, 'drawing'>): LayerValues[] {
  return [
    newLayer(newPlate(), 'picture', { size: [20, 0] }),
    newLayer(newPlate(), 'map', { encoding: 'rotation' }),
    newLayer(newPlate(), 'tones', { by: 'edges' }),
    newLayer(newPlate(), 'drawing', { rotation: 30 }),
    newLayer(newPlate(), 'pattern', { pattern: 'echo' }),
    newLayer(newPlate(), 'text', { text: '' }),
    newLayer(newPlate(), 'code', { text: '' }),
    newLayer(newPlate(), 'text', { text: 'A', mask: 'outside' }),
    newLayer(newPlate(), 'text', { text: '', mask: 'inside', maskFile: drawing }),
    newLayer(newPlate(), 'picture', { mask: 'inside' }),
    newLayer(newPlate(), 'code', { text: '', mask: 'outside' }),
  ];
}
