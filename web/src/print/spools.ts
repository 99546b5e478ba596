// Files of spools that the visitor has measured, in the format of docs/reference/spools.md, which the command line
// reads, too.
import { fieldsOf, numberIn, Unfit } from '../model/check.js';
import { filaments } from '../model/filaments.js';
import { spoolFrom } from '../model/own-spool.js';
import type { OwnSpool } from '../model/plate.js';

const version = 1;
const mostSpools = 1000;
const mostBytes = 2 ** 20;

/** Reads a file of spools. @throws Unfit with the spool and the field that is wrong */
export function readSpools(text: string): OwnSpool[] {
  if (text.length > mostBytes) throw new Unfit('', text.length);
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch {
    throw new Unfit('', text);
  }
  const root = fieldsOf(json, '', ['version', 'spools']);
  numberIn(root['version'], 'version', version, version);
  const { spools } = root;
  if (typeof spools !== 'object' || spools === null || Array.isArray(spools)) throw new Unfit('spools', spools);
  const entries = Object.entries(spools);
  if (entries.length > mostSpools) throw new Unfit('spools', entries.length);
  return entries.map(([key, entry]) => spoolFrom(key, entry, key));
}

/** Returns the text of a file of spools, in the form that `sillon calibrate read` writes. */
export function spoolsText(spools: readonly OwnSpool[]): string {
  const entries = spools.map(({ key, ...entry }) => [key, entry] as const);
  return `${JSON.stringify({ version, spools: Object.fromEntries(entries) }, undefined, 2)}\n`;
}

/** Turns a name into a key that a file of spools may have and no other spool has. @param taken  keys of other spools */
export function spoolKey(wanted: string, taken: readonly string[]): string {
  const plain = wanted
    .normalize('NFD')
    .replace(/\p{M}/gu, '')
    .replace(/[^\w-]+/g, '-')
    .replace(/^-+|-+$/g, '')
    .slice(0, 36);
  const stem = plain || 'mySpool';
  const used = new Set([...taken, ...filaments.map(({ key }) => key)]);
  for (let n = 1; ; ++n) {
    const key = n === 1 ? stem : `${stem}-${n}`;
    if (!used.has(key)) return key;
  }
}

/** Adds a spool, or replaces the one of the same name. */
export const withOne = (spools: readonly OwnSpool[], spool: OwnSpool): OwnSpool[] =>
  [...spools.filter(({ key }) => key !== spool.key), spool].sort((a, b) => a.key.localeCompare(b.key, 'en'));
