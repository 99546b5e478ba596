// Actions of the elements. They depend on the state and this class alone; main.ts connects the rest.
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

/** Functions of the canvas that other parts use. */
export interface Stage {
  /** Takes the keyboard focus, also after a focused button has disappeared. */
  focus(): void;
  fit(): void;
  zoom(factor: number): void;
  /** Handles a wheel event of an element that lies above the plate. */
  wheel(event: WheelEvent): void;
  /** Centres a place of the page and shows a width around it; all in mm. */
  lookAt(x: number, y: number, across: number): void;
  /** Returns the box of the plate's page, relative to the canvas's corner [CSS pixels]. */
  plateBox(): { left: number; top: number; width: number; height: number };
  getBoundingClientRect(): DOMRect;
  capture(width: number): Promise<Blob>;
  loop(signal?: AbortSignal): Promise<Blob>;
}

const ownPrintName = 'print';
const loadOwnPrint = () => import('../model/own-print.js');
const noticeFor = 7000; // [ms]
const offerFor = 30_000; // [ms] for a notice with a button: time to read, decide, and reach it by keyboard

/** Tells whether a product is packed into a .gcode.3mf, as Bambu printers need it. */
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

/** Returns the part of a G-code file's name that tells files apart on a printer's screen: `_0.4mm_PLA_1h05m`. */
export function gcodeMark({ printer }: Plate, seconds: number): string {
  const minutes = Math.max(1, Math.round(seconds / 60));
  const hours = Math.floor(minutes / 60);
  const time = hours > 0 ? `${hours}h${String(minutes % 60).padStart(2, '0')}m` : `${minutes}m`;
  const words = [`${Number(printer.nozzle.toFixed(2))}mm`, plainName(printer.filamentType), time];
  return words.map((word) => (word === '' ? '' : `_${word}`)).join('');
}

/** Tells whether the device's tilt can be used: phones ask
 * their owner, and only after a touch; computers have no tilt. */
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

/** The state of the studio with all actions that elements call. */
export class Studio {
  stage: Stage | undefined;
  services!: Services;
  /** Gives a file to the visitor, or to the page that shows this one. */
  deliver: (blob: Blob, name: string) => void = download;
  /** Handles of opened files, to save them back in place. */
  readonly handles = new WeakMap<File, FileSystemHandle>();
  /** Former grounds and shape of the shown plate, so that going back asks for no file again. */
  left: Left = nothingLeft;
  #nextNotice = 1;
  /** Printer texts of `toReview` that were seen before a file was made with them. */
  readonly #seen = new Set<string>();
  /** Makes the file once an open sheet is answered. */
  #waiting: (() => void) | undefined;

  constructor(
    readonly store: Store<Shown>,
    /** Threads that the engine is started with. */
    readonly threads: 'auto' | 'off' | number,
    /** The studio is shown in a frame of another page. */
    readonly framed: boolean,
  ) {}

  /** Returns a small choice of an earlier visit; frames have none, because their hosts set these choices. */
  recall = (name: string): string | undefined => (this.framed ? undefined : recallText(name));

  remember(name: string, text: string): void {
    if (!this.framed) remember(name, text);
  }

  /** Puts the visitor's own printer and filament into the state. */
  async recallOwnPrint(): Promise<void> {
    const text = this.recall(ownPrintName);
    if (text !== undefined) this.store.set({ own: (await loadOwnPrint()).OwnPrint.of(text) });
  }

  /** Remembers the printer and filament of the plate.
   * @param thickness  thickness of later plates [mm]; undefined: none was named */
  async keepOwnPrint(thickness: number | undefined): Promise<void> {
    if (this.framed) return;
    const { OwnPrint, ownPrintText } = await loadOwnPrint();
    const text = ownPrintText(this.store.state.plate, thickness);
    this.remember(ownPrintName, text);
    this.store.set({ own: OwnPrint.of(text) });
  }

  /** Applies the visitor's own choice of printer or filament, which later plates get, too. */
  choosePrint(change: (plate: Plate) => Plate): void {
    this.change(change);
    void this.attempt(() => this.keepOwnPrint(this.store.state.own?.said.thickness));
  }

  // --- The plate ----------------------------------------------------------------------------------------------------------

  /** Changes the plate. @param gesture  name of a drag that goes on until `settle` */
  change(change: (plate: Plate) => Plate, gesture?: string): void {
    this.store.change(change, gesture);
    if (gesture !== undefined && !this.store.state.live) this.store.set({ live: true });
  }

  /** Ends a drag. */
  settle(): void {
    this.store.settle();
    if (this.store.state.live) this.store.set({ live: false });
  }

  /** Resets the view for a new plate. */
  look(): void {
    this.store.set({ mark: -1, played: 1, playing: false, tool: 'pan', layer: undefined, cropping: false });
    this.setOpened(undefined);
    this.left = nothingLeft;
    this.stage?.fit();
  }

  /** Returns the lower left corner of a plate in the middle of the bed [mm]. */
  centredPlace(): [number, number] {
    const { bedMin, bedMax } = this.store.state.plate.printer;
    const [width, height] = this.boxOnBed();
    const middle = (k: 0 | 1, length: number): number => Math.round((10 * (bedMin[k] + bedMax[k] - length)) / 2) / 10;
    return [middle(0, width), middle(1, height)];
  }

  /** Returns the bounding box of the turned page [mm]. */
  boxOnBed(): [number, number] {
    const { plate } = this.store.state;
    const [width, tall] = pageOf(plate);
    const angle = (plate.print.rotate * Math.PI) / 180;
    const c = Math.abs(Math.cos(angle));
    const s = Math.abs(Math.sin(angle));
    return [c * width + s * tall, s * width + c * tall];
  }

  // --- The page -----------------------------------------------------------------------------------------------------------

  /** Section that was open before the list of findings. */
  #before = '';

  /** Sets the view; the list of findings opens and closes with the view that shows its places. */
  setView(view: ViewName): void {
    const { state } = this.store;
    const lists = view === 'quality' && offers(state, 'quality');
    if (lists && state.panel !== 'quality') this.#before = state.panel;
    const panel = lists ? 'quality' : state.panel === 'quality' ? this.#before : state.panel;
    this.store.set({ view, panel });
  }

  /** Returns the section that is open at first; '': none. */
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
    // In the shimmer, strokes are seen as they will be printed; all other views switch to directions.
    if (tool !== 'pan' && this.store.state.view !== 'appearance') this.setView('directions');
  }

  togglePlay(): void {
    const { playing, played } = this.store.state;
    this.setView('toolpath');
    this.store.set(playing ? { playing: false } : { playing: true, played: played >= 1 ? 0 : played });
  }

  /** Returns the light under which the plate looks as intended; the light returns to it. */
  homeLight(): Light {
    const { plate, result, light, lightMode } = this.store.state;
    return lightMode === 'fixed' ? light : homeLight(plate, result?.toolpath.look);
  }

  /** Returns the lamps of the plate's pictures. */
  lamps(): Light[] {
    const { plate, result } = this.store.state;
    return lampsOf(plate, result?.toolpath.look);
  }

  /** Moves the light to a picture's lamp; it stays near it. */
  showLamp(lamp: number): void {
    this.store.set({ lamp, aimed: undefined, flipping: false, lightMode: 'pointer', view: 'appearance' });
  }

  /** Tells whether the visitor asks for reduced motion. */
  calm = (): boolean => matchMedia('(prefers-reduced-motion: reduce)').matches;

  /** Tells whether the light stands still while nobody moves it:
   * away from its lamp, a visitor's own picture would be lost. */
  keepsStill(): boolean {
    const { plate, lamp } = this.store.state;
    return (
      this.calm() || isOwnPicture(plate, lamp) || (groundFill(plate) !== 'picture' && pictureLayers(plate).length > 0)
    );
  }

  /** Moves the lamp from each picture to the next until it is stopped; with reduced motion, by one picture. */
  flip(): void {
    const { flipping, lamp } = this.store.state;
    const next = (lamp + 1) % Math.max(1, this.lamps().length);
    if (this.calm()) this.showLamp(next);
    else this.store.set({ flipping: !flipping, aimed: undefined, lightMode: 'pointer', view: 'appearance' });
  }

  /** Sets the light by hand, which ends all other motion of the light. */
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

  /** Zooms in on a mark in the view of findings. */
  lookAtMark(index: number): void {
    const mark = this.store.state.marks[index];
    if (mark === undefined) return;
    this.store.set({ mark: index, view: 'quality' });
    this.stage?.lookAt(mark.x, mark.y, 20 * this.store.state.plate.toolpath.spacing);
  }

  setTheme(theme: Theme): void {
    this.store.set({ theme });
  }

  /** Ends the welcome, for good on this device. */
  endWelcome(): void {
    this.store.set({ welcome: false, flipping: false });
    this.remember('welcomed', 'yes');
  }

  show(dialog: Dialog | undefined): void {
    this.store.set({ dialog });
  }

  /** Returns a function that shows a dialog. */
  opens = (dialog: Dialog) => (): void => this.show(dialog);

  async setLanguage(language: string): Promise<void> {
    await this.attempt(async () => {
      await this.speak(language);
      this.remember('language', language);
    });
  }

  /** Sets the language for this visit alone. */
  async speak(language: string): Promise<void> {
    await setLanguage(language);
    document.documentElement.lang = language;
    this.store.set({ language });
  }

  // --- Notices ------------------------------------------------------------------------------------------------------------

  notify(text: string, ...actions: NoticeAction[]): void {
    this.tell({ text, actions });
  }

  /** Reports a problem. @returns the id of the notice */
  fail(problem: Problem): number {
    return this.tell({ text: '', problem });
  }

  dismiss(id: number): void {
    this.store.set({ notices: this.store.state.notices.filter((notice) => notice.id !== id) });
  }

  /** Runs an action and reports its failure. @returns true if it went well */
  async attempt(action: () => Promise<void> | void): Promise<boolean> {
    try {
      await action();
      return true;
    } catch (error) {
      if (!isAbort(error)) this.fail(problemOf(error));
      return false;
    }
  }

  /** Shows a notice. @returns its id, to dismiss it; 0: the plate's problem already says the same */
  tell(words: Omit<Notice, 'id'>): number {
    const { problem: told } = words;
    const { problem, notices, dialog } = this.store.state;
    if (told !== undefined) {
      if (problem !== undefined && same(problem, told)) return 0;
      const standing = notices.find((notice) => notice.problem !== undefined && same(notice.problem, told));
      // An open sheet shows only notices that were made after it opened.
      if (standing !== undefined && dialog === undefined) return standing.id;
    }
    const id = this.#nextNotice++;
    const others = notices.filter((notice) => notice.problem === undefined || told === undefined);
    const all = [...others, { id, ...words }];
    const latest = all.filter(({ stays }) => !stays).slice(-3);
    this.store.set({ notices: all.filter((notice) => notice.stays || latest.includes(notice)) });
    if (told !== undefined || words.stays) return id;
    const shownFor = words.actions?.length ? offerFor : noticeFor;
    setTimeout(() => this.dismiss(id), shownFor);
    return id;
  }

  /** Sets the files that were opened last.
   * @param opened  undefined: the plate comes from other files,
   * and offers about the earlier files would act on the wrong ones */
  setOpened(opened: OpenedFiles | undefined): void {
    this.store.set({ opened, notices: this.store.state.notices.filter(({ ofFiles }) => !ofFiles) });
  }

  // --- Files --------------------------------------------------------------------------------------------------------------

  /** Opens files. @param role  role of all of them, if it is known */
  async open(files: readonly File[], role?: Role): Promise<void> {
    if (files.length > 0) await this.attempt(() => this.services.open(files, role));
  }

  /** Asks for files; none chosen: the plate stays as it is.
   * @param accept  accepted types; empty: any, and a project among them can be saved back in place */
  async pick(accept = ''): Promise<File[]> {
    if (accept === '' && 'showOpenFilePicker' in window)
      return (await import('../files/in-place.js')).pickInPlace(this.handles);
    return pickFiles(accept);
  }

  openPicked = async (): Promise<void> => this.open(await this.pick());

  /** Makes a file and delivers it; a G-code file only after the printer and its blocks were confirmed. */
  async save(product: Product): Promise<void> {
    if (product !== 'gcode' || !(this.#mustAsk() || this.#mustReview())) await this.#save(product);
    else this.whenReviewed(() => void this.#save(product));
  }

  /** Makes a file for the printer, after the visitor has named the printer and has seen all text that it would run. */
  whenReviewed(save: () => void): void {
    if (this.#mustAsk()) {
      this.#waiting = save;
      this.change((plate) => this.store.state.own?.on(plate) ?? plate);
      this.show('firstFile');
    } else if (this.#mustReview()) this.review(save);
    else save();
  }

  /** Shows the blocks of the printer. @param save  action of their button; left out: the plate's own file */
  review(save = (): void => void this.#save('gcode')): void {
    this.#waiting = save;
    this.show('blocks');
  }

  /** Marks the blocks as reviewed and makes the file. */
  goOn(): void {
    const { printer } = this.store.state.plate;
    this.#setReviewed(toReview(printer));
    this.#waiting?.();
  }

  /** Makes the file after its printer was named and the sheet closed; blocks that need a review come first. */
  goOnPrinting(): void {
    if (this.#mustReview()) this.review(this.#waiting);
    else this.#waiting?.();
  }

  /** Makes a file and saves it in place, or delivers it. */
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

  /** Tells whether nobody has said which machine the plate is for. */
  lacksPrinter(): boolean {
    const { plate, own } = this.store.state;
    return isNobodys(plate.printer) && own?.means(plate.printer) !== true;
  }

  /** Tells whether to ask for the printer; in a frame, the surrounding page vouches for it. */
  #mustAsk = (): boolean => !this.framed && this.lacksPrinter();

  /** Tells whether the printer's blocks must be reviewed: nothing unseen may move or heat a machine. */
  #mustReview(): boolean {
    const text = toReview(this.store.state.plate.printer);
    return text !== '' && !this.#seen.has(text) && this.recall('reviewed') !== text;
  }

  #setReviewed(text: string): void {
    this.#seen.add(text);
    this.remember('reviewed', text);
  }

  /** Applies the settings that the design brings. @param seen  every line of them was on the screen */
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

  /** Offers to set the start height to the top of the base: whoever
   * prints the base elsewhere usually wants the rest next. */
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
      run: () => this.change((now) => ({ ...now, print: { ...now.print, base: 0, startHeight: height } })),
    });
  }

  /** Returns a file of the current plate. */
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

  /** Makes the content of a product. */
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

  /** Returns a picture of the plate. @param width  [pixels] */
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
