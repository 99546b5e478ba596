// Imports a printer from another program's file, with the filament that the file was made for.
import type { ImportedPrinter } from 'sillon';
import { words } from '../i18n/en/printer.js';
import { importNoteText } from '../i18n/say-core.js';
import { say, t } from '../i18n/text.js';
import { onMachine } from '../model/brought.js';
import { printerDefaults } from '../model/defaults.js';
import { filamentLike, heatFor, heatOf, withFilamentOf, type Heat } from '../model/filaments.js';
import type { Plate } from '../model/plate.js';
import { problemOf, StudioError } from '../model/problem.js';
import type { Studio } from '../studio/studio.js';

/** Keys of slicers, Cura and project files that state a filament. */
const names = {
  type: ['filament_type', 'material_type', 'filamentType'],
  nozzle: ['temperature', 'nozzle_temperature', 'material_print_temperature', 'nozzleTemperature'],
};

const sameHeat = (a: Heat, b: Heat): boolean => JSON.stringify(heatOf(a)) === JSON.stringify(heatOf(b));

type Read = Pick<ImportedPrinter, 'printer' | 'read'>;

const tells = ({ read }: Read, keys: readonly string[]): boolean => keys.some((key) => read.includes(key));

/** The temperatures of the file; undefined where it has none. */
function heatIn(file: Read): Heat | undefined {
  const heat = heatOf(file.printer);
  if (tells(file, names.nozzle)) return heat;
  if (sameHeat(heat, printerDefaults)) return undefined;
  return { ...heat, nozzleTemperature: heat.firstLayerNozzleTemperature }; // a start block alone heats for the first layer
}

/** Puts the plate on the printer of a file. Where the file has both a filament's type and temperatures, the plate takes
 * both and looks like that filament. Where it has only one of them, a known type brings its usual temperatures;
 * otherwise the plate's filament stays.
 * @returns `other`: temperatures in the file that were not taken and differ from the plate's */
export function withImported(plate: Plate, file: Read): { plate: Plate; other: Heat | undefined } {
  const { printer } = file;
  const heat = heatIn(file);
  if (tells(file, names.type)) {
    const like = filamentLike(printer.filamentType);
    if (heat !== undefined) return { plate: withFilamentOf(plate, { ...printer, ...heat }), other: undefined };
    if (like !== undefined) {
      return { plate: withFilamentOf(plate, { ...printer, ...heatFor(like) }), other: undefined };
    }
  }
  const kept = onMachine({ ...plate, printer: { ...plate.printer, nozzle: printer.nozzle } }, printer);
  return { plate: kept, other: heat === undefined || sameHeat(heat, kept.printer) ? undefined : heat };
}

/** Offers the printers of a bundle. */
function ask(studio: Studio, file: File, names: readonly string[]): void {
  const actions = names.map((label) => ({
    label,
    run: () => void studio.attempt(() => importPrinter(studio, file, label)),
  }));
  studio.tell({ text: say(words, 'printer.which', { name: file.name, n: names.length }), actions, stays: true });
}

/** Takes the printer of a file, and tells the visitor which filament and temperatures apply from now on.
 * @param printer  name of a printer in a bundle; empty: the bundle's chosen or only one, or a question to the visitor
 * @throws StudioError PrinterFile; errors of the engine */
export async function importPrinter(studio: Studio, file: File, printer = ''): Promise<void> {
  const engine = await studio.services.engine();
  const imported = await engine.importPrinter(file, printer).catch((error: unknown) => {
    const { code, values, detail } = problemOf(error);
    if (values['reason'] === 'WhichPrinter') {
      ask(
        studio,
        file,
        Array.from(String(values['names']).matchAll(/"([^"]*)"/g), ([, name = '']) => name),
      );
      return undefined;
    }
    throw code === 'InvalidFile' ? new StudioError('PrinterFile', { name: file.name }, detail) : error;
  });
  if (imported === undefined) return;
  const { read, notRead } = imported;
  const { plate, other } = withImported(studio.store.state.plate, imported);
  studio.settle();
  studio.choosePrint(() => plate);
  const { filamentType, nozzleTemperature: nozzle, bedTemperature: bed } = plate.printer;
  const type = filamentType || t('section.filament');
  const taken = other === undefined && tells(imported, names.type);
  const text = [
    say(words, 'printer.imported', { name: file.name, n: read.length }),
    say(words, taken ? 'printer.heats' : 'printer.keeps', { type, nozzle, bed }),
    ...(other === undefined
      ? []
      : [say(words, 'printer.heatsOther', { nozzle: other.nozzleTemperature, bed: other.bedTemperature })]),
    ...(notRead.length === 0 ? [] : [say(words, 'printer.look', { list: notRead.map(importNoteText).join(' ') })]),
  ].join(' ');
  if (other === undefined) {
    studio.notify(text);
    return;
  }
  const take = {
    label: say(words, 'printer.takeHeat', { nozzle: other.nozzleTemperature }),
    run: () => {
      studio.settle();
      studio.choosePrint((now) => ({ ...now, printer: { ...now.printer, ...other } }));
    },
  };
  studio.tell({ text, actions: [take], stays: true });
}
