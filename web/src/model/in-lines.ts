// Sentences as blocks of letters.

const lettersPerLine = 9; // of a block as wide as a name sign, times its lines

/** A sentence in lines of like length, as many as fill a sign; lines of one's own stay. */
export function inLines(text: string): string {
  if (text.includes('\n')) return text;
  const lines = Math.max(1, Math.round(Math.sqrt(text.length / lettersPerLine)));
  const width = text.length / lines;
  const made = [''];
  let begun = 0; // letters before the line
  for (const word of text.split(/\s+/)) {
    const line = made.at(-1) ?? '';
    const whole = line === '' ? word : `${line} ${word}`;
    // A word goes where most of it lies when the text is cut into equal parts.
    if (line !== '' && begun + whole.length - word.length / 2 > width * made.length && made.length < lines) {
      begun += line.length + 1;
      made.push(word);
    } else made[made.length - 1] = whole;
  }
  return made.join('\n');
}
