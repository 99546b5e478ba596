// Actions of the elements. They know the state and this; main.ts puts together what it takes.
import { download } from '../files/download.js';
import { plainName } from '../files/file-name.js';
import { pickFiles } from '../files/pick.js';
import { recallText, remember } from '../files/remember.js';
import { setLanguage, t } from '../i18n/text.js';
import { toReview, useBrought, withoutBrought } from '../model/brought.js';
import { groundFill } from '../model/fills.js';
import { homeLight, isOwnPicture, lampsOf } from '../model/lamp.js';
import { pictureLayers } from '../model/layers.js';
import { nothingLeft, type Left } from '../model/left.js';
import { pageOf, type Plate } from '../model/plate.js';
import type { Problem } from '../model/problem.js';
import { isAbort, problemOf, same } from '../model/problem.js';
import { isNobodys } from '../model/printers.js';
import type { Store } from '../model/store.js';
import type { Theme, Tool } from '../model/state.js';
import type { Light, ViewName } from '../model/view.js';
import type { OpenedFiles, Role } from '../model/file-role.js';
import type { Services } from './services.js';
import { offers, type Dialog, type LightMode, type Notice, type NoticeAction, type Shown } from './shown.js';

export type Product = 'gcode' | 'body' | 'zones' | 'svg' | 'png' | 'loop' | 'view' | 'project';

/** What the canvas lends to others. */
export interface Stage {
  /** For keys: also where a button has gone that had the focus. */
  focus(): void;
  fit(): void;
  zoom(factor: number): void;
  /** Takes a wheel that turned over something that lies above the plate. */
  wheel(event: WheelEvent): void;
  /** Millimetres of the page. */
  lookAt(x: number, y: number, across: number): void;
  /** The box of the plate's page, from the canvas's own corner [CSS pixels]. */
  plateBox(): { left: number; top: number; width: number; height: number };
  getBoundingClientRect(): DOMRect;
  capture(width: number): Promise<Blob>;
  loop(signal?: AbortSignal): Promise<Blob>;
}

const ownPrintName = 'print';
const loadOwnPrint = () => import('../model/own-print.js');
const noticeFor = 7000; // [ms]
const offerFor = 30_000; // [ms] of a notice with a button: time to read, decide, and reach it by keys

export const isPacked = (product: Product, plate: Plate): boolean =>
  product === 'gcode' && plate.printer.flavor === 'bambu';
const endings: Record<Product, string> = {
  gcode: '.gcode',
  body: '.base.3mf',
  zones: '.zones.3mf',
  svg: '.svg',
  png: '.png',
  loop: '.webp',
  view: '.view.png',
  project: '.sillon.zip',
};

const fileName = (plate: Plate, product: string): string => `${plainName(plate.name) || 'plate'}${product}`;

/** What tells one G-code file from another on a printer's screen: `_0.4mm_PLA_1h05m`. */
export function gcodeMark({ printer }: Plate, seconds: number): string {
  const minutes = Math.max(1, Math.round(seconds / 60));
  const hours = Math.floor(minutes / 60);
  const time = hours > 0 ? `${hours}h${String(minutes % 60).padStart(2, '0')}m` : `${minutes}m`;
  const words = [`${Number(printer.nozzle.toFixed(2))}mm`, plainName(printer.filamentType), time];
  return words.map((word) => (word === '' ? '' : `_${word}`)).join('');
}

/** Phones ask their owner, and only after a touch; computers have no tilt to tell. */
async function mayTilt(): Promise<boolean> {
  if (!('DeviceOrientationEvent' in window)) return false;
  const { requestPermission } = DeviceOrientationEvent as { requestPermission?: () => Promise<string> };
  try {
    if (requestPermission !== undefined) return (await requestPermission()) === 'granted';
  } catch {
    return false;
  }
  return matchMedia('(pointer: coarse)').matches;
}

export class Studio {
  stage: Stage | undefined;
  services!: Services;
  /** Gives a file to the visitor, or to the page that shows this one. */
  deliver: (blob: Blob, name: string) => void = download;
  /** Of opened files, to save them back in their place. */
  readonly handles = new WeakMap<File, FileSystemHandle>();
  /** Of the plate that is shown. */
  left: Left = nothingLeft;
  #nextNotice = 1;
  /** What of printers was seen before a file was taken with it, as `toReview` has it. */
  readonly #seen = new Set<string>();
  /** Takes a file to the printer, once a sheet is answered. */
  #waiting: (() => void) | undefined;

  constructor(
    readonly store: Store<Shown>,
    /** What the engine is asked for. */
    readonly threads: 'auto' | 'off' | number,
    /** Whether this is shown in a frame of another page. */
    readonly framed: boolean,
  ) {}

  /** A small choice of an earlier visit; frames have none, as other pages set theirs. */
  recall = (name: string): string | undefined => (this.framed ? undefined : recallText(name));

  remember(name: string, text: string): void {
    if (!this.framed) remember(name, text);
  }

  /** Puts what the visitor has said to print with into the state. */
  async recallOwnPrint(): Promise<void> {
    const text = this.recall(ownPrintName);
    if (text !== undefined) this.store.set({ own: (await loadOwnPrint()).OwnPrint.of(text) });
  }

  /** @param thickness  [mm] of plates that follow; undefined: none was said */
  async keepOwnPrint(thickness: number | undefined): Promise<void> {
    if (this.framed) return;
    const { OwnPrint, ownPrintText } = await loadOwnPrint();
    const text = ownPrintText(this.store.state.plate, thickness);
    this.remember(ownPrintName, text);
    this.store.set({ own: OwnPrint.of(text) });
  }

  /** Their own choice of printer or filament, which plates that follow have, too. */
  choosePrint(change: (plate: Plate) => Plate): void {
    this.change(change);
    void this.attempt(() => this.keepOwnPrint(this.store.state.own?.said.thickness));
  }

  // --- The plate ----------------------------------------------------------------------------------------------------------

  /** @param gesture  names a drag that goes on until `settle`. */
  change(change: (plate: Plate) => Plate, gesture?: string): void {
    this.store.change(change, gesture);
    if (gesture !== undefined && !this.store.state.live) this.store.set({ live: true });
  }

  settle(): void {
    this.store.settle();
    if (this.store.state.live) this.store.set({ live: false });
  }

  /** At a plate that nobody has looked at yet. */
  look(): void {
    this.store.set({ mark: -1, played: 1, playing: false, tool: 'pan', layer: undefined, cropping: false });
    this.setOpened(undefined);
    this.left = nothingLeft;
    this.stage?.fit();
  }

  /** Lower left corner of a plate in the middle of the bed. */
  centredPlace(): [number, number] {
    const { bedMin, bedMax } = this.store.state.plate.printer;
    const [width, height] = this.boxOnBed();
    const middle = (k: 0 | 1, length: number): number => Math.round((10 * (bedMin[k] + bedMax[k] - length)) / 2) / 10;
    return [middle(0, width), middle(1, height)];
  }

  /** The page's box as it lies turned. */
  boxOnBed(): [number, number] {
    const { plate } = this.store.state;
    const [width, tall] = pageOf(plate);
    const angle = (plate.print.rotate * Math.PI) / 180;
    const c = Math.abs(Math.cos(angle));
    const s = Math.abs(Math.sin(angle));
    return [c * width + s * tall, s * width + c * tall];
  }

  // --- The page -----------------------------------------------------------------------------------------------------------

  /** The section that was open before the list of what was found. */
  #before = '';

  /** The list of what was found comes with the view that shows its places, and goes with it. */
  setView(view: ViewName): void {
    const { state } = this.store;
    const lists = view === 'quality' && offers(state, 'quality');
    if (lists && state.panel !== 'quality') this.#before = state.panel;
    const panel = lists ? 'quality' : state.panel === 'quality' ? this.#before : state.panel;
    this.store.set({ view, panel });
  }

  /** The section that is open at first; '': none. */
  firstPanel(): string {
    const { mode } = this.store.state;
    if (!matchMedia('(min-width: 721px) and (min-height: 480px)').matches) return '';
    return mode === 'edit' ? 'layers' : mode === 'customize' ? 'own' : '';
  }

  setPanel(panel: string): void {
    if (panel === 'quality') this.setView('quality');
    else this.store.set({ panel });
  }

  setTool(tool: Tool): void {
    this.store.set({ tool });
    // In the shimmer strokes are seen as they will be; elsewhere they are seen as directions.
    if (tool !== 'pan' && this.store.state.view !== 'appearance') this.setView('directions');
  }

  togglePlay(): void {
    const { playing, played } = this.store.state;
    this.setView('toolpath');
    this.store.set(playing ? { playing: false } : { playing: true, played: played >= 1 ? 0 : played });
  }

  /** Where the plate looks as it is meant to; the light comes back to it. */
  homeLight(): Light {
    const { plate, result, light, lightMode } = this.store.state;
    return lightMode === 'fixed' ? light : homeLight(plate, result?.toolpath.look);
  }

  /** Of the plate's pictures. */
  lamps(): Light[] {
    const { plate, result } = this.store.state;
    return lampsOf(plate, result?.toolpath.look);
  }

  /** The light moves to a picture's lamp and stays near it. */
  showLamp(lamp: number): void {
    this.store.set({ lamp, aimed: undefined, flipping: false, lightMode: 'pointer', view: 'appearance' });
  }

  /** Whether the visitor asks for little motion. */
  calm = (): boolean => matchMedia('(prefers-reduced-motion: reduce)').matches;

  /** The light stands still while nobody moves it: somebody's own picture would be lost beside its lamp. */
  keepsStill(): boolean {
    const { plate, lamp } = this.store.state;
    return (
      this.calm() || isOwnPicture(plate, lamp) || (groundFill(plate) !== 'picture' && pictureLayers(plate).length > 0)
    );
  }

  /** The lamp turns from each picture to the next until it is told to stop. */
  flip(): void {
    const { flipping, lamp } = this.store.state;
    const next = (lamp + 1) % Math.max(1, this.lamps().length);
    if (this.calm()) this.showLamp(next);
    else this.store.set({ flipping: !flipping, aimed: undefined, lightMode: 'pointer', view: 'appearance' });
  }

  /** By hand: whatever moved the light before leaves it alone. */
  setLight(change: Partial<Light>): void {
    const light = { ...this.store.state.light, ...change };
    this.store.set({ light, aimed: undefined, lightMode: 'fixed', flipping: false });
  }

  async setLightMode(lightMode: LightMode): Promise<void> {
    if (lightMode === 'tilt' && !(await mayTilt())) {
      this.notify(t('light.tiltDenied'));
      this.store.set({ lightMode: 'orbit' });
      return;
    }
    this.store.set({ lightMode, aimed: undefined, flipping: false });
  }

  lookAtMark(index: number): void {
    const mark = this.store.state.marks[index];
    if (mark === undefined) return;
    this.store.set({ mark: index, view: 'quality' });
    this.stage?.lookAt(mark.x, mark.y, 20 * this.store.state.plate.toolpath.spacing);
  }

  setTheme(theme: Theme): void {
    this.store.set({ theme });
  }

  /** Not to be said again on this device. */
  endWelcome(): void {
    this.store.set({ welcome: false, flipping: false });
    this.remember('welcomed', 'yes');
  }

  show(dialog: Dialog | undefined): void {
    this.store.set({ dialog });
  }

  async setLanguage(language: string): Promise<void> {
    await this.attempt(async () => {
      await this.speak(language);
      this.remember('language', language);
    });
  }

  /** For this visit alone. */
  async speak(language: string): Promise<void> {
    await setLanguage(language);
    document.documentElement.lang = language;
    this.store.set({ language });
  }

  // --- Words --------------------------------------------------------------------------------------------------------------

  notify(text: string, ...actions: NoticeAction[]): void {
    this.tell({ text, actions });
  }

  /** @returns the number of what stands there now */
  fail(problem: Problem): number {
    return this.tell({ text: '', problem });
  }

  dismiss(id: number): void {
    this.store.set({ notices: this.store.state.notices.filter((notice) => notice.id !== id) });
  }

  /** Runs what may fail; a failure is told. @returns whether it went well. */
  async attempt(action: () => Promise<void> | void): Promise<boolean> {
    try {
      await action();
      return true;
    } catch (error) {
      if (!isAbort(error)) this.fail(problemOf(error));
      return false;
    }
  }

  /** @returns the number of the notice, by which it is dismissed; 0: the plate's problem says it */
  tell(words: Omit<Notice, 'id'>): number {
    const { problem: told } = words;
    const { problem, notices, dialog } = this.store.state;
    if (told !== undefined) {
      if (problem !== undefined && same(problem, told)) return 0;
      const standing = notices.find((notice) => notice.problem !== undefined && same(notice.problem, told));
      // Sheets show only what is told while they are open.
      if (standing !== undefined && dialog === undefined) return standing.id;
    }
    const id = this.#nextNotice++;
    const others = notices.filter((notice) => notice.problem === undefined || told === undefined);
    const all = [...others, { id, ...words }];
    const latest = all.filter(({ stays }) => !stays).slice(-3);
    this.store.set({ notices: all.filter((notice) => notice.stays || latest.includes(notice)) });
    if (told !== undefined || words.stays) return id;
    const shownFor = words.actions?.length ? offerFor : noticeFor;
    setTimeout(() => {
      this.dismiss(id);
    }, shownFor);
    return id;
  }

  /** @param opened  undefined: another plate, of other files; what was offered for those before would be done to these */
  setOpened(opened: OpenedFiles | undefined): void {
    this.store.set({ opened, notices: this.store.state.notices.filter(({ ofFiles }) => !ofFiles) });
  }

  // --- Files --------------------------------------------------------------------------------------------------------------

  /** @param role  of all of them, where it is known */
  async open(files: readonly File[], role?: Role): Promise<void> {
    if (files.length > 0) await this.attempt(() => this.services.open(files, role));
  }

  /** Asks for files; the plate is as before where none is chosen. @param accept  empty: any; then a project among them can be
   * saved back in its place */
  async pick(accept = ''): Promise<File[]> {
    if (accept === '' && 'showOpenFilePicker' in window)
      return (await import('../files/in-place.js')).pickInPlace(this.handles);
    return pickFiles(accept);
  }

  async save(product: Product): Promise<void> {
    if (product !== 'gcode' || !(this.#mustAsk() || this.#mustReview())) await this.#save(product);
    else this.whenReviewed(() => void this.#save(product));
  }

  /** Takes a file to the printer, at once or once it was said which one that is, and everything was seen that it would run. */
  whenReviewed(save: () => void): void {
    if (this.#mustAsk()) {
      this.#waiting = save;
      this.change((plate) => this.store.state.own?.on(plate) ?? plate);
      this.show('firstFile');
    } else if (this.#mustReview()) this.review(save);
    else save();
  }

  /** Shows the blocks. @param save  what their button is for; left out: the plate's own file */
  review(save = (): void => void this.#save('gcode')): void {
    this.#waiting = save;
    this.show('blocks');
  }

  /** The blocks are on the screen no more. */
  goOn(): void {
    const { printer } = this.store.state.plate;
    this.#setReviewed(toReview(printer));
    this.#waiting?.();
  }

  /** Goes on with the file once its printer is named and the sheet is gone; blocks that need a review come first. */
  goOnPrinting(): void {
    if (this.#mustReview()) this.review(this.#waiting);
    else this.#waiting?.();
  }

  async #save(product: Product): Promise<void> {
    await this.attempt(async () => {
      const { blob, name } = await this.make(product);
      const place = product === 'project' ? await this.services.savedInPlace(blob) : '';
      if (place !== '') {
        this.notify(place);
        return;
      }
      this.deliver(blob, name);
      if (product === 'body') this.#offerRest(name);
      else if (product !== 'gcode' || this.store.state.host !== '') this.notify(t('export.done', { name }));
      else (await import('./untried-print.js')).tellPrint(this, name);
    });
  }

  /** Returns whether nobody has said which machine the plate is for. */
  lacksPrinter(): boolean {
    const { plate, own } = this.store.state;
    return isNobodys(plate.printer) && own?.means(plate.printer) !== true;
  }

  /** A page around this one answers for the printer. */
  #mustAsk = (): boolean => !this.framed && this.lacksPrinter();

  /** Nothing moves or heats a machine that nobody has seen. */
  #mustReview(): boolean {
    const text = toReview(this.store.state.plate.printer);
    return text !== '' && !this.#seen.has(text) && this.recall('reviewed') !== text;
  }

  #setReviewed(text: string): void {
    this.#seen.add(text);
    this.remember('reviewed', text);
  }

  /** What the design brings is used from now on. @param seen  every line of it was on the screen */
  useBrought(seen: boolean): void {
    this.settle();
    this.change(useBrought);
    const text = toReview(this.store.state.plate.printer);
    if (seen && text !== '') this.#setReviewed(text);
  }

  keepOwnPrinter(): void {
    this.settle();
    this.change(withoutBrought);
  }

  /** Whoever prints the base elsewhere mostly wants the rest above it next. */
  #offerRest(name: string): void {
    const { plate, mode } = this.store.state;
    if (plate.print.showSide !== 'up' || mode !== 'edit') {
      this.notify(t('export.done', { name }));
      return;
    }
    const { base, startHeight, layerHeight, firstLayerHeight } = plate.print;
    const first = (startHeight === 0 && firstLayerHeight) || layerHeight;
    const height = Number((startHeight + first + (base - 1) * layerHeight).toFixed(3));
    this.notify(t('export.body.rest', { name, height }), {
      label: t('export.body.set'),
      run: () => {
        this.change((now) => ({ ...now, print: { ...now.print, base: 0, startHeight: height } }));
      },
    });
  }

  /** A file of the plate as it is now. */
  async make(product: Product, signal?: AbortSignal): Promise<{ blob: Blob; name: string }> {
    const { plate } = this.store.state;
    const blob = await this.#make(product, plate, signal);
    const { summary } = this.store.state;
    const mark = product === 'gcode' && summary !== undefined ? gcodeMark(plate, summary.seconds) : '';
    return { blob, name: fileName(plate, mark + (isPacked(product, plate) ? '.gcode.3mf' : endings[product])) };
  }

  async #gcode(plate: Plate): Promise<Blob> {
    const { blob } = await this.services.gcode();
    return isPacked('gcode', plate) ? (await this.services.engine()).packGcode(blob) : blob;
  }

  async #make(product: Product, plate: Plate, signal?: AbortSignal): Promise<Blob> {
    switch (product) {
      case 'gcode':
        return this.#gcode(plate);
      case 'project':
        return this.#project(plate);
      case 'png':
        return this.#canvas().capture(2400);
      case 'loop':
        return this.#loop(signal);
      default:
        return this.services[product]();
    }
  }

  async #project(plate: Plate): Promise<Blob> {
    return (await import('../files/project.js')).writeProject(plate);
  }

  /** @param width  [pixels] */
  async picture(width: number): Promise<{ blob: Blob; name: string }> {
    const { plate } = this.store.state;
    return { blob: await this.#canvas().capture(width), name: fileName(plate, endings.png) };
  }

  async #loop(signal?: AbortSignal): Promise<Blob> {
    this.store.set({ recording: true });
    try {
      return await this.#canvas().loop(signal);
    } finally {
      this.store.set({ recording: false });
    }
  }

  #canvas(): Stage {
    if (this.stage === undefined) throw new Error('the canvas is not there');
    return this.stage;
  }
}
