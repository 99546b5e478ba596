// What the native program makes of the studio's projects.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { unzipSync } from 'fflate';

const program = fileURLToPath(new URL('../../../../build/release/sillon', import.meta.url));

/** A file that the native program makes from the project file. @param epoch  its date [s] */
function madeOf(project, option, name, epoch) {
  const folder = mkdtempSync(join(tmpdir(), 'sillon-flow-'));
  try {
    for (const [name, bytes] of Object.entries(unzipSync(project))) {
      mkdirSync(dirname(join(folder, name)), { recursive: true });
      writeFileSync(join(folder, name), bytes);
    }
    const out = join(folder, name);
    execFileSync(program, ['generate', join(folder, 'project.json'), option, out], {
      env: { ...process.env, SOURCE_DATE_EPOCH: String(epoch) },
    });
    return readFileSync(out);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** When a G-code was written. */
export function dateOf(gcode) {
  const date = /(\d{4}-\d\d-\d\d) at (\d\d:\d\d:\d\d) UTC/.exec(gcode);
  assert.ok(date, 'the file tells no date');
  return new Date(`${date[1]}T${date[2]}Z`);
}

/** The G-code that the native program makes from the project file, with the same date. */
export const natively = (project, gcode) =>
  madeOf(project, '--gcode', 'native.gcode', dateOf(gcode).getTime() / 1000).toString('utf8');

/** The base layers as a solid. */
export const bodyNatively = (project) => madeOf(project, '--body', 'native.3mf', 0);
