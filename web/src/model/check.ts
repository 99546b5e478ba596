// Tests that values from elsewhere must pass, because they may have been written by anybody.
export type Fields = Record<string, unknown>;

/** A value as JSON of at most 41 characters, for an error's text. */
function shortened(value: unknown): string {
  let text: string | undefined;
  try {
    text = JSON.stringify(value);
  } catch {
    // a value nested too deeply, or one that contains itself
  }
  return text === undefined ? typeof value : text.length > 40 ? `${text.slice(0, 40)}…` : text;
}

/** A value that no control could have set. */
export class Unfit extends Error {
  /** The value as JSON, shortened to 40 characters. */
  readonly value: string;

  constructor(
    /** Path of keys to the value; empty: the whole plate. */
    readonly where: string,
    value: unknown,
  ) {
    const short = shortened(value);
    super(`${where === '' ? 'the plate' : where} is ${short}, which is not allowed`);
    this.value = short;
  }
}

/** The fields of an object. @throws Unfit where it is no object or has a field that is not among `known` */
export function fieldsOf(value: unknown, where: string, known: readonly string[]): Fields {
  if (typeof value !== 'object' || value === null || Array.isArray(value)) throw new Unfit(where, value);
  for (const [name, one] of Object.entries(value)) {
    if (!known.includes(name)) throw new Unfit(where === '' ? name : `${where}.${name}`, one);
  }
  return value as Fields;
}

/** The value as a number from `min` to `max`. @throws Unfit for any other value, NaN included */
export function numberIn(value: unknown, where: string, min: number, max: number): number {
  if (typeof value !== 'number' || !(value >= min && value <= max)) throw new Unfit(where, value);
  return value;
}

/** The value as a text of at most `longest` characters, without control characters. @throws Unfit for any other
 * value */
export function textIn(value: unknown, where: string, longest: number): string {
  // eslint-disable-next-line no-control-regex
  if (typeof value !== 'string' || value.length > longest || /[\u0000-\u0008\u000b-\u001f]/.test(value)) {
    throw new Unfit(where, value);
  }
  return value;
}

/** The value as one of `choices`. @throws Unfit for any other value */
export function oneOf<Choice extends string>(value: unknown, where: string, choices: readonly Choice[]): Choice {
  if (!choices.includes(value as Choice)) throw new Unfit(where, value);
  return value as Choice;
}
