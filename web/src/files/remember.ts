// Small choices that outlive a visit. Where storage is denied they just do not.
const prefix = 'sillon.';

export function recallText(name: string): string | undefined {
  try {
    return localStorage.getItem(prefix + name) ?? undefined;
  } catch {
    return undefined;
  }
}

export function remember(name: string, value: string): void {
  try {
    localStorage.setItem(prefix + name, value);
  } catch {
    // denied, or full
  }
}

export function forget(name: string): void {
  try {
    localStorage.removeItem(prefix + name);
  } catch {
    // denied: it was not kept either
  }
}

/** @returns undefined where nothing, or something else than one of `values`, was kept. */
export function recall<Value extends string>(name: string, values: readonly Value[]): Value | undefined {
  const kept = recallText(name);
  return values.find((value) => value === kept);
}
