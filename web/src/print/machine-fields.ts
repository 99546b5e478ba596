// Makes the fields for the printer and the filament.
import { css, html, nothing, type TemplateResult } from 'lit';
import { live } from 'lit/directives/live.js';
import { printerLabel } from '../i18n/say.js';
import { words } from '../i18n/en/printer.js';
import { say, t } from '../i18n/text.js';
import { countLines } from '../model/brought.js';
import { filaments, withFilament, withSpool } from '../model/filaments.js';
import type { OwnSpool, Plate } from '../model/plate.js';
import {
  isGeneric,
  printers,
  printersByFile,
  profileOf,
  withPrinter,
  type PrinterChoice,
  type PrinterKey,
} from '../model/printers.js';
import { filamentLabel, filamentName, listedFilament } from './filament-name.js';
import { spoolColour } from './spool.js';
import { select, type ChoiceField } from '../controls/fields.js';
import type { Studio } from '../studio/studio.js';
import { button } from '../controls/button.js';

/** The visitor's spools that are kept here, and the plate's own, which may have come with a project. */
export function ownSpools(studio: Studio): readonly OwnSpool[] {
  const { plate, spools = [] } = studio.store.state;
  const { spool } = plate;
  return spool === undefined || spools.some(({ key }) => key === spool.key) ? spools : [...spools, spool];
}

/** Styles for panels that show `filamentField`. */
export const swatchStyle = css`
  .swatches {
    display: flex;
    flex-wrap: wrap;
    gap: 8px;
  }
  .swatches label {
    position: relative;
    width: 36px;
    height: 36px;
    border-radius: 50%;
    box-shadow: inset 0 0 0 1px var(--edge);
    background: ${spoolColour};
    forced-color-adjust: none;
  }
  .swatches label:has(:checked) {
    outline: 2px solid var(--accent);
    outline-offset: 3px;
  }
  .swatches label:has(:focus-visible) {
    outline: 3px solid var(--ink);
    outline-offset: 3px;
  }
`;

/** Printers in the order in which a visitor is asked for theirs: particular machines first, then generic ones. */
const printersToChoose: readonly PrinterChoice[] = [
  ...[...printers.filter((one) => !isGeneric(one)), ...printersByFile].sort((a, b) =>
    a.label.localeCompare(b.label, 'en'),
  ),
  ...printers.filter(isGeneric),
];

/** Makes the choice of one printer; those that need a file can be chosen only where the printer is asked for. */
function optionOf(printer: PrinterChoice, asks: boolean): ChoiceField['options'][number] {
  const { key, label } = printer;
  if (printersByFile.includes(printer))
    return { value: key, label: say(words, 'printer.byFile', { name: label }), disabled: !asks };
  const name = printerLabel(printer);
  return { value: key, label: asks && isGeneric(printer) ? say(words, 'printer.another', { name }) : name };
}

export interface PrinterQuestion {
  /** Printer whose file the page waits for. '' means none chosen yet; undefined means the plate's own printer. */
  value: PrinterKey | undefined;
  onChoose: (key: PrinterKey) => void;
}

/** Makes the field for the printer.
 * @param question  given if the page asks for the printer; omitted if the printer is one of many settings */
export function printerField(studio: Studio, question?: PrinterQuestion): TemplateResult {
  const { plate } = studio.store.state;
  const { name, startGcode } = plate.printer;
  const current = profileOf(plate.printer);
  const asks = question !== undefined;
  const options = (asks ? printersToChoose : [...printers, ...printersByFile]).map((printer) =>
    optionOf(printer, asks),
  );
  if (question?.value === '') options.unshift({ value: '', label: say(words, 'printer.choose') });
  else if (current === undefined)
    options.unshift({ value: '', label: name === '' ? t('printer.own') : say(words, 'printer.ownNamed', { name }) });
  return html`${select({
      id: 'printer',
      label: t('section.printer'),
      value: question?.value ?? current?.key ?? '',
      options,
      onChoose: (key) => {
        question?.onChoose(key);
        if (printers.some((one) => one.key === key)) studio.choosePrint((now) => withPrinter(now, key));
      },
    })}
    <button id="printer-file" class=${question?.value ? 'main' : ''} @click=${() => void pickPrinter(studio)}>
      ${say(words, 'printer.import')}
    </button>
    ${question?.value === undefined ? startNote(studio, startGcode, current) : nothing}`;
}

/** Warns that a missing start block is replaced by a plain one, or offers a review of an imported printer's own block.
 * Built-in printers with a start block need no note. */
function startNote(
  studio: Studio,
  startGcode: string,
  current: PrinterChoice | undefined,
): TemplateResult | typeof nothing {
  if (startGcode === '') return html`<p class="note">${say(words, 'printer.start')}</p>`;
  if (current !== undefined) return nothing;
  return html`<p class="note">
    ${say(words, 'printer.ownStart', { n: countLines(startGcode) })}
    ${button('link', t('brought.show'), () => studio.review())}
  </p>`;
}

/** Asks for another program's file that contains a printer, and takes the printer from it. */
export async function pickPrinter(studio: Studio): Promise<void> {
  const [file] = await studio.pick('.gcode,.bgcode,.gz,.ini,.json,.orca_printer,.3mf');
  if (file !== undefined) await takePrinter(studio, file);
}

/** Takes the printer from another program's G-code or settings. @returns false where that failed */
export const takePrinter = (studio: Studio, file: File): Promise<boolean> =>
  studio.attempt(async () => {
    await (await import('./printer-file.js')).importPrinter(studio, file);
  });

/** Makes the field for the filament, which offers the listed ones and the visitor's own spools. */
export function filamentField(studio: Studio): TemplateResult {
  const { plate } = studio.store.state;
  const chosen = listedFilament(plate);
  const swatch = (
    colour: readonly number[],
    name: string,
    checked: boolean,
    change: (plate: Plate) => Plate,
  ): TemplateResult =>
    html`<label title=${name} .style=${`--colour: rgb(${colour.join(' ')})`}>
      <input
        type="radio"
        name="filament"
        aria-label=${name}
        .checked=${live(checked)}
        @change=${() => studio.choosePrint(change)}
      />
    </label>`;
  return html`<div class="field">
      <span class="name" id="filament-name">${t('section.filament')}</span>
      <span class="note">${filamentName(plate)}</span>
      <div class="wide swatches" role="radiogroup" aria-labelledby="filament-name">
        ${filaments.map((filament) =>
          swatch(filament.colour, filamentLabel(filament), filament === chosen, (now) =>
            withFilament(now, filament.key),
          ),
        )}
        ${ownSpools(studio).map((one) =>
          swatch(one.colour, one.key, plate.spool?.key === one.key, (now) => withSpool(now, one)),
        )}
      </div>
    </div>
    <p class="note">${say(words, 'filament.help')}</p>`;
}
