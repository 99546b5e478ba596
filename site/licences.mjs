// Licences of what the studio holds, from the packages themselves: node site/licences.mjs prints them.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { root } from './pages.mjs';

const at = (path) => join(root, path);

/** @returns one text */
export function licences() {
  const { packages } = JSON.parse(readFileSync(at('package-lock.json'), 'utf8'));
  const parts = Object.entries(packages).filter(([path, { dev, link }]) => /^node_modules/.test(path) && !dev && !link);
  const texts = parts.map(([path, { version, license }]) => {
    const name = readdirSync(at(path)).find((file) => /^licen[cs]e/i.test(file));
    const text = name === undefined ? '' : readFileSync(at(join(path, name)), 'utf8').trim();
    return `${path.slice('node_modules/'.length)} ${version}: ${license}\n\n${text}\n`;
  });
  return ['Sillon: MIT\n', readFileSync(at('LICENSE'), 'utf8'), ...texts].join('\n========\n\n');
}

if (process.argv[1] === fileURLToPath(import.meta.url)) process.stdout.write(licences());
