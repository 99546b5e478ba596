// Converts lengths to the visitor's units.
import type { Units } from '../model/guest.js';

export const inch = 25.4; // [mm]

export const inUnits = (length: number, units: Units): number => (units === 'in' ? length / inch : length);
