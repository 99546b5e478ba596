// Asks the visitor for files.

/** Inputs of open dialogs. A browser may drop an input that nothing refers to, and the chosen files with it. */
const open = new Set<HTMLInputElement>();

/** Opens a dialog for files. @param accept  kinds as in an input's `accept`; empty: any @returns none where it is
 * dismissed */
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
