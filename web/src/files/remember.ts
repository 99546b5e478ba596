// Small choices that outlive a visit, as long as the browser allows storage.
const prefix = 'sillon.';

/** A kept text; undefined where none was kept or storage is denied. */
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
    // denied or full
  }
}

export function forget(name: string): void {
  try {
    localStorage.removeItem(prefix + name);
  } catch {
    // denied, so nothing was kept either
  }
}

/** The kept choice. @returns undefined where nothing, or none of `values`, was kept */
export function recall<Value extends string>(name: string, values: readonly Value[]): Value | undefined {
  const kept = recallText(name);
  return values.find((value) => value === kept);
}
