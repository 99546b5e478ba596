// Which printer, which filament.
import { css, html, nothing, type TemplateResult } from 'lit';
import { live } from 'lit/directives/live.js';
import { printerLabel } from '../i18n/say.js';
import { words } from '../i18n/en/printer.js';
import { say, t } from '../i18n/text.js';
import { countLines } from '../model/brought.js';
import { filaments, withFilament, withSpool } from '../model/filaments.js';
import type { OwnSpool } from '../model/plate.js';
import { printers, printersByFile, profileOf, withPrinter, type PrinterKey } from '../model/printers.js';
import { filamentLabel, filamentName, listedFilament } from './filament-name.js';
import { spoolColour } from './spool.js';
import { select } from '../controls/fields.js';
import type { Studio } from '../studio/studio.js';

/** Those that are kept here, and that of the plate, which may have come with a project. */
export function ownSpools(studio: Studio): readonly OwnSpool[] {
  const { plate, spools = [] } = studio.store.state;
  const { spool } = plate;
  return spool === undefined || spools.some(({ key }) => key === spool.key) ? spools : [...spools, spool];
}

/** For the panel that shows `filamentField`. */
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

export function printerField(studio: Studio): TemplateResult {
  const { plate } = studio.store.state;
  const { name, startGcode } = plate.printer;
  const current = profileOf(plate.printer);
  const options: { value: PrinterKey; label: string; disabled?: boolean }[] = [
    ...printers.map((printer) => ({ value: printer.key, label: printerLabel(printer) })),
    ...printersByFile.map(({ key, label }) => ({
      value: key,
      label: say(words, 'printer.byFile', { name: label }),
      disabled: true,
    })),
  ];
  if (current === undefined)
    options.unshift({ value: '', label: name === '' ? t('printer.own') : say(words, 'printer.ownNamed', { name }) });
  return html`${select<PrinterKey>({
      id: 'printer',
      label: t('section.printer'),
      value: current?.key ?? '',
      options,
      onChoose: (key) => {
        if (key !== '') studio.change((plate) => withPrinter(plate, key));
      },
    })}
    <button type="button" @click=${() => void pickPrinter(studio)}>${say(words, 'printer.import')}</button>
    ${
      startGcode === ''
        ? html`<p class="note">${say(words, 'printer.start')}</p>`
        : current === undefined
          ? html`<p class="note">
              ${say(words, 'printer.ownStart', { n: countLines(startGcode) })}
              <button
                type="button"
                class="link"
                @click=${() => {
                  studio.review();
                }}
              >
                ${t('brought.show')}
              </button>
            </p>`
          : nothing
    }`;
}

/** Asks for a file of another program that tells a printer. */
export async function pickPrinter(studio: Studio): Promise<void> {
  const [file] = await studio.pick('.gcode,.bgcode,.gz,.ini,.json,.orca_printer,.3mf');
  if (file !== undefined) await takePrinter(studio, file);
}

/** Takes the printer from G-code or settings of another program. */
export const takePrinter = (studio: Studio, file: File): Promise<boolean> =>
  studio.attempt(async () => {
    await (await import('./printer-file.js')).importPrinter(studio, file);
  });

export function filamentField(studio: Studio): TemplateResult {
  const { plate } = studio.store.state;
  const { spool } = plate;
  const own = ownSpools(studio);
  const chosen = listedFilament(plate);
  return html`<div class="field">
      <span class="name" id="filament-name">${t('section.filament')}</span>
      <span class="note">${filamentName(plate)}</span>
      <div class="wide swatches" role="radiogroup" aria-labelledby="filament-name">
        ${filaments.map(
          (filament) =>
            html`<label title=${filamentLabel(filament)} .style=${`--colour: rgb(${filament.colour.join(' ')})`}>
              <input
                type="radio"
                name="filament"
                aria-label=${filamentLabel(filament)}
                .checked=${live(filament === chosen)}
                @change=${() => {
                  studio.change((plate) => withFilament(plate, filament.key));
                }}
              />
            </label>`,
        )}
        ${own.map(
          (one) =>
            html`<label title=${one.key} .style=${`--colour: rgb(${one.colour.join(' ')})`}>
              <input
                type="radio"
                name="filament"
                aria-label=${one.key}
                .checked=${live(spool?.key === one.key)}
                @change=${() => {
                  studio.change((plate) => withSpool(plate, one));
                }}
              />
            </label>`,
        )}
      </div>
    </div>
    <p class="note">${say(words, 'filament.help')}</p>`;
}
