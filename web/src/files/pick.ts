// Asks the visitor for files.

/** The questions that are open: a browser may drop an input that nothing holds, and with it the files that were chosen. */
const open = new Set<HTMLInputElement>();

/** @param accept  kinds, as an input has them; empty: any @returns none where the question is dismissed */
export const pickFiles = (accept: string): Promise<File[]> =>
  new Promise((resolve) => {
    const input = Object.assign(document.createElement('input'), { type: 'file', multiple: true, accept });
    const end = (): void => {
      open.delete(input);
      resolve([...(input.files ?? [])]);
    };
    input.addEventListener('change', end);
    input.addEventListener('cancel', end);
    open.add(input);
    input.click();
  });
