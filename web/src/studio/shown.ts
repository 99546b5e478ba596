// What only the panels know, beside the state that others share.
import type { EngineInfo, DirectionMode } from 'sillon';
import { newState, type State } from '../model/state.js';
import { sections, type Control, type Mode, type Units } from '../model/guest.js';
import type { Failure, Problem } from '../model/problem.js';
import type { OpenedFiles } from '../model/file-role.js';
import type { KnownBox } from '../model/layer-frame.js';
import type { OwnPrint } from '../model/own-print.js';
import type { OwnSpool, Plate } from '../model/plate.js';
import type { Light, Mark, Shimmer } from '../model/view.js';

/** What lies over the plate, from the left up to a line. */
export type Over = 'picture' | 'zigzag' | 'conflict';
/** 'life': as large as it will be; 'arm': as an eye at arm's length sees it, which tells no beads apart. */
export type Sizing = 'whole' | 'life' | 'arm' | 'free';
export type LightMode = 'pointer' | 'tilt' | 'orbit' | 'fixed';
/** 'brought': what a design brings for the printer; 'blocks': the same of what is about to be downloaded; 'rebrush': a sliced
 * print, all over the page; 'zones': a body, whose faces are listed; 'spools': that of 'calibrate', at the visitor's own spools;
 * 'printer': printer, filament, thickness; 'firstFile': the same before the first file; 'card': where the lamp must stand, to be
 * printed. */
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
  /** 0..1 */
  fraction: number;
  cancel: () => void;
}

export interface NoticeAction {
  label: string;
  run: () => void;
}

/** Something to tell, that goes away by itself unless it is a problem or stays. */
export interface Notice {
  id: number;
  text: string;
  problem?: Problem;
  actions?: readonly NoticeAction[];
  /** Of the files that were opened last: goes with them. */
  ofFiles?: boolean;
  /** Until it is answered or closed: what it offers is offered nowhere else. */
  stays?: boolean;
}

export interface Shown extends State {
  mode: Mode;
  /** Of mode 'customize'. */
  controls: readonly Control[];
  units: Units;
  /** Origin of the page that shows this one in a frame and may command it; empty: none. */
  host: string;
  /** The reason for which the plate that the page around this one, or the address, names cannot be shown. */
  lacking: Failure | undefined;
  brush: Brush;
  /** 0..1: how much of the print is shown. */
  played: number;
  playing: boolean;
  lightMode: LightMode;
  /** Of pictures under lamps: whose lamp shines. */
  lamp: number;
  /** The light as a pointer has left it over pictures under lamps; undefined: it belongs where the picture's lamp stands. */
  aimed: Light | undefined;
  /** The lamp turns from one picture to the next, and on. */
  flipping: boolean;
  over: Over | undefined;
  /** 0..1: how much of the plate lies under that. */
  wipe: number;
  sizing: Sizing;
  marks: readonly Mark[];
  /** Lamps under which the code of that plate is read [degrees], 0 to 180. */
  scan: { plate: Plate; azimuths: readonly number[] } | undefined;
  /** Index of the mark that is looked at; -1: none. */
  mark: number;
  /** The proportions that `width` and `height` keep while one of them changes. */
  keepRatio: boolean;
  /** Id of the layer that is worked on; undefined: none. */
  layer: number | undefined;
  /** The cut part of its picture is shown, to be cut elsewhere. */
  cropping: boolean;
  /** As the engine has placed the layers, by their ids; where one has changed since, its box may be another. */
  layerBoxes: ReadonlyMap<number, KnownBox>;
  /** A drag that changes the plate is going on. */
  live: boolean;
  dialog: Dialog | undefined;
  /** The files that were opened last, for as long as what they are for can be changed. */
  opened: OpenedFiles | undefined;
  /** The print that dialog 'rebrush' is about, or the body of dialog 'zones'. */
  sliced: File | undefined;
  /** The visitor's own; undefined: not looked for yet. */
  spools: readonly OwnSpool[] | undefined;
  /** The printer, filament and thickness that the visitor has named; undefined: none. */
  own: OwnPrint | undefined;
  dropping: boolean;
  /** Files that are being read. */
  reading: Reading | undefined;
  recording: boolean;
  notices: readonly Notice[];
  /** Stands in for the beads of the first plate. */
  shimmer: Shimmer | undefined;
  /** A first visit, before anything was done: what comes later would only be in the way. */
  welcome: boolean;
  /** A pointer is on the lamp, which must not move away from it. */
  lampHeld: boolean;
  engine: EngineInfo | undefined;
  /** The engine was told to stop, and nothing has changed since. */
  cancelled: boolean;
}

/** Whether a visitor may have this part: all of it is there for editing, and what a host names for customizing. */
export const offers = ({ mode, controls }: Readonly<Shown>, control: Control): boolean =>
  mode === 'edit' || (mode === 'customize' && controls.includes(control));

/** Layers are in use: files and texts that come in are more of them. */
export const composes = (state: Readonly<Shown>): boolean => offers(state, 'layers') && state.plate.layers.length > 1;

/** Settings and parts that a host names one by one. */
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
  lacking: undefined,
  brush: { radius: 0.08, softness: 0.5, mode: 'parallel' },
  played: 1,
  playing: false,
  lightMode: 'pointer',
  lamp: 0,
  aimed: undefined,
  flipping: false,
  over: undefined,
  wipe: 0.5,
  sizing: 'whole',
  marks: [],
  scan: undefined,
  mark: -1,
  keepRatio: true,
  layer: undefined,
  cropping: false,
  layerBoxes: new Map(),
  live: false,
  dialog: undefined,
  opened: undefined,
  sliced: undefined,
  spools: undefined,
  own: undefined,
  dropping: false,
  reading: undefined,
  recording: false,
  notices: [],
  shimmer: undefined,
  welcome: false,
  lampHeld: false,
  engine: undefined,
  cancelled: false,
});
