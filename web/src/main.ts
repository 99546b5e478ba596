// Puts the page together: state, engine, directions, files, and what the elements may ask for.
import { languageFor, setLanguage, t, type Language } from './i18n/text.js';
import { createRasteriser } from './directions/rasteriser.js';
import { loadEngine } from './engine/load.js';
import { StudioEngine } from './engine/studio-engine.js';
import { createAutosave } from './files/autosave.js';
import { newPlate } from './model/defaults.js';
import type { Plate } from './model/plate.js';
import { problemOf, StudioError } from './model/problem.js';
import type { Theme } from './model/state.js';
import { Store } from './model/store.js';
import { createOpener } from './opening.js';
import { workOffline } from './offline.js';
import './panels/app.js';
import { newShown } from './panels/shown.js';
import { Studio } from './panels/studio.js';
import { Pipeline } from './pipeline.js';
import { recall, remember } from './remember.js';

const threads = new URLSearchParams(location.search).get('threads') === 'off' ? 'off' : 'auto';
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
const rasteriser = createRasteriser(async ({ bytes }) => (await engine.engine()).decodePicture(bytes));
const pipeline = new Pipeline(store, engine, rasteriser);
const autosave = createAutosave({
  onProblem: (problem) => {
    studio.fail(problem);
  },
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
  svg: () => pipeline.svg(),
  project: async (plate) => {
    const [{ writeProject }, raster] = await Promise.all([import('./files/project.js'), pipeline.directions()]);
    return writeProject(plate, raster);
  },
  link: async (plate) => {
    const [{ writeLink }, { untoldText }] = await Promise.all([import('./model/share.js'), import('./i18n/say.js')]);
    const { hash, untold } = await writeLink(plate);
    return { url: new URL(hash, location.href.split('#')[0]).href, told: untoldText(untold) };
  },
  setLanguage: async (language) => {
    await speak(language);
    remember('language', language);
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
  forget: () => autosave.forget(),
};

async function speak(language: Language): Promise<void> {
  await setLanguage(language);
  document.documentElement.lang = language;
  store.set({ language });
}

const restoreWithin = 1500; // [ms], after which the page begins with what it has; the plate may still come

/** The plate of the page's address, or the one that was left here. */
async function restore(): Promise<void> {
  if (await openLink()) return;
  const before = store.state.plate;
  const plate = await autosave.load();
  if (plate === undefined || store.state.plate !== before) return; // nothing was kept, or a hand was faster
  show(plate);
  studio.notify(t('restore.done'), {
    label: t('restore.discard'),
    run: () => {
      studio.services.newPlate();
    },
  });
}

async function openLink(): Promise<boolean> {
  if (!location.hash.startsWith('#plate=')) return false;
  const { hash } = location;
  // A reload must bring back the work that followed, not the link.
  history.replaceState(null, '', location.pathname + location.search);
  return studio.attempt(async () => {
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
    if (state.plate !== before.plate) autosave.save(state.plate);
  });
  addEventListener('pagehide', () => void autosave.flush());
  document.addEventListener('visibilitychange', () => {
    if (document.visibilityState === 'hidden') void autosave.flush(); // phones may never say more
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
  remember('theme', theme);
}

async function start(): Promise<void> {
  const theme = recall('theme', ['auto', 'light', 'dark']) ?? 'auto';
  store.set({ theme });
  applyTheme(theme);
  await speak(recall('language', ['en', 'fr']) ?? languageFor(navigator.languages));
  const wide = matchMedia('(min-width: 721px)').matches;
  store.set({ panel: wide ? 'directions' : '' });
  const app = document.createElement('sillon-app');
  app.studio = studio;
  document.body.append(app);
  keepUp();
  await Promise.race([restore(), new Promise((resolve) => setTimeout(resolve, restoreWithin))]);
  pipeline.start();
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
