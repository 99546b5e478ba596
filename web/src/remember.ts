// Small choices that outlive a visit. Where storage is denied they just do not.
const prefix = 'sillon.';

export function remember(name: string, value: string): void {
  try {
    localStorage.setItem(prefix + name, value);
  } catch {
    // denied, or full
  }
}

/** @returns undefined where nothing, or something else than one of `values`, was kept. */
export function recall<Value extends string>(name: string, values: readonly Value[]): Value | undefined {
  try {
    return values.find((value) => value === localStorage.getItem(prefix + name));
  } catch {
    return undefined;
  }
}
