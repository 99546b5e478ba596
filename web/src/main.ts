// Puts a page together: state, engine, directions, files, and what the elements may ask for. There are two: the studio, and
// the studio as it is shown in a frame of another page.
import { spoken } from './i18n/languages.js';
import { languageFor, setLanguage, t } from './i18n/text.js';
import directionsWorker from './directions/directions.worker.ts?worker&url';
import { createRasteriser } from './directions/rasteriser.js';
import { loadEngine } from './engine/load.js';
import { StudioEngine } from './engine/studio-engine.js';
import { createAutosave, type Autosave } from './files/autosave.js';
import type { PrinterValues } from 'sillon';
import { onOwnPrinter, withoutBrought } from './model/brought.js';
import { newPlate } from './model/defaults.js';
import type { Plate } from './model/plate.js';
import { problemOf, StudioError } from './model/problem.js';
import { addressed } from './embed/address.js';
import { guestSettings, type GuestSettings } from './model/guest.js';
import { withPrinter, type PrinterKey } from './model/printers.js';
import type { Theme } from './model/state.js';
import { Store } from './model/store.js';
import { createOpener } from './opening.js';
import { workOffline } from './offline.js';
import './panels/app.js';
import { newShown } from './panels/shown.js';
import { Studio } from './panels/studio.js';
import { Pipeline } from './pipeline.js';
import { startWorker } from './start-worker.js';
import marksWorker from './views/marks.worker.ts?worker&url';
import { recall, recallText, remember } from './remember.js';

/** Whether this is the page for frames of others. */
const framed = document.documentElement.dataset['page'] === 'frame';
const asked = addressed(location.search);
const threads = asked.given.threads ?? 'auto';
const store = new Store(newShown());
const studio = new Studio(store, threads);

const engine = new StudioEngine(
  { load: () => loadEngine(threads), now: () => performance.now() },
  {
    onMade: (made) => {
      pipeline.onMade(made);
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
  async ({ bytes }) => (await engine.engine()).decodePicture(bytes),
  () => startWorker(directionsWorker, 'directions'),
);
const pipeline = new Pipeline(store, engine, rasteriser, () => startWorker(marksWorker, 'marks'));
/** Of the studio itself at once; in a frame none until a host says so. */
let autosave: Autosave | undefined;

const keeper = (host?: string): Autosave =>
  createAutosave({
    onProblem: (problem) => {
      studio.fail(problem);
    },
    ...(host === undefined ? {} : { host }),
  });

/** What of printers was seen before a file was taken with it, as `toReview` has it. */
const reviewed = new Set<string>();

/** Another plate altogether; what was there can be had back by undo. */
function show(plate: Plate): void {
  store.settle();
  store.change(() => plate);
  store.set({ mark: -1, played: 1, playing: false, tool: 'pan' });
  studio.stage?.fit();
}

const opener = createOpener(studio, () => engine.engine(), show);

studio.services = {
  cancel: () => {
    pipeline.cancel();
  },
  retry: () => {
    pipeline.retry();
  },
  gcode: () => pipeline.gcode(),
  pack: async (gcode) => (await engine.engine()).packGcode(gcode),
  body: () => pipeline.body(),
  svg: () => pipeline.svg(),
  view: () => pipeline.view(),
  project: async (plate) => {
    const [{ writeProject }, raster] = await Promise.all([import('./files/project.js'), pipeline.directions()]);
    return writeProject(plate, raster);
  },
  projectData: async (plate) => {
    const [{ projectData }, raster] = await Promise.all([import('./files/project.js'), pipeline.directions()]);
    return projectData(plate, raster);
  },
  link: async (plate) => {
    const [{ writeLink }, { untoldText }] = await Promise.all([import('./model/share.js'), import('./i18n/say.js')]);
    const { hash, untold } = await writeLink(plate, async (file, most) =>
      (await import('./files/shrink.js')).shrunk(file, most),
    );
    // Of the studio, also where this is its page for frames.
    return { url: new URL(`./${hash}`, document.baseURI).href, told: untoldText(untold) };
  },
  setLanguage: async (language) => {
    await speak(language);
    if (!framed) remember('language', language);
  },
  open: (files, role) => opener.open(files, role),
  setRole: (index, role) => opener.setRole(index, role),
  openExample: (example) => opener.openExample(example),
  importPrinter: async (file) => {
    const running = await engine.engine();
    const { printer, read, notRead } = await running.importPrinter(file).catch((error: unknown) => {
      const { code, detail } = problemOf(error);
      throw code === 'InvalidFile' ? new StudioError('PrinterFile', { name: file.name }, detail) : error;
    });
    store.settle();
    store.change((plate) => ({ ...plate, printer }));
    studio.notify(t('printer.imported', { name: file.name, n: read.length }));
    if (notRead.length === 0) return;
    const { importNoteText } = await import('./i18n/say.js');
    studio.notify(t('printer.notRead', { list: notRead.map(importNoteText).join(' ') }));
  },
  newPlate: () => {
    show(newPlate());
  },
  welcomed: () => {
    remember('welcomed', 'yes');
  },
  forget: async () => autosave?.forget(),
  reviewed: (text) => reviewed.has(text) || (!framed && recallText('reviewed') === text),
  setReviewed: (text) => {
    reviewed.add(text);
    if (!framed) remember('reviewed', text);
  },
  engine: () => engine.engine(),
  directions: () => pipeline.directions(),
  examine: async (block, flavor) => (await engine.engine()).examineBlock(block, flavor),
};

async function speak(language: string): Promise<void> {
  await setLanguage(language);
  document.documentElement.lang = language;
  store.set({ language });
}

const restoreWithin = 1500; // [ms], after which the page begins with what it has; the plate may still come
const hostWaits = 10_000; // [ms] for work of an earlier visit: some browsers' storages never answer

const elapsed = (time: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, time));

/** The plate of the page's address, or the one that was left here, which is offered beside the other. */
async function restore(): Promise<void> {
  if (framed) {
    if (!(await openLink())) await openAddress();
    return;
  }
  const first = store.state.plate;
  autosave = keeper();
  const kept = autosave.load();
  const opened = (await openLink(kept)) || (await openAddress(kept));
  const restored = await restoreKept(kept, () => !opened);
  if (!opened && !restored && store.state.plate === first && recallText('welcomed') === undefined) {
    store.set({ welcome: true });
  }
}

/** Of the work that was left here, which may still be on its way. */
async function ownPrinter(kept: Promise<Plate | undefined> | undefined): Promise<PrinterValues> {
  const plate = await Promise.race([kept, elapsed(restoreWithin)]);
  return (plate ?? store.state.plate).printer;
}

/** @param wanted  whether it is still to be shown
 * @returns whether there was work of an earlier visit, which is shown now; what comes too late is offered instead */
async function restoreKept(kept: Promise<Plate | undefined>, wanted: () => boolean = () => true): Promise<boolean> {
  const before = store.state.plate;
  const plate = await kept;
  if (plate === undefined) return false;
  const shows = wanted() && store.state.plate === before; // else a hand was faster
  if (shows) showKept(plate);
  else offerKept(plate);
  return shows;
}

function showKept(plate: Plate): void {
  show(plate);
  store.forgetSteps(); // undone, it would be gone for the plate that a first visit shows
  studio.notify(t('restore.done'), {
    label: t('restore.discard'),
    run: () => {
      studio.services.newPlate();
    },
  });
}

/** One step of undo brings it, too: it is not kept any more once the plate that is shown has changed. */
function offerKept(plate: Plate): void {
  const { plate: shown } = store.state;
  store.settle();
  store.change(() => plate);
  store.change(() => shown);
  studio.notify(t('restore.late'), {
    label: t('restore.show'),
    run: () => {
      show(plate);
    },
  });
}

/** Of the files that the address names, on this page's own site. */
async function openAddress(kept?: Promise<Plate | undefined>): Promise<boolean> {
  for (const { where, value } of asked.wrong) studio.fail({ code: 'GuestValue', values: { where, value }, detail: '' });
  if (asked.files.length === 0) return false;
  return studio.attempt(async () => {
    const { fetchFiles } = await import('./embed/fetching.js');
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

async function openLink(kept?: Promise<Plate | undefined>): Promise<boolean> {
  const { hash } = location;
  // Projects of the site's own gallery, and nothing else.
  const project = /^#open=(gallery\/\w+\.zip)$/.exec(hash)?.[1];
  if (project === undefined && !hash.startsWith('#plate=')) return false;
  // A reload must bring back the work that followed, not the link.
  history.replaceState(null, '', location.pathname + location.search);
  return studio.attempt(async () => {
    if (project !== undefined) {
      await opener.openOwn(project);
      return;
    }
    const { readLink } = await import('./model/share.js');
    const plate = await readLink(hash, async (name, bytes) =>
      (await import('./files/source-file.js')).sourceFile(name, bytes),
    );
    if (plate === undefined) return;
    show(onOwnPrinter(plate, await ownPrinter(kept)));
    studio.notify(t('link.opened'));
  });
}

function keepUp(): void {
  store.subscribe((state, before) => {
    if (state.theme !== before.theme) applyTheme(state.theme);
    const { directions } = state.plate;
    if (directions !== before.plate.directions) {
      const lamps = directions.kind === 'lamp' ? directions.pictures.length : 0;
      if (lamps > 0 && state.tool !== 'pan') store.set({ tool: 'pan' });
      if (state.lamp >= Math.max(1, lamps)) store.set({ lamp: 0 });
      if (lamps < 2 && state.flipping) store.set({ flipping: false });
      if (lamps === 0 && state.wipe > 0) store.set({ wipe: 0 });
    }
    if (state.plate !== before.plate) {
      autosave?.save(state.plate);
      if (state.welcome) studio.endWelcome();
    }
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

async function frame(): Promise<void> {
  const { waitForHost } = await import('./embed/frame.js');
  const hosts = document.querySelector<HTMLMetaElement>('meta[name="sillon-hosts"]')?.content.split(/\s+/) ?? [];
  waitForHost(hosts, studio, {
    load: async (openings, trusted) => {
      try {
        await opener.load(openings, trusted);
        usePrinter(asked.given.printer);
        store.forgetSteps();
      } finally {
        begin();
      }
    },
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
    video: (seconds) => studio.video(seconds),
    cancel: () => {
      pipeline.cancel();
    },
    onHost: async (origin) => {
      store.set({ host: origin === 'null' ? t('app.someHost') : origin });
      const { autosave: name } = asked.given;
      if (name === undefined || origin === 'null') return false;
      let waits = true;
      const late = elapsed(hostWaits).then(() => (waits = false));
      autosave = keeper(`${origin} ${name}`);
      const restored = await Promise.race([restoreKept(autosave.load(), () => waits), late]);
      if (restored) begin();
      return restored;
    },
  });
}

async function start(): Promise<void> {
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
  await Promise.race([restore(), elapsed(restoreWithin)]);
  // Nobody wants to see another plate first, nor its figures, where the host's is on its way.
  if (framed && asked.waits) void elapsed(hostWaits).then(begin);
  else begin();
  if (framed) {
    await frame();
    return; // other pages work as they work without a network
  }
  void workOffline({
    onReady: () => {
      studio.notify(t('offline.ready'));
    },
    onUpdate: (apply) => {
      studio.notify(t('offline.update'), { label: t('verb.reload'), run: apply });
    },
    mayReload: () => !store.canUndo,
  });
}

void start();
