// Assembles a page. There are two: the studio, and the studio in a frame of another page.
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

const linkWithin = 10_000; // [ms] for a link: nobody who follows one wants to see another plate first
const keepsAfter = 60_000; // [ms] to wait for the first plate, since some plates cannot be made

addEventListener('vite:preloadError', ({ payload }) => markUnfetched(payload));

/** First picture of a first visit; requested before anything else. */
const shimmer = firstVisit
  ? import('./shimmer.js').then(({ loadShimmer }) => loadShimmer()).catch(() => undefined) // beads replace it soon
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

/** Returns the service worker that served the page; null: there is none, or access is forbidden, as in sandboxes. */
function pagesWorker(): ServiceWorker | null {
  try {
    return navigator.serviceWorker.controller;
  } catch {
    return null;
  }
}

/** Resolves once the first plate is made. */
const firstPlate = (): Promise<void> =>
  new Promise((resolve) => {
    const end = store.subscribe(({ result }) => {
      if (result === undefined) return;
      end();
      resolve();
    });
  });

/** Sets language and theme of the page, from its address or as they were left. */
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

/** Starts everything that follows the state. */
function listen(): void {
  followState(studio, keeper);
  keeper.keepWhenLeft();
  addEventListener('hashchange', () => void openLink(page));
  // Errors that no handler caught are reported, too.
  addEventListener('unhandledrejection', ({ reason }) => {
    studio.fail(problemOf(reason));
  });
}

/** Starts the page: its elements, its plate, the pipeline, and last the service worker. */
async function start(): Promise<void> {
  const broughtBy = pagesWorker();
  await dress();
  const app = document.createElement('sillon-app');
  app.studio = studio;
  document.body.append(app);
  listen();
  const within = location.hash === '' ? restoreWithin : linkWithin; // arrive() removes the link from the address
  if (framed && asked.waits)
    store.set({ lacking: { code: 'BadRequest', message: 'No plate is loaded yet.', hint: '' } });
  const arrived = arrive(page);
  await Promise.race([arrived, elapsed(within)]);
  if (framed) {
    await (await loadFraming()).frame(page, arrived);
    return; // the page around the frame is responsible for working without a network
  }
  pipeline.start();
  if ('launchQueue' in window) {
    void import('../files/handed.js').then(({ onLaunched }) =>
      onLaunched((files) => void studio.open(files), studio.handles),
    );
  }
  // Files for the next visit would compete for the network with this one. Without threads there is no wait, since the
  // page is then loaded again at once.
  if (crossOriginIsolated) await Promise.race([firstPlate(), elapsed(keepsAfter)]);
  const [{ workOffline }, { followSheet }] = await Promise.all([import('./offline.js'), import('./sheet.js')]);
  followSheet(studio);
  void workOffline(studio, broughtBy);
}

void start();
