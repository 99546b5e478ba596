// Puts a page together: state, engine, directions, files, and what the elements may ask for. There are two: the studio, and
// the studio as it is shown in a frame of another page.
import { languageFor, setLanguage, t, type Language } from './i18n/text.js';
import directionsWorker from './directions/directions.worker.ts?worker&url';
import { createRasteriser } from './directions/rasteriser.js';
import { loadEngine } from './engine/load.js';
import { StudioEngine } from './engine/studio-engine.js';
import { createAutosave, type Autosave } from './files/autosave.js';
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
import { recall, remember } from './remember.js';

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
    const { hash, untold } = await writeLink(plate);
    // Of the studio, also where this is its page for frames.
    return { url: new URL(`./${hash}`, document.baseURI).href, told: untoldText(untold) };
  },
  setLanguage: async (language) => {
    await speak(language);
    if (!framed) remember('language', language);
  },
  open: (files) => opener.open(files),
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
    if (notRead.length > 0) studio.notify(t('printer.notRead', { list: notRead.join('; ') }));
  },
  newPlate: () => {
    show(newPlate());
  },
  forget: async () => autosave?.forget(),
};

async function speak(language: Language): Promise<void> {
  await setLanguage(language);
  document.documentElement.lang = language;
  store.set({ language });
}

const restoreWithin = 1500; // [ms], after which the page begins with what it has; the plate may still come
const hostWaits = 10_000; // [ms] for work of an earlier visit: some browsers' storages never answer

const elapsed = (time: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, time));

/** The plate of the page's address, or the one that was left here, which is offered beside the other. */
async function restore(): Promise<void> {
  const opened = (await openLink()) || (await openAddress());
  if (!framed) await restoreKept(keeper(), () => !opened);
}

/** @param wanted  whether it is still to be shown
 * @returns whether there was work of an earlier visit, which is shown now; what comes too late is offered instead */
async function restoreKept(keeps: Autosave, wanted: () => boolean = () => true): Promise<boolean> {
  autosave = keeps;
  const before = store.state.plate;
  const plate = await keeps.load();
  if (plate === undefined) return false;
  const shows = wanted() && store.state.plate === before; // else a hand was faster
  if (shows) showKept(plate);
  else offerKept(plate);
  return shows;
}

function showKept(plate: Plate): void {
  show(plate);
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
async function openAddress(): Promise<boolean> {
  for (const { where, value } of asked.wrong) studio.fail({ code: 'GuestValue', values: { where, value }, detail: '' });
  if (asked.files.length === 0) return false;
  return studio.attempt(async () => {
    const { fetchFiles } = await import('./embed/fetching.js');
    const files = await fetchFiles(asked.files, document.baseURI).catch((error: unknown) => {
      throw new StudioError('GuestFile', {}, problemOf(error).detail);
    });
    await opener.load(files.map(({ name, bytes, role }) => ({ file: new File([bytes], name), role })));
    usePrinter(asked.given.printer);
  });
}

function usePrinter(key: PrinterKey | undefined): void {
  if (key !== undefined) store.change((plate) => withPrinter(plate, key));
}

async function openLink(): Promise<boolean> {
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
    const plate = await readLink(hash);
    if (plate === undefined) return;
    show(plate);
    studio.notify(t('link.opened'));
  });
}

function keepUp(): void {
  store.subscribe((state, before) => {
    if (state.theme !== before.theme) applyTheme(state.theme);
    if (state.plate !== before.plate) autosave?.save(state.plate);
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
    load: async (openings) => {
      try {
        await opener.load(openings);
        usePrinter(asked.given.printer);
        store.forgetSteps();
      } finally {
        begin();
      }
    },
    configure: async (textOf) => {
      const { given, wrong } = guestSettings(textOf);
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
      const restored = await Promise.race([restoreKept(keeper(`${origin} ${name}`), () => waits), late]);
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
  const language = given.language ?? (framed ? undefined : recall('language', ['en', 'fr']));
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
