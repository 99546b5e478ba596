// The plate that a first visit shows.
import { pictureDefaults, newShape, printDefaults, printerDefaults, toolpathDefaults } from './defaults.js';
import { newFill } from './fills.js';
import type { Plate } from './plate.js';

const page = { shape: newShape('disc'), width: 70, height: 70 };

export const newPlate = (): Plate => ({
  name: '',
  ...page,
  layers: [{ ...newFill(page, 'waves'), id: 1 }],
  pictures: { ...pictureDefaults, spool: 'goldPla' },
  toolpath: { ...toolpathDefaults },
  print: structuredClone(printDefaults),
  printer: structuredClone(printerDefaults),
});
