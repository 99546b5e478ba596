// Plates to begin with: generators as data, and pictures of our own that lie beside the page.
import { newGenerator, newShape } from '../model/defaults.js';
import type { Example } from '../model/example.js';

/** Two pictures in one plate, on a spool with contrast: what the studio opens with, too. */
export const opening: Example = {
  id: 'sunMoon',
  width: 80,
  height: 80,
  filament: 'bluePla',
  shape: newShape('disc'),
  directions: {
    pictures: [
      { file: 'sun.png', lamp: [70, 45] },
      { file: 'moon.png', lamp: [110, 45] },
    ],
  },
};

/** Also a first print: nothing can go wrong with it that the coupon does not show. */
export const coaster: Example = {
  id: 'whirl',
  width: 80,
  height: 80,
  filament: 'bluePla',
  shape: newShape('disc'),
  directions: { ...newGenerator('spiral'), turns: 2, angle: 25 },
};

export const examples: readonly Example[] = [
  opening,
  {
    id: 'ripples',
    width: 70,
    height: 70,
    filament: 'goldPla',
    shape: newShape('disc'),
    directions: newGenerator('waves'),
  },
  coaster,
  {
    id: 'rays',
    width: 80,
    height: 80,
    filament: 'redPetg',
    shape: newShape('rounded'),
    directions: { ...newGenerator('radial'), centre: [0.5, 0.16] },
  },
  {
    id: 'rings',
    width: 60,
    height: 60,
    filament: 'greyPla',
    shape: newShape('disc'),
    directions: { ...newGenerator('radial'), angle: 90 },
  },
  {
    id: 'silk',
    width: 90,
    height: 60,
    filament: 'clearPetg',
    shape: newShape('rounded'),
    directions: { ...newGenerator('noise'), seed: 4, scale: 0.32, amplitude: 120 },
  },
  {
    id: 'grain',
    width: 100,
    height: 40,
    filament: 'goldPla',
    shape: newShape('rectangle'),
    directions: { ...newGenerator('noise'), seed: 9, scale: 0.16, amplitude: 40 },
  },
  {
    id: 'portrait',
    width: 120,
    height: 80,
    filament: 'bluePla',
    shape: newShape('rounded'),
    directions: { file: 'photo.png', encoding: 'rotation' },
  },
  {
    id: 'relief',
    width: 84,
    height: 84,
    filament: 'greyPla',
    shape: newShape('rounded'),
    directions: { file: 'relief.png', encoding: 'rotation' },
  },
  {
    id: 'mosaic',
    width: 90,
    height: 90,
    filament: 'goldPla',
    shape: newShape('disc'),
    directions: { file: 'mosaic.png', encoding: 'angle' },
    nearest: true,
  },
  {
    id: 'tiles',
    width: 96,
    height: 96,
    filament: 'redPetg',
    shape: newShape('rectangle'),
    directions: { file: 'tiles.png', encoding: 'angle' },
    nearest: true,
  },
  {
    id: 'crest',
    width: 100,
    height: 100,
    filament: 'goldPla',
    shape: 'logo.svg',
    directions: { file: 'logo_angle.png', encoding: 'angle' },
    modes: { file: 'logo_mode.png' },
  },
  {
    id: 'brushwork',
    width: 120,
    height: 72,
    filament: 'bluePla',
    shape: 'strokes.svg',
    directions: { file: 'strokes_angle.png', encoding: 'angle' },
    modes: { file: 'strokes_mode.png' },
  },
];
