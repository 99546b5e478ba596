// Reads a spool that somebody has measured from a file, a project or a link, since the engine has no call for that.
import { fieldsOf, numberIn, textIn, Unfit } from './check.js';
import { filaments } from './filaments.js';
import type { OwnSpool } from './plate.js';

type SpoolSides = OwnSpool['fine'];

/** Reads the slopes of both sides [degrees]. @throws Unfit */
function sidesFrom(value: unknown, where: string): SpoolSides {
  const sides = fieldsOf(value, where, ['nozzleSide', 'bedSide']);
  const slopes = (side: keyof SpoolSides): [number, number] => {
    const at = `${where}.${side}`;
    const pair = sides[side];
    if (!Array.isArray(pair) || pair.length !== 2) throw new Unfit(at, pair);
    return [numberIn(pair[0], at, 0.1, 45), numberIn(pair[1], at, 0.1, 45)];
  };
  return { nozzleSide: slopes('nozzleSide'), bedSide: slopes('bedSide') };
}

/** Reads an entry of a file of spools, by the engine's rules. @param value  the entry without its key @throws Unfit */
export function spoolFrom(key: unknown, value: unknown, where = 'spool'): OwnSpool {
  const name = textIn(key, `${where}.key`, 40);
  if (!/^[\w-]+$/.test(name) || filaments.some((filament) => filament.key === name)) {
    throw new Unfit(`${where}.key`, name);
  }
  const { colour, fine, wide, source } = fieldsOf(value, where, ['colour', 'fine', 'wide', 'source']);
  const channels = Array.isArray(colour) && colour.length === 3 ? colour : [undefined];
  const rgb = channels.map((one) => (Number.isInteger(one) ? numberIn(one, `${where}.colour`, 0, 255) : NaN));
  if (rgb.some(Number.isNaN)) throw new Unfit(`${where}.colour`, colour);
  if (source !== undefined && typeof source !== 'string') throw new Unfit(`${where}.source`, source);
  return {
    key: name,
    colour: rgb as [number, number, number],
    fine: sidesFrom(fine, `${where}.fine`),
    ...(wide !== undefined && { wide: sidesFrom(wide, `${where}.wide`) }),
    ...(source !== undefined && { source }),
  };
}

/** Reads the spool of a plate. @param value  an entry with its key; undefined: none @throws Unfit */
export function plateSpoolFrom(value: unknown): { spool?: OwnSpool } {
  if (value === undefined) return {};
  const { key, ...entry } = fieldsOf(value, 'spool', ['key', 'colour', 'fine', 'wide', 'source']);
  return { spool: spoolFrom(key, entry) };
}
