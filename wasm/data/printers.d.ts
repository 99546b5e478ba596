import type { PrinterValues } from '../sillon.js';

/** Printer profiles by their ids, such as 'prusa-mk4s': what each changes from the default printer. */
declare const table: { version: 1; printers: Record<string, Partial<PrinterValues>> };
export default table;
