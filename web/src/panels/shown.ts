// What only the panels know, beside the state that others share.
import type { EngineInfo, DirectionMode } from 'sillon';
import { newState, type State } from '../model/state.js';
import { sections, type Control, type Mode, type Units } from '../model/guest.js';
import type { Problem } from '../model/problem.js';
import type { SourceFile } from '../model/plate.js';
import type { Mark } from '../views/scene.js';

export type LightMode = 'pointer' | 'tilt' | 'orbit' | 'fixed';
export type Dialog = 'gallery' | 'help' | 'files' | 'share';

/** What a file may be for; the dictionary has `role.NAME`. */
export type Role =
  'shape' | 'mask' | 'tone' | 'edges' | 'levels' | 'angle' | 'rotation' | 'tangent' | 'modes' | 'project' | 'none';

/** A file as it was opened, and what it is used as. */
export interface Opened {
  source: SourceFile;
  role: Role;
  /** What it may be used as. */
  roles: readonly Role[];
}

export interface Brush {
  /** Share of the page's width. */
  radius: number;
  softness: number;
  mode: DirectionMode;
}

/** Something to tell, that goes away by itself unless it is a problem. */
export interface Notice {
  id: number;
  text: string;
  problem?: Problem;
  action?: { label: string; run: () => void };
}

export interface Shown extends State {
  mode: Mode;
  /** Of mode 'customize'. */
  controls: readonly Control[];
  units: Units;
  /** Origin of the page that shows this one in a frame and may command it; empty: none. */
  host: string;
  brush: Brush;
  /** 0..1: how much of the print is shown. */
  played: number;
  playing: boolean;
  lightMode: LightMode;
  marks: readonly Mark[];
  /** Index of the mark that is looked at; -1: none. */
  mark: number;
  /** The proportions that `width` and `height` keep while one of them changes. */
  keepRatio: boolean;
  /** A drag that changes the plate is going on. */
  live: boolean;
  dialog: Dialog | undefined;
  /** The files that were opened last, for as long as what they are for can be changed. */
  opened: readonly Opened[];
  dropping: boolean;
  recording: boolean;
  notices: readonly Notice[];
  engine: EngineInfo | undefined;
  /** The engine was told to stop, and nothing has changed since. */
  cancelled: boolean;
}

/** Whether a visitor may have this part: all of it is there for editing, and what a host names for customizing. */
export const offers = ({ mode, controls }: Readonly<Shown>, control: Control): boolean =>
  mode === 'edit' || (mode === 'customize' && controls.includes(control));

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
  brush: { radius: 0.08, softness: 0.5, mode: 'parallel' },
  played: 1,
  playing: false,
  lightMode: 'pointer',
  marks: [],
  mark: -1,
  keepRatio: true,
  live: false,
  dialog: undefined,
  opened: [],
  dropping: false,
  recording: false,
  notices: [],
  engine: undefined,
  cancelled: false,
});
