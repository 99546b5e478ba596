// A printer out of another program's file.
import type { PrinterValues } from 'sillon';
import type { StudioEngine } from '../engine/studio-engine.js';
import { importNoteText } from '../i18n/say-core.js';
import { t } from '../i18n/text.js';
import { problemOf, StudioError } from '../model/problem.js';

type Engine = Awaited<ReturnType<StudioEngine['engine']>>;

/** @returns words for what was read and what was not
 * @throws StudioError */
export async function readPrinter(file: File, engine: Engine): Promise<{ printer: PrinterValues; told: string[] }> {
  const { printer, read, notRead } = await engine.importPrinter(file).catch((error: unknown) => {
    const { code, detail } = problemOf(error);
    throw code === 'InvalidFile' ? new StudioError('PrinterFile', { name: file.name }, detail) : error;
  });
  const told = [t('printer.imported', { name: file.name, n: read.length })];
  if (notRead.length > 0) told.push(t('printer.notRead', { list: notRead.map(importNoteText).join(' ') }));
  return { printer, told };
}
