// The studio in a frame of another page: the actions of that page, and the plate shown before its first request.
import { spoken } from '../i18n/languages.js';
import { t } from '../i18n/text.js';
import { guestSettings, type GuestSettings } from '../model/guest.js';
import { StudioError } from '../model/problem.js';
import type { Studio } from '../studio/studio.js';
import { asked } from './address.js';
import { elapsed, usePrinter } from './arriving.js';
import type { Keeper } from './keeping.js';
import type { Opener } from './opening.js';
import type { Pipeline } from './pipeline.js';

const hostWaits = 10_000; // [ms] for work of an earlier visit: some browsers' storage never answers

interface Framing {
  studio: Studio;
  keeper: Keeper;
  opener: Opener;
  pipeline: Pipeline;
}

/** Connects the studio to its host.
 * @param arrived  resolves when the plate that the address names is shown, or has failed */
export async function frame({ studio, keeper, opener, pipeline }: Framing, arrived: Promise<void>): Promise<void> {
  const { store } = studio;
  let begun = false;
  const begin = (): void => {
    if (!begun) pipeline.start();
    begun = true;
  };
  studio.services.engine().catch(() => undefined); // a host hears of the engine even if no plate follows
  // If a plate is named, no other one may be shown or sold: the named plate is on its way, or cannot be shown.
  void arrived.then(() => {
    if (!asked.waits && store.state.lacking === undefined) begin();
  });
  const { setLacking, waitForHost } = await import('../embed/frame.js');
  const hosts = document.querySelector<HTMLMetaElement>('meta[name="sillon-hosts"]')?.content.split(/\s+/) ?? [];
  waitForHost(hosts, studio, {
    load: async (openings, trusted) => {
      await keeper.untried.during(() => opener.load(openings, trusted));
      usePrinter(studio);
      store.forgetSteps();
    },
    begin,
    configure: (textOf) => configureAsHost(studio, textOf),
    finished: () => pipeline.finished(),
    onHost: async (origin) => {
      store.set({ host: origin === 'null' ? t('app.someHost') : origin });
      await arrived; // a host's requests concern that plate, or come after it
      const { autosave: name } = asked.given;
      if (name === undefined || origin === 'null') return false;
      let waits = true;
      const late = elapsed(hostWaits).then(() => (waits = false));
      const found = await Promise.race([keeper.restore(keeper.begin(`${origin} ${name}`), () => waits), late]);
      if (found) {
        setLacking(studio, undefined);
        begin();
      }
      return found;
    },
  });
}

/** Applies settings of the address, or of the page around this one. */
export async function configure(
  studio: Studio,
  { mode, controls, units, theme, language, printer }: Partial<GuestSettings>,
): Promise<void> {
  const { store } = studio;
  store.set({
    ...(mode === undefined ? {} : { mode }),
    ...(controls === undefined ? {} : { controls }),
    ...(units === undefined ? {} : { units }),
    ...(theme === undefined ? {} : { theme }),
  });
  if (mode !== undefined || controls !== undefined) store.set({ panel: studio.firstPanel(), tool: 'pan' });
  usePrinter(studio, printer);
  if (language !== undefined) await studio.speak(language);
}

/** Applies settings of the host. @param textOf  the host's value of an attribute @throws StudioError GuestValue */
async function configureAsHost(studio: Studio, textOf: (attribute: string) => unknown): Promise<void> {
  const { given, wrong } = guestSettings(textOf, spoken);
  const [first] = wrong;
  if (first !== undefined) throw new StudioError('GuestValue', { where: first.where, value: first.value });
  asked.given = { ...asked.given, ...given };
  await configure(studio, given);
}
