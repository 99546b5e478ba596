// Breaks a sentence into a block of letters for a sign.

const lettersPerLine = 9; // letters per line divided by the number of lines, in a block shaped like a name sign

/** Breaks a sentence into lines of similar length, as many as fill a sign; a text that already has lines stays as it
 * is. */
export function inLines(text: string): string {
  if (text.includes('\n')) return text;
  const lines = Math.max(1, Math.round(Math.sqrt(text.length / lettersPerLine)));
  const width = text.length / lines;
  const made = [''];
  let begun = 0; // letters in the lines before this one
  for (const word of text.split(/\s+/)) {
    const line = made.at(-1) ?? '';
    const whole = line === '' ? word : `${line} ${word}`;
    // A word goes on the line that holds most of it when the text is cut into equal parts.
    if (line !== '' && begun + whole.length - word.length / 2 > width * made.length && made.length < lines) {
      begun += line.length + 1;
      made.push(word);
    } else made[made.length - 1] = whole;
  }
  return made.join('\n');
}
