// Lamps under which a plate shows something, as stretches of a circle.

/** Between two lamps that are tried [degrees]. From the opposite side, beads look the same. */
export const step = 15;

/** Neighbours as one: `[from, to]`, in order; a stretch may go on over 180°. */
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
