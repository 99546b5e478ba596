// Keeps plates: in the browser's storage while they change, and in the files that they were opened from.
import type { Autosave, Kept, KeptPrint } from '../files/autosave.js';
import { say } from '../i18n/text.js';
import { newPlateOn } from '../model/brought.js';
import { homeLight } from '../model/lamp.js';
import type { Plate } from '../model/plate.js';
import { StudioError } from '../model/problem.js';
import type { PlateResult, State } from '../model/state.js';
import { Untried } from '../model/untried.js';
import type { KeepingServices } from '../studio/services.js';
import type { Studio } from '../studio/studio.js';
import { smallLook } from '../views/plate-look.js';

const pictureAfter = 800; // [ms] without another plate
const pictureSide = 240; // [pixels]

/** The words about kept plates, which no first visit fetches. */
const plateWords = async () => (await import('../i18n/en/plates.js')).words;

export class Keeper {
  /** The studio itself has it at once, and a frame only when a host says so. */
  #autosave: Autosave | undefined;
  /** By record: the project files that plates were opened from. */
  readonly #places = new Map<string, FileSystemFileHandle>();
  /** A plate that came from somewhere else has not been made yet. */
  #held = false;
  readonly untried = new Untried();

  constructor(private readonly studio: Studio) {}

  /** From now on plates are kept. @param host  a site's origin and its name for the work; left out: the studio's own
   * @returns work of an earlier visit */
  async begin(host?: string): Promise<Kept | undefined> {
    const { studio } = this;
    const { createAutosave } = await import('../files/autosave.js');
    const made = createAutosave({
      engine: () => studio.services.engine(),
      onProblem: (problem) => {
        studio.fail(problem);
      },
      onTaken: () => {
        made.save(studio.store.steps);
        void plateWords().then((words) => {
          studio.notify(say(words, 'plates.taken'));
        });
      },
      ...(host === undefined ? {} : { host }),
    });
    made.begin(studio.store.state.plate, true);
    this.#autosave = made;
    return made.load();
  }

  /** Another plate altogether, in a record of its own; what was there can be had back by undo. */
  show = (plate: Plate, fresh = false): void => {
    const { store } = this.studio;
    store.settle();
    this.#autosave?.begin(plate, fresh);
    store.change(() => plate);
    this.studio.look();
  };

  /** Goes on in the record of a plate that was kept. */
  #goOn = (plate: Plate): void => this.#autosave?.begin(plate);

  /** @param wanted  whether it is still to be shown
   * @returns whether there was work of an earlier visit, which is shown now; what comes too late is offered instead */
  async restore(kept: Promise<Kept | undefined>, wanted: () => boolean = () => true): Promise<boolean> {
    const { studio } = this;
    const before = studio.store.state.plate;
    const found = await kept;
    if (found === undefined) return false;
    const { restore } = await import('./restore.js');
    const shows = wanted() && studio.store.state.plate === before; // else a hand was faster
    return restore(studio, found, shows, this.#goOn);
  }

  /** A plate from somewhere else waits until it has been made. @param changes  the plate is another than before */
  keep(state: Pick<State, 'plate' | 'result'>, before: Plate, changes: boolean): void {
    const may = this.untried.mayKeep(state, before);
    if (may && (changes || this.#held)) this.#autosave?.save(this.studio.store.steps);
    this.#held = !may;
  }

  /** A sliced print over the plate, which is kept with it, changed or not. */
  #keepPrint = (print: KeptPrint | undefined): void => {
    if (print !== undefined && !this.#held) this.#autosave?.save(this.studio.store.steps);
    this.#autosave?.savePrint(print);
  };

  keepWhenLeft(): void {
    addEventListener('pagehide', () => void this.#autosave?.flush());
    document.addEventListener('visibilitychange', () => {
      if (document.visibilityState === 'hidden') void this.#autosave?.flush(); // phones may never say more
    });
  }

  /** Draws a finished plate for the list of plates. */
  picture({ toolpath, coarse }: PlateResult): void {
    if (coarse) return;
    setTimeout(() => {
      const { plate, result } = this.studio.store.state; // the plate may have been renamed since
      if (result?.toolpath.cycles !== toolpath.cycles) return; // another picture follows
      void import('../views/miniature.js')
        .then(async ({ miniature }) =>
          this.#autosave?.picture(
            plate,
            await miniature(toolpath, smallLook(plate, homeLight(plate, toolpath.look)), pictureSide),
          ),
        )
        .catch(() => undefined); // the list has a sign in its place
    }, pictureAfter);
  }

  #kept(): Autosave {
    if (this.#autosave === undefined) throw new StudioError('StorageFull');
    return this.#autosave;
  }

  services(): KeepingServices {
    const { studio } = this;
    return {
      newPlate: () => {
        const { plate, own } = studio.store.state;
        this.show(own?.begin(plate.printer) ?? newPlateOn(plate.printer), true);
      },
      plates: () => this.#kept(),
      keepPrint: this.#keepPrint,
      openPlate: async (id, take) => {
        const [opened, words, { showKept }] = await Promise.all([
          this.#kept().open(id, take),
          plateWords(),
          import('./restore.js'),
        ]);
        if (opened === undefined) {
          studio.notify(say(words, 'plates.gone'));
          return;
        }
        showKept(studio, opened, this.#goOn);
        if (opened.state === 'copy') studio.notify(say(words, 'plates.copied'));
      },
      openedFrom: (project) => {
        const handle = studio.handles.get(project);
        if (handle?.kind === 'file' && /\.zip$/i.test(handle.name) && this.#autosave !== undefined)
          this.#places.set(this.#autosave.current(), handle as FileSystemFileHandle);
      },
      savedInPlace: async (project) => {
        const handle = this.#autosave && this.#places.get(this.#autosave.current());
        if (handle === undefined) return '';
        const [{ writeBack }, words] = await Promise.all([import('../files/in-place.js'), plateWords()]);
        return (await writeBack(handle, project)) ? say(words, 'plates.savedTo', { name: handle.name }) : '';
      },
      link: async (plate) => (await import('../plates/links.js')).linkOf(plate),
    };
  }
}
