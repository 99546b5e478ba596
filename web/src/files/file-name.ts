/** What of a text every system takes as a file's name; empty: nothing. Letters keep their marks, and nothing is hidden. */
export const plainName = (text: string): string =>
  text
    .normalize('NFC')
    .replace(/[^\p{L}\p{M}\p{N}._ -]+/gu, '')
    .replace(/^[. ]+|[. ]+$/g, '');
