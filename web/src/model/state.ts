// All that the page shows, but for the cameras, which move too often.
import type { Conflict, GcodeCheck, GcodeSummary, Report, Toolpath } from 'sillon';
import type { Directions } from './raster.js';
import type { ColourBy, Light, ViewName } from './view.js';
import { newPlate } from './new-plate.js';
import type { Plate } from './plate.js';
import type { Problem } from './problem.js';

export type Theme = 'auto' | 'light' | 'dark';
export type Tool = 'pan' | 'comb' | 'mode' | 'erase';

/** What the engine does now. */
export interface Progress {
  job: 'loading' | 'making' | 'measuring' | 'writing';
  /** As the engine names it; the dictionary has `stage.NAME`. Empty: not begun. */
  stage: string;
  /** 0..1, never falling within a job. */
  fraction: number;
  /** Estimate; undefined while there is nothing to estimate from. */
  secondsLeft: number | undefined;
}

/** A toolpath and the plate that it was made for. */
export interface PlateResult {
  plate: Plate;
  toolpath: Toolpath;
  /** With measures, once those are there. */
  report: Report;
  /** Of two pictures and more: what they take from each other. */
  conflict?: Conflict | undefined;
  /** A quick preview: made with a larger spacing, or without the corrections of its pictures. */
  coarse: boolean;
  measured: boolean;
}

/** The directions of a plate, before and beside its beads. */
export interface PlateDirections extends Directions {
  plate: Plate;
}

export interface State {
  plate: Plate;
  view: ViewName;
  colourBy: ColourBy;
  compare: boolean;
  light: Light;
  theme: Theme;
  /** One of those in i18n/languages.ts. */
  language: string;
  /** Which section of settings is open; empty: none. */
  panel: string;
  advanced: boolean;
  tool: Tool;

  // What follows from the plate.
  directions: PlateDirections | undefined;
  result: PlateResult | undefined;
  summary: GcodeSummary | undefined;
  /** Of the same file, read back as a printer would. */
  check: GcodeCheck | undefined;
  progress: Progress | undefined;
  problem: Problem | undefined;
}

export const newState = (): State => ({
  plate: newPlate(),
  view: 'appearance',
  colourBy: 'direction',
  compare: false,
  light: { azimuth: 60, elevation: 35 },
  theme: 'auto',
  language: 'en',
  panel: '',
  advanced: false,
  tool: 'pan',
  directions: undefined,
  result: undefined,
  summary: undefined,
  check: undefined,
  progress: undefined,
  problem: undefined,
});
