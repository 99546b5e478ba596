// Drawings that nobody here made: packages of the npm registry, fetched into a folder. None is part of this project.
//
//   node tests/independent/drawings.mjs FOLDER   fetches them, and prints the drawings, one a line
import { spawnSync } from 'node:child_process';
import { existsSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

/** Where each package has its drawings, and how many of them are looked at. */
const packages = {
  'simple-icons@16.37.0': ['icons', 60],
  '@tabler/icons@3.51.0': ['icons', 90],
  'bootstrap-icons@1.13.2': ['icons', 60],
  '@mdi/svg@7.4.47': ['svg', 50],
  '@fortawesome/fontawesome-free@7.3.1': ['svgs', 60],
  'lucide-static@1.62.0': ['icons', 50],
  'feather-icons@4.29.2': ['dist/icons', 30],
  'devicon@2.17.0': ['icons', 150],
  'flag-icons@7.5.0': ['flags', 40],
};

const homeOf = (folder, name) => join(folder, 'node_modules', name.slice(0, name.lastIndexOf('@')));

/** @param more  packages besides. @returns why there are none; empty: they are there */
export function fetchDrawings(folder, more = []) {
  const names = [...Object.keys(packages), ...more];
  if (names.every((name) => existsSync(homeOf(folder, name)))) return '';
  const npm = spawnSync(
    'npm',
    ['install', '--silent', '--ignore-scripts', '--no-audit', '--no-fund', '--fetch-retries=0', '--prefix', folder, ...names],
    { encoding: 'utf8', shell: process.platform === 'win32' },
  );
  return npm.status === 0 ? '' : 'skipped: the npm registry cannot be reached';
}

/** Spread evenly over each package, the same each time. */
export const drawingsIn = (folder) =>
  Object.entries(packages).flatMap(([name, [place, count]]) => {
    const home = join(homeOf(folder, name), place);
    const files = readdirSync(home, { recursive: true })
      .filter((file) => file.endsWith('.svg'))
      .sort();
    return Array.from({ length: count }, (_, k) => join(home, files[Math.floor(((k + 0.5) * files.length) / count)]));
  });

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) {
  const folder = process.argv[2];
  const missing = fetchDrawings(folder);
  if (missing === '') console.log(drawingsIn(folder).join('\n'));
  else console.error(missing);
}
