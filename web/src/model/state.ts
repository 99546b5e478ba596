// All state that the page shows, except the cameras, which move too often.
import type { Conflict, GcodeCheck, GcodeSummary, Report, Toolpath } from 'sillon';
import type { Directions } from './raster.js';
import type { ColourBy, Light, ViewName } from './view.js';
import { newPlate } from './new-plate.js';
import type { Plate } from './plate.js';
import type { Problem } from './problem.js';

export type Theme = 'auto' | 'light' | 'dark';
export type Tool = 'pan' | 'comb' | 'mode' | 'erase';

/** Progress of the engine's current job. */
export interface Progress {
  job: 'loading' | 'making' | 'measuring' | 'writing';
  /** Stage as the engine names it; the dictionary has `stage.NAME`. Empty: not begun. */
  stage: string;
  /** Share of the job that is done, 0..1; it never falls within a job. */
  fraction: number;
  /** Estimated time left [s]; undefined while there is nothing to estimate from. */
  secondsLeft: number | undefined;
}

/** A toolpath and the plate that it was made for. */
export interface PlateResult {
  plate: Plate;
  toolpath: Toolpath;
  /** The engine's report, which includes the measures once `measured` is set. */
  report: Report;
  /** Conflict between two or more pictures: how much they take from each other. */
  conflict?: Conflict | undefined;
  /** True for a quick preview, made with a larger spacing or without the corrections of its pictures. */
  coarse: boolean;
  measured: boolean;
}

/** Directions of a plate, shown before and beside its beads. */
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
  /** Code of a language in i18n/languages.ts. */
  language: string;
  /** Name of the open section of settings; empty: none. */
  panel: string;
  advanced: boolean;
  tool: Tool;

  // The following fields are computed from the plate.
  directions?: PlateDirections | undefined;
  result?: PlateResult | undefined;
  summary?: GcodeSummary | undefined;
  /** Check of the same file, read back as a printer would. */
  check?: GcodeCheck | undefined;
  progress?: Progress | undefined;
  problem?: Problem | undefined;
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
});
