// Spools that the visitor has measured, as a plain file: the format of docs/reference/spools.md, which the command line reads.
import { fieldsOf, numberIn, Unfit } from '../model/check.js';
import { filaments } from '../model/filaments.js';
import { spoolFrom } from '../model/own-spool.js';
import type { OwnSpool } from '../model/plate.js';

const version = 1;
const mostSpools = 1000;
const mostBytes = 2 ** 20;

/** @throws Unfit: which spool, and what of it */
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

/** As `sillon calibrate read` writes them. */
export function spoolsText(spools: readonly OwnSpool[]): string {
  const entries = spools.map(({ key, ...entry }) => [key, entry] as const);
  return `${JSON.stringify({ version, spools: Object.fromEntries(entries) }, undefined, 2)}\n`;
}

/** A name that a file of spools may have. @param taken  names of others */
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

/** With another one, which takes the place of one of its name. */
export const withOne = (spools: readonly OwnSpool[], spool: OwnSpool): OwnSpool[] =>
  [...spools.filter(({ key }) => key !== spool.key), spool].sort((a, b) => a.key.localeCompare(b.key, 'en'));
