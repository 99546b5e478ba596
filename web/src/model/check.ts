// The tests that values from elsewhere must pass: what comes in may have been written by anybody.
export type Fields = Record<string, unknown>;

function shortened(value: unknown): string {
  let text: string | undefined;
  try {
    text = JSON.stringify(value);
  } catch {
    // nested too deep
  }
  return text === undefined ? typeof value : text.length > 40 ? `${text.slice(0, 40)}…` : text;
}

/** A value that no control could have set. */
export class Unfit extends Error {
  /** As JSON, shortened. */
  readonly value: string;

  constructor(
    /** Path of keys; empty: the whole. */
    readonly where: string,
    value: unknown,
  ) {
    const short = shortened(value);
    super(`${where === '' ? 'the plate' : where} is ${short}, which is not allowed`);
    this.value = short;
  }
}

export function fieldsOf(value: unknown, where: string, known: readonly string[]): Fields {
  if (typeof value !== 'object' || value === null || Array.isArray(value)) throw new Unfit(where, value);
  for (const [name, one] of Object.entries(value)) {
    if (!known.includes(name)) throw new Unfit(where === '' ? name : `${where}.${name}`, one);
  }
  return value as Fields;
}

export function numberIn(value: unknown, where: string, min: number, max: number): number {
  if (typeof value !== 'number' || !(value >= min && value <= max)) throw new Unfit(where, value);
  return value;
}

export function textIn(value: unknown, where: string, longest: number): string {
  // eslint-disable-next-line no-control-regex
  if (typeof value !== 'string' || value.length > longest || /[\u0000-\u0008\u000b-\u001f]/.test(value)) {
    throw new Unfit(where, value);
  }
  return value;
}

export function oneOf<Choice extends string>(value: unknown, where: string, choices: readonly Choice[]): Choice {
  if (!choices.includes(value as Choice)) throw new Unfit(where, value);
  return value as Choice;
}
