import type { PrinterValues } from '../sillon.js';

/** Filaments by their ids, such as 'pla': the fields of a printer that each sets. */
declare const table: { version: 1; filaments: Record<string, Partial<PrinterValues>> };
export default table;
