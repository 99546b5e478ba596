// Puts a page together: state, engine, directions, files, and what the elements may ask for. There are two: the studio, and
// the studio as it is shown in a frame of another page.
import { spoken } from '../i18n/languages.js';
import { languageFor, say, setLanguage, t } from '../i18n/text.js';
import directionsWorker from '../generators/directions.worker.ts?worker&url';
import { createRasteriser } from '../generators/rasteriser.js';
import type { Room } from '../generators/room.js';
import { loadEngine } from '../engine/load.js';
import { StudioEngine } from '../engine/studio-engine.js';
import type { Autosave, Kept, Opened } from '../files/autosave.js';
import type { PrinterValues } from 'sillon';
import { newPlateOn, onOwnPrinter, withoutBrought } from '../model/brought.js';
import type { Plate } from '../model/plate.js';
import { homeLight, pictureOf } from '../model/lamp.js';
import { nothingLeft } from '../model/left.js';
import { markUnfetched, problemOf, StudioError } from '../model/problem.js';
import { addressed } from '../embed/address.js';
import { guestSettings, type GuestSettings } from '../model/guest.js';
import type { OpenedFiles } from '../model/file-role.js';
import { withPrinter, type PrinterKey } from '../model/printers.js';
import { fineResolution } from '../model/raster.js';
import type { PlateResult, State, Theme } from '../model/state.js';
import { Store } from '../model/store.js';
import { Untried } from '../model/untried.js';
import { createOpener } from './opening.js';
import './app.js';
import { newShown } from '../studio/shown.js';
import { Studio } from '../studio/studio.js';
import { Pipeline } from './pipeline.js';
import { startWorker } from '../engine/start-worker.js';
import marksWorker from '../views/marks.worker.ts?worker&url';
import { recall, recallText, remember } from '../files/remember.js';

addEventListener('vite:preloadError', ({ payload }) => {
  markUnfetched(payload);
});

/** Whether this is the page for frames of others. */
const framed = document.documentElement.dataset['page'] === 'frame';
const asked = addressed(location.search);
const threads = asked.given.threads ?? 'auto';
const store = new Store(newShown());
const firstVisit = !framed && asked.files.length === 0 && location.hash === '' && recallText('welcomed') === undefined;
/** Of what a first visit sees first; asked for before anything else. */
const shimmer = firstVisit
  ? import('./shimmer.js').then(({ loadShimmer }) => loadShimmer()).catch(() => undefined) // the beads will be there soon
  : undefined;
const studio = new Studio(store, threads);

const engine = new StudioEngine(
  { load: () => loadEngine(threads, Promise.race([shimmer, elapsed(restoreWithin)])), now: () => performance.now() },
  {
    onResult: (result) => {
      pipeline.onResult(result);
    },
    onProgress: (progress) => {
      store.set({ progress });
    },
    onProblem: (problem) => {
      store.set({ problem });
    },
    onInfo: (info) => {
      store.set({ engine: info });
    },
  },
);
const rasteriser = createRasteriser(
  async (file) => {
    const [{ pictureOfFile }, running] = await Promise.all([import('../files/drawn.js'), engine.engine()]);
    return pictureOfFile(file, running);
  },
  () => startWorker(directionsWorker, 'directions'),
);
async function shapeRoom(plate: Plate): Promise<Room> {
  const [made, running] = await Promise.all([import('../generators/shape-room.js'), engine.engine()]);
  return made.shapeRoom(plate, running);
}
const pipeline = new Pipeline(store, engine, rasteriser, () => startWorker(marksWorker, 'marks'), shapeRoom);
/** Of the studio itself at once; in a frame none until a host says so. */
let autosave: Autosave | undefined;

/** The words about kept plates, which no first visit fetches. */
const plateWords = async () => (await import('../i18n/en/plates.js')).words;

async function keeper(host?: string): Promise<Autosave> {
  const { createAutosave } = await import('../files/autosave.js');
  const made = createAutosave({
    onProblem: (problem) => {
      studio.fail(problem);
    },
    onTaken: () => {
      made.save(store.steps);
      void plateWords().then((words) => {
        studio.notify(say(words, 'plates.taken'));
      });
    },
    ...(host === undefined ? {} : { host }),
  });
  made.begin(store.state.plate, true);
  autosave = made;
  return made;
}

/** By record: the project files that plates were opened from. */
const places = new Map<string, FileSystemFileHandle>();

/** What of printers was seen before a file was taken with it, as `toReview` has it. */
const reviewed = new Set<string>();

/** Another plate altogether; what was there can be had back by undo. */
function show(plate: Plate, fresh = false): void {
  store.settle();
  autosave?.begin(plate, fresh);
  store.change(() => plate);
  look();
}

/** At a plate that nobody has looked at yet. */
function look(): void {
  store.set({ mark: -1, played: 1, playing: false, tool: 'pan', layer: undefined, cropping: false });
  studio.setOpened(undefined);
  studio.left = nothingLeft;
  studio.stage?.fit();
}

const opener = createOpener(studio, () => engine.engine(), show);
const untried = new Untried();

function kept(): Autosave {
  if (autosave === undefined) throw new StudioError('StorageFull');
  return autosave;
}

studio.services = {
  cancel: () => {
    pipeline.cancel();
  },
  retry: () => {
    pipeline.retry();
  },
  drew: (ms) => {
    engine.drew(ms);
  },
  gcode: () => pipeline.gcode(),
  pack: async (gcode) => (await engine.engine()).packGcode(gcode),
  body: () => pipeline.body(),
  svg: () => pipeline.svg(),
  view: () => pipeline.view(),
  project: async (plate) => {
    const [{ writeProject }, raster] = await Promise.all([import('../files/project.js'), pipeline.directions()]);
    return writeProject(plate, raster);
  },
  projectData: async (plate) => {
    const { projectData } = await import('../files/project.js');
    return projectData(plate);
  },
  link: async (plate) => (await import('../plates/links.js')).linkOf(plate),
  setLanguage: async (language) => {
    await speak(language);
    if (!framed) remember('language', language);
  },
  open: (files, role) => untried.during(() => opener.open(files, role)),
  setRole: (index, role) => untried.during(() => opener.setRole(index, role)),
  openExample: (example) => opener.openExample(example),
  importPrinter: async (file) => {
    const [{ importPrinter }, running] = await Promise.all([import('../print/printer-file.js'), engine.engine()]);
    await importPrinter(studio, file, running);
  },
  newPlate: () => {
    show(newPlateOn(store.state.plate.printer), true);
  },
  welcomed: () => {
    remember('welcomed', 'yes');
  },
  openedFrom: (project) => {
    const handle = studio.handles.get(project);
    if (handle?.kind === 'file' && /\.zip$/i.test(handle.name) && autosave !== undefined)
      places.set(autosave.current(), handle as FileSystemFileHandle);
  },
  savedInPlace: async (project) => {
    const handle = autosave === undefined ? undefined : places.get(autosave.current());
    if (handle === undefined) return '';
    const [{ writeBack }, words] = await Promise.all([import('../files/in-place.js'), plateWords()]);
    return (await writeBack(handle, project)) ? say(words, 'plates.savedTo', { name: handle.name }) : '';
  },
  plates: kept,
  openPlate: async (id, take) => {
    const [opened, words, { showKept }] = await Promise.all([
      kept().open(id, take),
      plateWords(),
      import('./restore.js'),
    ]);
    if (opened === undefined) {
      studio.notify(say(words, 'plates.gone'));
      return;
    }
    goOnWith(showKept)(opened);
    if (opened.state === 'copy') studio.notify(say(words, 'plates.copied'));
  },
  reviewed: (text) => reviewed.has(text) || (!framed && recallText('reviewed') === text),
  setReviewed: (text) => {
    reviewed.add(text);
    if (!framed) remember('reviewed', text);
  },
  keptSpools: () => (framed ? undefined : recallText('spools')),
  keepSpools: (text) => {
    if (!framed) remember('spools', text);
  },
  engine: () => engine.engine(),
  kindPictures: async (plate, wanted) => {
    const [{ kindPictures }, running] = await Promise.all([import('./own-pictures.js'), engine.engine()]);
    return kindPictures(plate, store.state.lamp, studio.left, running, wanted);
  },
  shapePictures: async (plate, wanted) => {
    const [{ shapePictures }, running] = await Promise.all([import('./own-pictures.js'), engine.engine()]);
    return shapePictures(plate, store.state.lamp, running, wanted);
  },
  seen: async (result, directions) =>
    (await import('../quality/seen.js')).seenIn(result, directions, () => engine.engine()),
  directions: () => pipeline.directions(),
  layerBoxes: async (plate) => {
    const [{ layerBoxes }, running] = await Promise.all([import('../engine/layer-boxes.js'), engine.engine()]);
    return layerBoxes(plate, running);
  },
  freePlace: async (plate, taken, wanted) =>
    (await import('../generators/free-place.js')).freePlaceOn(plate, shapeRoom(plate), taken, wanted),
  async handDirections(strokes, box, angle) {
    const { handRaster } = await import('../rebrush/hand.js');
    return handRaster(strokes, box, angle, fineResolution);
  },
  examine: async (block, flavor) => (await engine.engine()).examineBlock(block, flavor),
};

async function speak(language: string): Promise<void> {
  await setLanguage(language);
  document.documentElement.lang = language;
  store.set({ language });
}

const restoreWithin = 1500; // [ms], after which the page begins with what it has; the plate may still come
const linkWithin = 10_000; // [ms], as nobody who follows a link wants to see another plate first
const hostWaits = 10_000; // [ms] for work of an earlier visit: some browsers' storages never answer
const keepsAfter = 60_000; // [ms]; some plates cannot be made

const elapsed = (time: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, time));

const firstPlate = (): Promise<void> =>
  new Promise((resolve) => {
    const end = store.subscribe(({ result }) => {
      if (result === undefined) return;
      end();
      resolve();
    });
  });

/** The plate of the page's address, or the one that was left here, which is offered beside the other. */
async function restore(): Promise<void> {
  for (const { where, value } of asked.wrong) studio.fail({ code: 'GuestValue', values: { where, value }, detail: '' });
  if (framed) {
    if (!(await openLink())) await openAddress();
    return;
  }
  const first = store.state.plate;
  const opening = firstVisit ? opener.first() : undefined; // while the storage is asked
  opening?.catch(() => undefined);
  const kept = keeper().then((made) => made.load());
  const opened = (await openLink(kept)) || (await openAddress(kept));
  const restored = await restoreKept(kept, () => !opened);
  if (!opened && !restored && recallText('welcomed') === undefined) {
    greet(await (opening ?? opener.first()).catch(() => first), first); // it can be done without
  }
}

/** A first visit: a plate that moves by itself until somebody touches it. @param first  what is shown so far */
function greet(plate: Plate, first: Plate): void {
  if (store.state.plate !== first) return; // a hand was faster
  store.change(() => plate);
  look();
  store.forgetSteps();
  store.set({ welcome: true, flipping: plate !== first && !studio.calm() });
  void shimmer?.then((drawn) => {
    if (store.state.plate === plate && store.state.result === undefined) store.set({ shimmer: drawn });
  });
}

/** Of the work that was left here, which may still be on its way. */
async function ownPrinter(kept: Promise<Kept | undefined> | undefined): Promise<PrinterValues> {
  const found = await Promise.race([kept, elapsed(restoreWithin)]);
  const plate = found !== undefined && 'steps' in found ? found.steps.plate : store.state.plate;
  return plate.printer;
}

/** @param wanted  whether it is still to be shown
 * @returns whether there was work of an earlier visit, which is shown now; what comes too late is offered instead */
async function restoreKept(kept: Promise<Kept | undefined>, wanted: () => boolean = () => true): Promise<boolean> {
  const before = store.state.plate;
  const found = await kept;
  if (found === undefined) return false;
  const { restore, showKept } = await import('./restore.js');
  const shows = wanted() && store.state.plate === before; // else a hand was faster
  return restore(studio, found, { shows, framed, show: goOnWith(showKept) });
}

const goOnWith =
  (showKept: (typeof import('./restore.js'))['showKept']) =>
  (found: Opened): void => {
    showKept(studio, found, () => autosave?.begin(found.steps.plate));
    look();
  };

/** In a frame nothing else is shown in the place of what its address names. */
const openNamed = (named: () => Promise<void>): Promise<boolean> => {
  const open = (): Promise<void> => untried.during(named);
  return studio.attempt(async () => {
    if (!framed) await open();
    else await (await import('../embed/frame.js')).showNamed(studio, open);
  });
};

/** Of the files that the address names, on this page's own site. */
async function openAddress(kept?: Promise<Kept | undefined>): Promise<boolean> {
  if (asked.files.length === 0) return false;
  return openNamed(async () => {
    const { fetchFiles } = await import('../embed/fetching.js');
    const files = await fetchFiles(asked.files, document.baseURI).catch((error: unknown) => {
      throw new StudioError('GuestFile', {}, problemOf(error).detail);
    });
    const printer = await ownPrinter(kept);
    store.change((plate) => ({ ...plate, printer }));
    await opener.load(files.map(({ name, bytes, role }) => ({ file: new File([bytes], name), role })));
    usePrinter(asked.given.printer);
  });
}

function usePrinter(key: PrinterKey | undefined): void {
  if (key !== undefined) store.change((plate) => withPrinter(withoutBrought(plate), key));
}

async function openLink(kept?: Promise<Kept | undefined>): Promise<boolean> {
  const { hash } = location;
  // Projects of the site's own gallery, and nothing else.
  const project = /^#open=(gallery\/\w+\.zip)$/.exec(hash)?.[1];
  if (project === undefined && hash !== '#shared' && !hash.startsWith('#plate=')) return false;
  // A reload must bring back the work that followed, not the link.
  history.replaceState(null, '', location.pathname + location.search);
  return openNamed(async () => {
    if (project !== undefined) {
      await opener.openOwn(project);
      return;
    }
    if (hash === '#shared') {
      const { sharedFiles } = await import('../files/handed.js');
      await studio.open(await sharedFiles());
      return;
    }
    const linked = await (await import('../plates/links.js')).plateOfLink(hash);
    if (linked === undefined) return;
    show(onOwnPrinter(linked.plate, await ownPrinter(kept)));
    studio.notify(`${t('link.opened')} ${linked.told}`.trim());
  });
}

/** Whether what was made of files has been undone, or something of another kind stands in its place. */
const isGone = ({ before, made }: OpenedFiles, plate: Plate): boolean =>
  store.steps.future.includes(made) ||
  (made.directions !== before.directions && made.directions.kind !== plate.directions.kind) ||
  (made.shape !== before.shape && made.shape.kind === 'file' && plate.shape.kind !== 'file');

let held = false;

/** What came from somewhere else waits until it has been made. */
function keep(state: Pick<State, 'plate' | 'result'>, before: Plate, changes: boolean): void {
  const may = untried.mayKeep(state, before);
  if (may && (changes || held)) autosave?.save(store.steps);
  held = !may;
}

function keepUp(): void {
  store.subscribe((state, before) => {
    if (state.theme !== before.theme) applyTheme(state.theme);
    const { directions } = state.plate;
    if (directions !== before.plate.directions) {
      const lamps = directions.kind === 'lamp' ? directions.pictures.length : 0;
      if (lamps > 0 && state.tool !== 'pan') store.set({ tool: 'pan' });
      if (state.lamp >= Math.max(1, lamps)) store.set({ lamp: 0 });
      if (state.aimed !== undefined) store.set({ aimed: undefined });
      if (lamps < 2 && state.flipping) store.set({ flipping: false });
      const shown = { picture: pictureOf(state.plate, 0) !== undefined, zigzag: true, conflict: lamps > 1 };
      if (state.over !== undefined && !shown[state.over]) store.set({ over: undefined });
    }
    const arrives = state.welcome && !before.welcome; // the first plate, which is nobody's work
    const changes = state.plate !== before.plate && !arrives;
    // A plate that waited for its path is kept when that is there.
    if (changes || state.result !== before.result) keep(state, before.plate, changes);
    if (changes && state.welcome) studio.endWelcome();
    if (state.opened !== undefined && isGone(state.opened, state.plate)) studio.setOpened(undefined);
    if (state.shimmer !== undefined && (state.result !== undefined || !state.welcome))
      store.set({ shimmer: undefined });
  });
  store.subscribe((state, before) => {
    if (state.result === before.result || state.result?.measured !== true) return;
    if (!framed) picture(state.result);
    scan(state.result);
  });
  addEventListener('pagehide', () => void autosave?.flush());
  document.addEventListener('visibilitychange', () => {
    if (document.visibilityState === 'hidden') void autosave?.flush(); // phones may never say more
  });
  addEventListener('hashchange', () => void openLink());
  // What nobody caught is told, too.
  addEventListener('unhandledrejection', ({ reason }) => {
    studio.fail(problemOf(reason));
  });
}

/** Of a finished plate with a code: whether it can be read. */
function scan(result: PlateResult): void {
  const { plate } = result;
  if (result.coarse || plate.directions.kind !== 'qr') return;
  void Promise.all([import('../quality/scan.js'), engine.engine()])
    .then(async ([{ scan }, running]) => {
      const azimuths = await scan(result, running, () => store.state.result === result);
      if (azimuths !== undefined) store.set({ scan: { plate, azimuths } });
    })
    .catch(() => undefined); // nothing is claimed
}

const pictureAfter = 800; // [ms] without another plate
const pictureSide = 240; // [pixels]

/** Of a finished plate, for the list of plates. */
function picture({ toolpath, coarse }: PlateResult): void {
  if (coarse) return;
  setTimeout(() => {
    const { plate, result } = store.state; // the plate may have been renamed since
    if (result?.toolpath.cycles !== toolpath.cycles) return; // another picture follows
    void Promise.all([import('../views/miniature.js'), import('../model/filaments.js')])
      .then(async ([{ miniature }, { viewLook }]) =>
        autosave?.picture(
          plate,
          await miniature(toolpath, viewLook(plate).colour, homeLight(plate, toolpath.look), pictureSide),
        ),
      )
      .catch(() => undefined); // the list has a sign in its place
  }, pictureAfter);
}

function applyTheme(theme: Theme): void {
  if (theme === 'auto') delete document.documentElement.dataset['theme'];
  else document.documentElement.dataset['theme'] = theme;
  if (!framed) remember('theme', theme);
}

/** What a host, or the address, sets. */
async function configure({ mode, controls, units, theme, language, printer }: Partial<GuestSettings>): Promise<void> {
  store.set({
    ...(mode === undefined ? {} : { mode }),
    ...(controls === undefined ? {} : { controls }),
    ...(units === undefined ? {} : { units }),
    ...(theme === undefined ? {} : { theme }),
  });
  if (mode !== undefined || controls !== undefined) store.set({ panel: firstPanel(), tool: 'pan' });
  usePrinter(printer);
  if (language !== undefined) await speak(language);
}

function firstPanel(): string {
  if (!matchMedia('(min-width: 721px)').matches) return '';
  const { mode } = store.state;
  return mode === 'edit' ? 'directions' : mode === 'customize' ? 'own' : '';
}

let begun = false;

/** From now on plates are made. */
function begin(): void {
  if (begun) return;
  begun = true;
  pipeline.start();
}

/** @param restored  what the address names is shown, or why it is not */
async function frame(restored: Promise<void>): Promise<void> {
  const { setLacking, waitForHost } = await import('../embed/frame.js');
  const hosts = document.querySelector<HTMLMetaElement>('meta[name="sillon-hosts"]')?.content.split(/\s+/) ?? [];
  waitForHost(hosts, studio, {
    load: async (openings, trusted) => {
      await untried.during(() => opener.load(openings, trusted));
      usePrinter(asked.given.printer);
      store.forgetSteps();
    },
    begin,
    configure: async (textOf) => {
      const { given, wrong } = guestSettings(textOf, spoken);
      const [first] = wrong;
      if (first !== undefined) throw new StudioError('GuestValue', { where: first.where, value: first.value });
      asked.given = { ...asked.given, ...given };
      await configure(given);
    },
    project: () => studio.services.projectData(store.state.plate),
    finished: () => pipeline.finished(),
    make: (product) => studio.make(product),
    picture: (width) => studio.picture(width),
    video: (seconds, signal) => studio.video(seconds, signal),
    cancel: () => {
      pipeline.cancel();
    },
    onHost: async (origin) => {
      store.set({ host: origin === 'null' ? t('app.someHost') : origin });
      await restored; // what a host asks for is of that, or comes after it
      const { autosave: name } = asked.given;
      if (name === undefined || origin === 'null') return false;
      let waits = true;
      const late = elapsed(hostWaits).then(() => (waits = false));
      const kept = keeper(`${origin} ${name}`).then((made) => made.load());
      const found = await Promise.race([restoreKept(kept, () => waits), late]);
      if (found) {
        setLacking(studio, undefined);
        begin();
      }
      return found;
    },
  });
}

/** The service worker that brought the page; null: none, or none may be asked for, as in sandboxes. */
function pagesWorker(): ServiceWorker | null {
  try {
    return navigator.serviceWorker.controller;
  } catch {
    return null;
  }
}

async function start(): Promise<void> {
  const broughtBy = pagesWorker();
  const { given } = asked;
  const theme = given.theme ?? (framed ? undefined : recall('theme', ['auto', 'light', 'dark'])) ?? 'auto';
  store.set({ theme });
  applyTheme(theme);
  const language = given.language ?? (framed ? undefined : recall('language', spoken));
  await speak(language ?? languageFor(navigator.languages));
  store.set({ panel: firstPanel() });
  if (framed) await configure({ ...given, theme, language });
  else usePrinter(given.printer);
  const app = document.createElement('sillon-app');
  app.studio = studio;
  document.body.append(app);
  keepUp();
  const within = location.hash === '' ? restoreWithin : linkWithin; // restore() takes the link out of the address
  if (framed && asked.waits)
    store.set({ lacking: { code: 'BadRequest', message: 'No plate is loaded yet.', hint: '' } });
  const restored = restore();
  await Promise.race([restored, elapsed(within)]);
  if (framed) {
    void engine.engine().catch(() => undefined); // a host hears of it also where no plate follows
    // Nobody is shown or sold another plate where one is named: it is on its way, or cannot be shown.
    void restored.then(() => {
      if (!asked.waits && store.state.lacking === undefined) begin();
    });
    await frame(restored);
    return; // other pages work as they work without a network
  }
  begin();
  if ('launchQueue' in window) {
    void import('../files/handed.js').then(({ onLaunched }) => {
      onLaunched((files) => void studio.open(files), studio.handles);
    });
  }
  // What the next visit needs would take the network from what this one waits for; without threads that visit is at once.
  if (crossOriginIsolated) await Promise.race([firstPlate(), elapsed(keepsAfter)]);
  const { workOffline } = await import('./offline.js');
  void workOffline(studio, broughtBy);
}

void start();
