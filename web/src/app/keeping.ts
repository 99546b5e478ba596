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

const pictureAfter = 800; // [ms] without a new plate, after which its picture is drawn
const pictureSide = 240; // [pixels]

/** Loads the words about kept plates, which no first visit needs. */
const plateWords = async () => (await import('../i18n/en/plates.js')).words;

export class Keeper {
  /** Storage of plates: the studio has it from the beginning, a frame only if its host asks for it. */
  #autosave: Autosave | undefined;
  /** Project files that plates were opened from, by record. */
  readonly #places = new Map<string, FileSystemFileHandle>();
  /** A plate from elsewhere has not been made yet. */
  #held = false;
  readonly untried = new Untried();

  constructor(private readonly studio: Studio) {}

  /** Begins to keep plates.
   * @param host  origin of a site, and its name for the work; left out: the studio's own storage
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
        void plateWords().then((words) => studio.notify(say(words, 'plates.taken')));
      },
      ...(host === undefined ? {} : { host }),
    });
    made.begin(studio.store.state.plate, true);
    this.#autosave = made;
    return made.load();
  }

  /** Shows another plate, in a record of its own; undo brings the previous one back. */
  show = (plate: Plate, fresh = false): void => {
    const { store } = this.studio;
    store.settle();
    this.#autosave?.begin(plate, fresh);
    store.change(() => plate);
    this.studio.look();
  };

  /** Continues the record of a plate that was kept. */
  #goOn = (plate: Plate): void => this.#autosave?.begin(plate);

  /** Shows work of an earlier visit; if it comes too late, it is offered.
   * @param wanted  tells whether to show it still
   * @returns true if there was such work and it is shown */
  async restore(kept: Promise<Kept | undefined>, wanted: () => boolean = () => true): Promise<boolean> {
    const { studio } = this;
    const before = studio.store.state.plate;
    const found = await kept;
    if (found === undefined) return false;
    const { restore } = await import('./restore.js');
    const shows = wanted() && studio.store.state.plate === before; // otherwise the user has already changed the plate
    return restore(studio, found, shows, this.#goOn);
  }

  /** Keeps the plate; one from elsewhere is kept only once it has been made. @param changes  the plate has changed */
  keep(state: Pick<State, 'plate' | 'result'>, before: Plate, changes: boolean): void {
    const may = this.untried.mayKeep(state, before);
    if (may && (changes || this.#held)) this.#autosave?.save(this.studio.store.steps);
    this.#held = !may;
  }

  /** Keeps a sliced print with the plate, even if the plate has not changed. */
  #keepPrint = (print: KeptPrint | undefined): void => {
    if (print !== undefined && !this.#held) this.#autosave?.save(this.studio.store.steps);
    this.#autosave?.savePrint(print);
  };

  keepWhenLeft(): void {
    addEventListener('pagehide', () => void this.#autosave?.flush());
    document.addEventListener('visibilitychange', () => {
      if (document.visibilityState === 'hidden') void this.#autosave?.flush(); // on phones, this may be the last event
    });
  }

  /** Draws a finished plate for the list of plates. */
  picture({ toolpath, coarse }: PlateResult): void {
    if (coarse) return;
    setTimeout(() => {
      const { plate, result } = this.studio.store.state; // the plate may have been renamed since
      if (result?.toolpath.cycles !== toolpath.cycles) return; // a newer picture follows
      void import('../views/miniature.js')
        .then(async ({ miniature }) =>
          this.#autosave?.picture(
            plate,
            await miniature(toolpath, smallLook(plate, homeLight(plate, toolpath.look)), pictureSide),
          ),
        )
        .catch(() => undefined); // the list shows an icon instead
    }, pictureAfter);
  }

  #kept(): Autosave {
    if (this.#autosave === undefined) throw new StudioError('StorageFull');
    return this.#autosave;
  }

  /** Returns the services of keeping plates. */
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
