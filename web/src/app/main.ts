// Puts a page together. There are two: the studio, and the studio as it is shown in a frame of another page.
import { recall } from '../files/remember.js';
import { spoken } from '../i18n/languages.js';
import { languageFor } from '../i18n/text.js';
import { markUnfetched, problemOf } from '../model/problem.js';
import { Store } from '../model/store.js';
import { newShown } from '../studio/shown.js';
import { Studio } from '../studio/studio.js';
import { asked, firstVisit, framed, threads } from './address.js';
import './app.js';
import { arrive, elapsed, openLink, restoreWithin, useOwnPrint, usePrinter } from './arriving.js';
import { applyTheme, followState } from './following.js';
import { Keeper } from './keeping.js';
import { createMaking } from './making.js';
import { createOpener } from './opening.js';

const linkWithin = 10_000; // [ms], as nobody who follows a link wants to see another plate first
const keepsAfter = 60_000; // [ms]; some plates cannot be made

addEventListener('vite:preloadError', ({ payload }) => {
  markUnfetched(payload);
});

/** Of what a first visit sees first; asked for before anything else. */
const shimmer = firstVisit
  ? import('./shimmer.js').then(({ loadShimmer }) => loadShimmer()).catch(() => undefined) // the beads will be there soon
  : undefined;
const studio = new Studio(new Store(newShown()), threads, framed);
const { store } = studio;
const { pipeline, making } = createMaking(studio, () => Promise.race([shimmer, elapsed(restoreWithin)]));
const keeper = new Keeper(studio);
const opener = createOpener(studio, keeper);
const page = { studio, keeper, opener, pipeline, shimmer };
const pictures = () => import('./own-pictures.js');
const loadFraming = () => import('./framing.js');

studio.services = {
  ...making,
  ...opener,
  ...keeper.services(),
  fillPictures: async (plate, wanted) => {
    const [{ fillPictures }, engine] = await Promise.all([pictures(), making.engine()]);
    return fillPictures(plate, store.state.lamp, studio.left, engine, wanted);
  },
  shapePictures: async (plate, wanted) => {
    const [{ shapePictures }, engine] = await Promise.all([pictures(), making.engine()]);
    return shapePictures(plate, store.state.lamp, engine, wanted);
  },
};

/** The service worker that brought the page; null: none, or none may be asked for, as in sandboxes. */
function pagesWorker(): ServiceWorker | null {
  try {
    return navigator.serviceWorker.controller;
  } catch {
    return null;
  }
}

const firstPlate = (): Promise<void> =>
  new Promise((resolve) => {
    const end = store.subscribe(({ result }) => {
      if (result === undefined) return;
      end();
      resolve();
    });
  });

/** The words and the look of the page, as it was asked for or as they were left. */
async function dress(): Promise<void> {
  const { given } = asked;
  const theme = given.theme ?? (framed ? undefined : recall('theme', ['auto', 'light', 'dark'])) ?? 'auto';
  store.set({ theme });
  applyTheme(studio, theme);
  const language = given.language ?? (framed ? undefined : recall('language', spoken));
  await studio.speak(language ?? languageFor(navigator.languages));
  store.set({ panel: studio.firstPanel() });
  if (framed) await (await loadFraming()).configure(studio, { ...given, theme, language });
  else {
    await useOwnPrint(studio);
    usePrinter(studio);
  }
}

function listen(): void {
  followState(studio, keeper);
  keeper.keepWhenLeft();
  addEventListener('hashchange', () => void openLink(page));
  // What nobody caught is told, too.
  addEventListener('unhandledrejection', ({ reason }) => {
    studio.fail(problemOf(reason));
  });
}

async function start(): Promise<void> {
  const broughtBy = pagesWorker();
  await dress();
  const app = document.createElement('sillon-app');
  app.studio = studio;
  document.body.append(app);
  listen();
  const within = location.hash === '' ? restoreWithin : linkWithin; // arrive() takes the link out of the address
  if (framed && asked.waits)
    store.set({ lacking: { code: 'BadRequest', message: 'No plate is loaded yet.', hint: '' } });
  const arrived = arrive(page);
  await Promise.race([arrived, elapsed(within)]);
  if (framed) {
    await (await loadFraming()).frame(page, arrived);
    return; // other pages work as they work without a network
  }
  pipeline.start();
  if ('launchQueue' in window) {
    void import('../files/handed.js').then(({ onLaunched }) => {
      onLaunched((files) => void studio.open(files), studio.handles);
    });
  }
  // What the next visit needs would take the network from what this one waits for; without threads that visit is at once.
  if (crossOriginIsolated) await Promise.race([firstPlate(), elapsed(keepsAfter)]);
  const [{ workOffline }, { followSheet }] = await Promise.all([import('./offline.js'), import('./sheet.js')]);
  followSheet(studio);
  void workOffline(studio, broughtBy);
}

void start();
