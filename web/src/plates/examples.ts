// Example plates: layers as data, with pictures of our own that are served beside the page.
import { newShape } from '../model/defaults.js';
import type { Example } from '../model/example.js';

/** Two pictures in one plate, on a spool with good contrast. The studio opens with it. */
export const opening: Example = {
  id: 'sunMoon',
  width: 80,
  height: 80,
  filament: 'bluePla',
  shape: newShape('disc'),
  layers: [
    {
      kind: 'picture',
      pictures: [
        { file: 'sun.png', lamp: [70, 45] },
        { file: 'moon.png', lamp: [110, 45] },
      ],
    },
  ],
};

/** A plate that also suits a first print: all that can go wrong with it shows on the coupon as well. */
export const coaster: Example = {
  id: 'whirl',
  width: 80,
  height: 80,
  filament: 'bluePla',
  shape: newShape('disc'),
  layers: [{ kind: 'pattern', pattern: 'spiral', waveLength: 40, angle: 25 }],
};

export const examples: readonly Example[] = [
  opening,
  {
    id: 'ripples',
    width: 70,
    height: 70,
    filament: 'goldPla',
    shape: newShape('disc'),
    layers: [{ kind: 'pattern', pattern: 'waves', amplitude: 40, waveLength: 24.5 }],
  },
  coaster,
  {
    id: 'rays',
    width: 80,
    height: 80,
    filament: 'redPetg',
    shape: newShape('rounded'),
    layers: [{ kind: 'pattern', at: [40, 12.8], mask: 'page' }],
  },
  {
    id: 'rings',
    width: 60,
    height: 60,
    filament: 'greyPla',
    shape: newShape('disc'),
    layers: [{ kind: 'pattern', angle: 90 }],
  },
  {
    id: 'silk',
    width: 90,
    height: 60,
    filament: 'clearPetg',
    shape: newShape('rounded'),
    layers: [{ kind: 'pattern', pattern: 'noise', seed: 4, waveLength: 24, amplitude: 90, angle: 110 }],
  },
  {
    id: 'grain',
    width: 100,
    height: 40,
    filament: 'goldPla',
    shape: newShape('rectangle'),
    layers: [{ kind: 'pattern', pattern: 'noise', seed: 9, waveLength: 16, amplitude: 40 }],
  },
  {
    id: 'portrait',
    width: 120,
    height: 80,
    filament: 'bluePla',
    shape: newShape('rounded'),
    layers: [{ kind: 'map', file: 'photo.png', encoding: 'rotation' }],
  },
  {
    id: 'relief',
    width: 84,
    height: 84,
    filament: 'greyPla',
    shape: newShape('rounded'),
    layers: [{ kind: 'map', file: 'relief.png', encoding: 'rotation' }],
  },
  {
    id: 'mosaic',
    width: 90,
    height: 90,
    filament: 'goldPla',
    shape: newShape('disc'),
    layers: [{ kind: 'map', file: 'mosaic.png' }],
    nearest: true,
  },
  {
    id: 'tiles',
    width: 96,
    height: 96,
    filament: 'redPetg',
    shape: newShape('rectangle'),
    layers: [{ kind: 'map', file: 'tiles.png' }],
    nearest: true,
  },
  {
    id: 'crest',
    width: 100,
    height: 100,
    filament: 'goldPla',
    shape: 'logo.svg',
    layers: [{ kind: 'map', file: 'logo_angle.png', modeFile: 'logo_mode.png' }],
  },
  {
    id: 'brushwork',
    width: 120,
    height: 72,
    filament: 'bluePla',
    shape: 'strokes.svg',
    layers: [{ kind: 'map', file: 'strokes_angle.png', modeFile: 'strokes_mode.png' }],
  },
];
