// Files and examples become plates: what each file is for is guessed, used at once, and can be changed afterwards.
import type { Engine } from 'sillon';
import { t } from './i18n/text.js';
import { newPlate } from './model/defaults.js';
import { withFilament } from './model/filaments.js';
import type { Plate, ShapeSource, SourceFile } from './model/plate.js';
import { StudioError } from './model/problem.js';
import type { Example } from './panels/examples.js';
import type { Opened, Role } from './panels/shown.js';
import type { Studio } from './panels/studio.js';

/** A file, and what it is for where somebody says so: 'shape', 'image' (its directions), or a role. Empty: as it is guessed. */
export interface Opening {
  file: File;
  role: string;
}

export interface Opener {
  /** @throws StudioError, SillonError */
  open(files: readonly File[]): Promise<void>;
  /** Uses one of the files that were opened last as something else. */
  setRole(index: number, role: Role): Promise<void>;
  openExample(example: Example): Promise<void>;
  /** A project that lies beside the page. @throws StudioError LoadFailed; as open */
  openOwn(path: string): Promise<void>;
  /** Another plate, of these files alone. */
  load(openings: readonly Opening[]): Promise<void>;
}

const gesture = 'files';

/** @param show  puts up another plate altogether. */
export function createOpener(studio: Studio, engine: () => Promise<Engine>, show: (plate: Plate) => void): Opener {
  /** What the files are put into, whatever they are used as. */
  let before: Plate | undefined;

  async function use(opened: readonly Opened[]): Promise<void> {
    const { withFiles } = await import('./files/open.js');
    const base = before ?? studio.store.state.plate;
    const plate = await withFiles(base, opened, await engine(), (problem) => {
      studio.fail(problem);
    });
    // One step of undo, however often the roles are changed.
    studio.store.change(() => plate, gesture);
    studio.store.set({ opened });
    studio.stage?.fit();
  }

  const opener: Opener = {
    async open(files) {
      const { identify } = await import('./files/open.js');
      const { plate } = studio.store.state;
      const found = await identify(await Promise.all(files.map(readable)), plate, await engine());
      if (found.project !== undefined) {
        show(found.project);
        studio.store.set({ opened: [] });
        return;
      }
      before = plate;
      studio.store.settle();
      await use(found.opened);
      if (found.opened.length > 1) {
        studio.show('files');
        return;
      }
      for (const { source, role } of found.opened) {
        studio.notify(t('files.opened', { name: source.name, role: t(`role.${role}`) }), {
          label: t('files.change'),
          run: () => {
            studio.show('files');
          },
        });
      }
    },

    async setRole(index, role) {
      const { opened } = studio.store.state;
      await use(opened.map((file, k) => (k === index ? { ...file, role } : file)));
    },

    async load(openings) {
      const { identify, withFiles } = await import('./files/open.js');
      const plate = newPlate();
      const files = await Promise.all(openings.map(({ file }) => readable(file)));
      const found = await identify(files, plate, await engine());
      const opened = found.opened.map((one, k) => ({ ...one, role: asked(one, openings[k]?.role ?? '') }));
      before = plate;
      show(found.project ?? (await withFiles(plate, opened, await engine())));
      studio.store.forgetSteps();
      studio.store.set({ opened });
    },

    async openExample(example) {
      show(await plateOf(example));
      studio.store.set({ opened: [] });
    },

    async openOwn(path) {
      await opener.open([new File([await fetchedBytes(path)], path.replace(/^.*\//, ''))]);
    },
  };
  return opener;
}

/** The role that a file gets. @param wanted  of an `Opening` */
function asked({ source, role, roles }: Opened, wanted: string): Role {
  if (wanted === '') return role;
  const directions: readonly Role[] = ['tone', 'edges', 'levels', 'angle', 'rotation', 'tangent'];
  const means: Record<string, readonly Role[]> = { shape: ['shape', 'mask'], image: [role, ...directions] };
  const possible = Object.hasOwn(means, wanted) ? (means[wanted] ?? []) : roles.filter((one) => one === wanted);
  const found = possible.find((one) => roles.includes(one) && (wanted !== 'image' || directions.includes(one)));
  if (found === undefined) throw new StudioError('GuestValue', { where: source.name, value: wanted });
  return found;
}

/** Pictures of kinds that only the browser reads, as PNG; everything else as it is. */
async function readable(file: File): Promise<File> {
  if (!/^image\/(webp|gif|avif|heic|heif)$/.test(file.type)) return file;
  try {
    const image = await createImageBitmap(file);
    const canvas = new OffscreenCanvas(image.width, image.height);
    canvas.getContext('2d')?.drawImage(image, 0, 0);
    return new File([await canvas.convertToBlob({ type: 'image/png' })], file.name, { type: 'image/png' });
  } catch {
    return file; // it will be refused by its name
  }
}

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
  id: `example/${name}`,
  name,
  bytes: await fetchedBytes(`examples/${name}`),
});

async function plateOf(example: Example): Promise<Plate> {
  const { directions, modes = {}, width, height, filament, spacing, nozzle, nearest } = example;
  const shape: ShapeSource =
    typeof example.shape === 'string'
      ? { kind: 'file', file: await fetched(example.shape), unitless: 'px' }
      : example.shape;
  const plate = newPlate();
  const made: Plate = {
    ...plate,
    name: t(`example.${example.id}`),
    shape,
    width,
    height,
    directions:
      'kind' in directions
        ? directions
        : { kind: 'map', file: await fetched(directions.file), encoding: directions.encoding },
    modes: {
      base: modes.base ?? plate.modes.base,
      ...(modes.file === undefined ? {} : { file: await fetched(modes.file) }),
    },
    toolpath: {
      ...plate.toolpath,
      spacing: spacing ?? plate.toolpath.spacing,
      mapFilter: nearest === true ? 'nearest' : 'average',
    },
    printer: { ...plate.printer, nozzle: nozzle ?? plate.printer.nozzle },
  };
  return withFilament(made, filament);
}
