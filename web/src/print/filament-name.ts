// Names of filaments on the page.
import { words } from '../i18n/en/printer.js';
import { say, t } from '../i18n/text.js';
import { filaments, type Filament } from '../model/filaments.js';
import type { Plate } from '../model/plate.js';

export const filamentLabel = ({ key }: Filament): string => say(words, `filament.${key}`);

/** The listed filament that the plate is printed with; undefined for a filament from a file or a spool of the
 * visitor's own. */
export const listedFilament = ({ pictures, printer, spool }: Plate): Filament | undefined =>
  filaments.find(
    ({ key, printed }) =>
      spool === undefined && key === pictures.spool && printed.filamentType === printer.filamentType.toUpperCase(),
  );

/** Name of the plate's filament, with the temperature where it is not the usual one. */
export function filamentName(plate: Plate): string {
  const { filamentType: type, nozzleTemperature } = plate.printer;
  if (plate.spool !== undefined) return [plate.spool.key, type].filter((word) => word !== '').join(', ');
  const listed = listedFilament(plate);
  if (listed === undefined) return say(words, 'filament.ofFile', { type: type || t('section.filament') });
  const name = filamentLabel(listed);
  return nozzleTemperature === listed.printed.nozzleTemperature
    ? name
    : say(words, 'filament.at', { name, n: nozzleTemperature });
}
