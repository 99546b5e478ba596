// Order of the letters in a line that may run both ways; does the same as core/src/text/text_runs_here.cpp with other
// libraries.
import library from 'bidi-js';

/** A part of a line that runs one way and is written in one script, as shapers require. */
export interface TextRun {
  /** UTF-16 units, also for end. */
  begin: number;
  end: number;
  toLeft: boolean;
}

// The package has types of a CommonJS module, although it is none.
const bidi = (library as unknown as typeof library.default)();

/** bidi-js only looks at single UTF-16 units. Larger codes are replaced by a letter of the same kind. */
const standIns: Partial<Record<ReturnType<typeof bidi.getBidiCharTypeName>, string>> = {
  R: '\u05D0',
  AL: '\u0627',
  EN: '0',
  AN: '\u0660',
  ET: '#',
  NSM: '\u0300',
  BN: '\u00AD',
  ON: '!',
};

/** ISO 15924 codes of Unicode's scripts, except Common and Inherited. */
const scriptCodes =
  'Adlm Aghb Ahom Arab Armi Armn Avst Bali Bamu Bass Batk Beng Bhks Bopo Brah Brai Bugi Buhd Cakm Cans Cari Cham Cher Chrs ' +
  'Copt Cpmn Cprt Cyrl Deva Diak Dogr Dsrt Dupl Egyp Elba Elym Ethi Geor Glag Gong Gonm Goth Gran Grek Gujr Guru Hang Hani ' +
  'Hano Hatr Hebr Hira Hluw Hmng Hmnp Hung Ital Java Kali Kana Kawi Khar Khmr Khoj Kits Knda Kthi Lana Laoo Latn Lepc Limb ' +
  'Lina Linb Lisu Lyci Lydi Mahj Maka Mand Mani Marc Medf Mend Merc Mero Mlym Modi Mong Mroo Mtei Mult Mymr Nagm Nand Narb ' +
  'Nbat Newa Nkoo Nshu Ogam Olck Orkh Orya Osge Osma Ougr Palm Pauc Perm Phag Phli Phlp Phnx Plrd Prti Rjng Rohg Runr Samr ' +
  'Sarb Saur Sgnw Shaw Shrd Sidd Sind Sinh Sogd Sogo Sora Soyo Sund Sylo Syrc Tagb Takr Tale Talu Taml Tang Tavt Telu Tfng ' +
  'Tglg Thaa Thai Tibt Tirh Tnsa Toto Ugar Vaii Vith Wara Wcho Xpeo Xsux Yezi Yiii Zanb';
let scripts: [string, RegExp][] | undefined;
const scriptOfLetter = new Map<string, string>();

/** Makes a pattern for each script; a browser does not know scripts that are younger than itself. */
const readScripts = (): [string, RegExp][] =>
  scriptCodes.split(' ').flatMap((code) => {
    try {
      return [[code, new RegExp(`\\p{Script=${code}}`, 'u')]];
    } catch {
      return [];
    }
  });

/** Returns the script of a letter; empty for letters of several scripts. */
function scriptOf(letter: string): string {
  let script = scriptOfLetter.get(letter);
  if (script === undefined) {
    scripts ??= readScripts();
    script = scripts.find(([, known]) => known.test(letter))?.[0] ?? '';
    scriptOfLetter.set(letter, script);
  }
  return script;
}

/** Splits a run into parts of one script each, from left to right. */
function byScript(line: string, { begin, end, toLeft }: TextRun): TextRun[] {
  const parts: TextRun[] = [];
  let from = begin;
  let known = '';
  let at = begin;
  for (const letter of line.slice(begin, end)) {
    const script = scriptOf(letter);
    if (script !== '' && known !== '' && script !== known) {
      parts.push({ begin: from, end: at, toLeft });
      from = at;
    }
    if (script !== '') known = script;
    at += letter.length;
  }
  parts.push({ begin: from, end, toLeft });
  return toLeft ? parts.reverse() : parts;
}

/** Longest paragraph that is ordered at once, because the library's time grows with the square of the length. The
 * native program has the same limit. */
const longestParagraph = 4096;

/** @param offset  place of the letters in the line [UTF-16 units] */
function runsOf(letters: string[], offset: number): TextRun[] {
  const places = [offset];
  for (const letter of letters) places.push((places.at(-1) ?? 0) + letter.length);
  const kinds = letters
    .map((letter) => (letter.length === 1 ? letter : (standIns[bidi.getBidiCharTypeName(letter)] ?? 'a')))
    .join('');
  const embedding = bidi.getEmbeddingLevels(kinds);
  const ways: TextRun[] = [];
  for (const index of bidi.getReorderedIndices(kinds, embedding)) {
    const [begin = 0, end = 0] = places.slice(index, index + 2);
    const toLeft = ((embedding.levels[index] ?? 0) & 1) === 1;
    const before = ways.at(-1);
    // Adjacent runs of one direction, whose levels differ by two, are joined, so that kerning works across them.
    if (before?.toLeft === toLeft && (toLeft ? end === before.begin : begin === before.end)) {
      before.begin = Math.min(before.begin, begin);
      before.end = Math.max(before.end, end);
    } else {
      ways.push({ begin, end, toLeft });
    }
  }
  return ways;
}

/** Returns the runs of a line by the Unicode bidirectional algorithm, in their order from left to right. */
export function textRuns(line: string): TextRun[] {
  const letters = Array.from(line);
  const runs: TextRun[] = [];
  let offset = 0;
  for (let k = 0; k < letters.length; k += longestParagraph) {
    const part = letters.slice(k, k + longestParagraph);
    for (const way of runsOf(part, offset)) runs.push(...byScript(line, way));
    offset += part.join('').length;
  }
  return runs;
}
