/** Removes everything from a text that some system refuses in a file name; may return ''. Letters keep their
 * accents, and leading dots go, so that no file is hidden. */
export const plainName = (text: string): string =>
  text
    .normalize('NFC')
    .replace(/[^\p{L}\p{M}\p{N}._ -]+/gu, '')
    .replace(/^[. ]+|[. ]+$/g, '');
