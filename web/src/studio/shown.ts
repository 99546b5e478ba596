// State of the panels alone, in addition to the state that other parts share.
import type { EngineInfo, DirectionMode } from 'sillon';
import { newState, type State } from '../model/state.js';
import { sections, type Control, type Mode, type Units } from '../model/guest.js';
import type { Failure, Problem } from '../model/problem.js';
import type { OpenedFiles } from '../model/file-role.js';
import type { KnownBox } from '../model/layer-frame.js';
import type { OwnPrint } from '../model/own-print.js';
import type { OwnSpool, Plate } from '../model/plate.js';
import type { Light, Mark, Shimmer } from '../model/view.js';

/** Layer over the plate, from its left edge up to a line. */
export type Over = 'picture' | 'zigzag' | 'conflict';
/** 'life': at the size of the print; 'arm': as seen at arm's length, where beads blend into each other. */
export type Sizing = 'whole' | 'life' | 'arm' | 'free';
export type LightMode = 'pointer' | 'tilt' | 'orbit' | 'fixed';
/** 'brought': settings that a design brings for the printer; 'blocks': the same for the file about to be downloaded;
 * 'rebrush': a sliced print, over the whole page; 'zones': a body, with a list of its faces; 'spools': the sheet of
 * 'calibrate', at the visitor's own spools; 'printer': printer, filament, thickness; 'firstFile': the same before
 * the first file; 'card': the place of the lamp, to be printed. */
export type Dialog =
  | 'gallery'
  | 'palette'
  | 'plates'
  | 'help'
  | 'files'
  | 'share'
  | 'brought'
  | 'blocks'
  | 'rebrush'
  | 'zones'
  | 'calibrate'
  | 'spools'
  | 'first'
  | 'printer'
  | 'firstFile'
  | 'card';

export interface Brush {
  /** Share of the page's width. */
  radius: number;
  softness: number;
  mode: DirectionMode;
}

export interface Reading {
  name: string;
  /** Share that is read, 0..1. */
  fraction: number;
  cancel: () => void;
}

export interface NoticeAction {
  label: string;
  run: () => void;
}

/** A message that disappears by itself, unless it is a problem or stays. */
export interface Notice {
  id: number;
  text: string;
  problem?: Problem;
  actions?: readonly NoticeAction[];
  /** About the files that were opened last: it disappears with them. */
  ofFiles?: boolean;
  /** Stays until it is answered or closed, because nothing else offers its action. */
  stays?: boolean;
}

export interface Shown extends State {
  mode: Mode;
  /** Controls that a visitor has in mode 'customize'. */
  controls: readonly Control[];
  units: Units;
  /** Origin of the page that shows this one in a frame and may command it; empty: none. */
  host: string;
  /** Reason why the plate named by the surrounding page or the address cannot be shown. */
  lacking?: Failure | undefined;
  brush: Brush;
  /** Share of the print that is shown, 0..1. */
  played: number;
  playing: boolean;
  lightMode: LightMode;
  /** Index of the picture whose lamp shines. */
  lamp: number;
  /** Light that a pointer left over pictures under lamps; undefined: the light belongs at the picture's lamp. */
  aimed?: Light | undefined;
  /** The lamp moves from one picture to the next until it is stopped. */
  flipping: boolean;
  over?: Over | undefined;
  /** Share of the plate that `over` covers, 0..1. */
  wipe: number;
  sizing: Sizing;
  marks: readonly Mark[];
  /** Lamp azimuths under which the code of that plate can be read [degrees], 0 to 180. */
  scan?: { plate: Plate; azimuths: readonly number[] } | undefined;
  /** Index of the mark in focus; -1: none. */
  mark: number;
  /** Proportions that `width` and `height` keep while one of them changes. */
  keepRatio: boolean;
  /** Id of the layer in work; undefined: none. */
  layer?: number | undefined;
  /** The cropped-away part of its picture is shown, to crop it differently. */
  cropping: boolean;
  /** Boxes of the layers by id, as the engine placed them; the
   * box of a layer that has changed since may be out of date. */
  layerBoxes: ReadonlyMap<number, KnownBox>;
  /** A drag that changes the plate is going on. */
  live: boolean;
  dialog?: Dialog | undefined;
  /** Files that were opened last, as long as their roles can be changed. */
  opened?: OpenedFiles | undefined;
  /** Print of the dialog 'rebrush', or body of the dialog 'zones'. */
  sliced?: File | undefined;
  /** Spools of the visitor; undefined: not read yet. */
  spools?: readonly OwnSpool[] | undefined;
  /** Printer, filament and thickness that the visitor has named; undefined: none. */
  own?: OwnPrint | undefined;
  dropping: boolean;
  /** File that is being read. */
  reading?: Reading | undefined;
  recording: boolean;
  notices: readonly Notice[];
  /** Light that stands in for the beads of the first plate. */
  shimmer?: Shimmer | undefined;
  /** A first visit, before the visitor has done anything: controls for later steps are hidden. */
  welcome: boolean;
  /** A pointer is on the lamp, which must not move away from it. */
  lampHeld: boolean;
  engine?: EngineInfo | undefined;
  /** The engine was told to stop, and nothing has changed since. */
  cancelled: boolean;
}

/** Tells whether a visitor has this part: all of them for editing, those that the host names for customizing. */
export const offers = ({ mode, controls }: Readonly<Shown>, control: Control): boolean =>
  mode === 'edit' || (mode === 'customize' && controls.includes(control));

/** Tells whether layers are in use, so that new files and texts become layers. */
export const composes = (state: Readonly<Shown>): boolean => offers(state, 'layers') && state.plate.layers.length > 1;

/** Returns the settings and parts that a host names one by one. */
export const ownControls = ({ mode, controls }: Readonly<Shown>): Control[] =>
  mode === 'customize'
    ? controls.filter((control) => control !== 'download' && !(sections as readonly Control[]).includes(control))
    : [];

export const newShown = (): Shown => ({
  ...newState(),
  mode: 'edit',
  controls: [],
  units: 'mm',
  host: '',
  brush: { radius: 0.08, softness: 0.5, mode: 'parallel' },
  played: 1,
  playing: false,
  lightMode: 'pointer',
  lamp: 0,
  flipping: false,
  wipe: 0.5,
  sizing: 'whole',
  marks: [],
  mark: -1,
  keepRatio: true,
  cropping: false,
  layerBoxes: new Map(),
  live: false,
  dropping: false,
  recording: false,
  notices: [],
  welcome: false,
  lampHeld: false,
  cancelled: false,
});
