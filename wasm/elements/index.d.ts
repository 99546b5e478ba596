// Types of <sillon-studio> and <sillon-view>, the elements for other people's pages; docs/guide/embedding.md describes
// each name. The elements themselves are scripts on the server of the studio.
import type { GcodeFinding, GcodeSummary, Project, Report } from '../sillon.js';

/** Attributes, and properties with the same names: '' if one is not set. */
export interface StudioAttributes {
  src: string;
  shape: string;
  image: string;
  project: string;
  printer: string;
  /** 'printer': projects bring their own printer, start and end G-code; by default they are offered to the visitor. */
  trusted: string;
  mode: string;
  controls: string;
  lang: string;
  theme: string;
  units: string;
  /** Colour of the brand: #rgb or #rrggbb. */
  accent: string;
  /** Radius of corners [px], 0 to 20. */
  radius: string;
  /** Up to four names of fonts that visitors have. */
  font: string;
  threads: string;
  autosave: string;
  base: string;
  sandbox: string;
  /** Address of a picture that is shown until the studio is there, and in place of a plate that cannot be shown. */
  poster: string;
}

export interface StudioFile {
  name: string;
  blob: Blob;
}

/** G-code, its summary, and the findings of `sillon check` in it. */
export interface GcodeFile extends StudioFile {
  summary: GcodeSummary;
  findings: GcodeFinding[];
}

/** Rejection of a studio's promises, except for the AbortError of `signal`. */
export interface StudioFrameError extends Error {
  readonly code: string;
  readonly hint: string;
}

/** Files, their addresses, or a project as plain data. */
export type StudioSource = Blob | string | URL | readonly (Blob | string | URL | object)[] | object;

/** Engine in the frame; `why` tells the reason if it has only one thread. */
export interface StudioInfo {
  threads: number;
  why: string;
  version: string;
}

/** A plate's report, and the material and time of its print if its G-code could be written. */
export interface StudioReport extends Report {
  grams?: number;
  minutes?: number;
}

export interface StudioMethods {
  info(): Promise<StudioInfo>;
  load(source: StudioSource): Promise<void>;
  getProject(): Promise<Project>;
  generate(options?: { signal?: AbortSignal }): Promise<StudioReport>;
  report(): Promise<StudioReport | null>;
  exportGcode(options?: { signal?: AbortSignal }): Promise<GcodeFile>;
  exportBody(options?: { signal?: AbortSignal }): Promise<StudioFile>;
  exportSvg(options?: { signal?: AbortSignal }): Promise<StudioFile>;
  exportProject(options?: { signal?: AbortSignal }): Promise<StudioFile>;
  exportView(options?: { signal?: AbortSignal }): Promise<StudioFile>;
  /** @param options  `width` of an image [pixels]; in a loop the light moves */
  capture(options?: { type?: 'image' | 'loop'; width?: number; signal?: AbortSignal }): Promise<StudioFile>;
}

/** Events by name. */
export interface StudioEventMap {
  ready: CustomEvent<StudioInfo>;
  progress: CustomEvent<{ stage: string; fraction: number; etaMs: number | null }>;
  result: CustomEvent<{ report: Report }>;
  /** Width and height in mm. */
  change: CustomEvent<{ name: string; width: number; height: number }>;
  /** The file becomes a download unless a listener calls `preventDefault()`. */
  export: CustomEvent<{ name: string; type: string; blob: Blob }>;
  error: CustomEvent<{ code: string; message: string; hint: string }>;
}

export interface ViewAttributes {
  src: string;
  poster: string;
  alt: string;
  light: string;
  azimuth: string;
  elevation: string;
  colour: string;
}

export interface ViewEventMap {
  load: CustomEvent<null>;
  error: CustomEvent<{ code: string; message: string }>;
}

/** `addEventListener` with the element's own events. */
interface Listens<Events> {
  addEventListener<Name extends keyof Events>(
    type: Name,
    listener: (event: Events[Name]) => unknown,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(
    type: string,
    listener: EventListenerOrEventListenerObject,
    options?: boolean | AddEventListenerOptions,
  ): void;
}

export type SillonStudioElement = Listens<StudioEventMap> & HTMLElement & StudioAttributes & StudioMethods;
export type SillonViewElement = Listens<ViewEventMap> & HTMLElement & ViewAttributes;

declare global {
  interface HTMLElementTagNameMap {
    'sillon-studio': SillonStudioElement;
    'sillon-view': SillonViewElement;
  }
}
