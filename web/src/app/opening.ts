// Makes plates of files and examples: the role of each file is guessed, used at once, and can be changed afterwards.
import type { PrinterValues } from 'sillon';
import { t } from '../i18n/text.js';
import { newPlateOn, onOwnPrinter } from '../model/brought.js';
import { newFileShape } from '../model/defaults.js';
import { filledWith, groundPictures } from '../model/fills.js';
import { withFilament } from '../model/filaments.js';
import { homeLight } from '../model/lamp.js';
import { newPlate } from '../model/new-plate.js';
import { isExample, ofExample, type Plate, type ShapeSource, type SourceFile } from '../model/plate.js';
import { StudioError, type Problem } from '../model/problem.js';
import type { Example } from '../model/example.js';
import type { Opened, Opening, Role } from '../model/file-role.js';
import type { OpeningServices } from '../studio/services.js';
import { offers } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';
import type { Keeper } from './keeping.js';

export interface Opener extends OpeningServices {
  /** Returns the plate that a first visit sees. @throws StudioError LoadFailed */
  first(): Promise<Plate>;
  /** Opens a project that lies beside the page. @throws StudioError LoadFailed; errors of `open` */
  openOwn(path: string): Promise<void>;
  /** Shows another plate, made of these files alone. @param trusted  a project's own printer may be used */
  load(openings: readonly Opening[], trusted?: boolean): Promise<void>;
}

const gesture = 'files';

/** Creates the services that open files, projects and examples. */
export function createOpener(studio: Studio, { show, untried }: Keeper): Opener {
  const engine = () => studio.services.engine();
  const own = (): PrinterValues => {
    const { plate, own } = studio.store.state;
    return (own?.on(plate) ?? plate).printer;
  };

  /** Puts files into the plate.
   * @param without  returns the plate without earlier files
   * @param step  reports progress of the work */
  async function use(
    without: (plate: Plate) => Plate,
    files: readonly Opened[],
    step: (work: Promise<Plate>) => Promise<Plate> = (work) => work,
  ): Promise<void> {
    const { withFiles } = await import('../files/open.js');
    const tell = (problem: Problem): void => {
      studio.fail(problem);
    };
    let from, before, made: Plate;
    do {
      const { plate, light, lightMode, result } = studio.store.state;
      from = plate;
      before = without(plate);
      // The lamp is the light on the screen: where the user has put it, or where it returns to.
      const lamp = lightMode === 'fixed' ? light : homeLight(before, result?.toolpath.look);
      made = await step(withFiles(before, files, await engine(), tell, lamp));
    } while (studio.store.state.plate !== from); // changes that the user makes in the meantime are kept
    // All changes of roles form one step of undo.
    studio.store.change(() => made, gesture);
    studio.setOpened({ before, made, files });
    studio.stage?.fit();
  }

  /** Reads files and uses them. @param stop  ends the reading; the plate then stays as it was */
  async function read(files: readonly File[], role: Role | undefined, stop: AbortController): Promise<void> {
    const { signal } = stop;
    const stopped = new Promise<never>((_, reject) =>
      signal.addEventListener('abort', () => {
        reject(signal.reason as Error);
      }),
    );
    stopped.catch(() => undefined);
    const name = files[0]?.name ?? '';
    /** Runs one step after the other and reports each; after a stop, no further step begins. */
    const step = <Result>(fraction: number, work: Promise<Result>): Promise<Result> => {
      signal.throwIfAborted();
      const cancel = (): void => stop.abort();
      studio.store.set({ reading: { name, fraction, cancel } });
      return Promise.race([work, stopped]);
    };
    const { identify, isFont, onePrint } = await step(0.05, import('../files/open.js'));
    const { mode, host } = studio.store.state;
    const [sliced] = files;
    // A sliced print or a body is opened only on the studio's own
    // page: in a frame, it would not concern the host's page.
    const theirs = role === undefined && mode === 'edit' && host === '';
    const print = theirs ? await step(0.1, onePrint(files)) : '';
    if (sliced !== undefined && print !== '') {
      studio.store.set({ sliced, dialog: print === 'sliced' ? 'rebrush' : 'zones' });
      return;
    }
    const fonts = role === undefined && offers(studio.store.state, 'layers') ? files.filter(isFont) : [];
    if (fonts.length > 0) {
      // Only layers can have letters of their own.
      await (await import('../layers/add-layer.js')).addFiles(studio, fonts);
      studio.setPanel('layers');
      if (fonts.length === files.length) return;
    }
    const others = files.filter((file) => !fonts.includes(file));
    const found = await step(
      0.4,
      engine().then((running) => identify(others, withoutExample(studio.store.state.plate), running)),
    );
    for (const problem of found.refused) studio.fail(problem);
    if (found.project !== undefined) {
      show(onOwnPrinter(found.project, own()));
      if (sliced !== undefined && files.length === 1) studio.services.openedFrom(sliced);
      return;
    }
    studio.store.settle();
    if (role !== undefined) {
      const means = role === 'shape' ? [role, 'mask' as const] : [role];
      found.opened = found.opened.map((one) => ({
        ...one,
        role: means.find((each) => one.roles.includes(each)) ?? one.role,
      }));
    }
    await use(withoutExample, found.opened, (work) => step(0.7, work));
    if (found.opened.length > 1) {
      studio.show('files');
      return;
    }
    const [only] = found.opened;
    if (only !== undefined) await (await import('./tell-opened.js')).tellOpened(studio, only);
  }

  const opener: Opener = {
    async open(files, role) {
      const stop = new AbortController();
      try {
        await untried.during(() => read(files, role, stop));
      } finally {
        studio.store.set({ reading: undefined });
      }
    },

    async setRole(index, role) {
      const { opened } = studio.store.state;
      if (opened === undefined) return;
      const { withoutFiles } = await import('../files/open.js');
      const files = opened.files.map((file, k) => (k === index ? { ...file, role } : file));
      await untried.during(() => use((plate) => withoutFiles(plate, opened), files));
    },

    async load(openings, trusted = false) {
      const { identify, withFiles } = await import('../files/open.js');
      const plate = trusted ? newPlate() : newPlateOn(own());
      const files = openings.map(({ file }) => file);
      const found = await identify(files, plate, await engine());
      const [wrong] = found.refused;
      if (wrong !== undefined) throw wrong; // a surrounding page wants all of its files
      const opened = found.opened.map((one, k) => ({ ...one, role: asked(one, openings[k]?.role ?? '') }));
      const project = found.project === undefined || trusted ? found.project : onOwnPrinter(found.project, own());
      show(project ?? (await withFiles(plate, opened, await engine())));
      studio.store.forgetSteps();
    },

    async openExample(example) {
      show(await plateOf(example, studio), true);
    },

    openMade(make) {
      show(make(newPlateOn(own())));
    },

    async first() {
      const { opening } = await import('../plates/examples.js');
      return plateOf(opening, studio);
    },

    async openOwn(path) {
      await opener.open([new File([await fetchedBytes(path)], path.replace(/^.*\//, ''))]);
    },
  };
  return opener;
}

/** Removes an example's picture, which would otherwise stay beside the user's own, under a lamp of its own. */
function withoutExample(plate: Plate): Plate {
  const pictures = groundPictures(plate);
  const example = pictures.length > 0 && pictures.every(({ file }) => isExample(file));
  return example ? { ...filledWith(plate, 'waves'), name: '' } : plate;
}

/** Returns the role that a file gets.
 * @param wanted  role of its `Opening`
 * @throws StudioError GuestValue if the file cannot have it */
function asked({ source, role, roles }: Opened, wanted: string): Role {
  if (wanted === '') return role;
  const directions: readonly Role[] = ['lamp', 'tone', 'edges', 'levels', 'colours', 'angle', 'rotation', 'tangent'];
  const means: Record<string, readonly Role[]> = { shape: ['shape', 'mask'], image: [role, ...directions] };
  const possible = Object.hasOwn(means, wanted) ? (means[wanted] ?? []) : roles.filter((one) => one === wanted);
  const found = possible.find((one) => roles.includes(one) && (wanted !== 'image' || directions.includes(one)));
  if (found === undefined) throw new StudioError('GuestValue', { where: source.name, value: wanted });
  return found;
}

/** Loads a file that lies beside the page. @throws StudioError LoadFailed */
async function fetchedBytes(path: string): Promise<Blob> {
  try {
    const response = await fetch(new URL(path, document.baseURI));
    if (!response.ok) throw new Error(`status ${response.status}`);
    return await response.blob();
  } catch (error) {
    throw new StudioError('LoadFailed', {}, `${path}: ${String(error)}`);
  }
}

const fetched = async (name: string): Promise<SourceFile> => ({
  id: ofExample + name,
  name,
  bytes: await fetchedBytes(`examples/${name}`),
});

/** Makes the plate of an example, on the visitor's printer, and with the visitor's filament if one was named: the
 * example's own only serves its look. */
async function plateOf(example: Example, studio: Studio): Promise<Plate> {
  const { width, height, filament, nearest } = example;
  const shape: ShapeSource =
    typeof example.shape === 'string' ? newFileShape(await fetched(example.shape)) : example.shape;
  const layers = await (await import('./example-layers.js')).layersFor(example.layers, fetched);
  const {
    own,
    plate: { printer },
  } = studio.store.state;
  const plate = own?.begin(printer) ?? newPlateOn(printer);
  const made: Plate = {
    ...plate,
    name: t(`example.${example.id}`),
    shape,
    width,
    height,
    layers,
    toolpath: { ...plate.toolpath, mapFilter: nearest === true ? 'nearest' : 'average' },
  };
  return own?.said.spool === undefined ? withFilament(made, filament) : made;
}
