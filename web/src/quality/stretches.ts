// Joins the lamps under which a plate shows something into ranges of azimuths.

/** Angle between two lamps that are tried [degrees]. Only 180° are needed, since beads look the same from the
 * opposite side. */
export const step = 15;

/** Joins neighbouring azimuths into ranges `[from, to]`, in order. A range may continue beyond 180°. */
export function stretches(azimuths: readonly number[]): [number, number][] {
  const found: [number, number][] = [];
  for (const azimuth of azimuths) {
    const last = found.at(-1);
    if (last !== undefined && azimuth - last[1] === step) last[1] = azimuth;
    else found.push([azimuth, azimuth]);
  }
  const [first, last] = [found[0], found.at(-1)];
  if (first !== undefined && last !== undefined && first !== last && first[0] === 0 && last[1] === 180 - step) {
    found.shift();
    last[1] = first[1] + 180;
  }
  return found;
}
