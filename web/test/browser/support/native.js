// What the native program makes of the studio's projects.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { unzipSync } from 'fflate';

const program = fileURLToPath(new URL('../../../../build/release/sillon', import.meta.url));

/** The G-code that the native program makes from the project file, with the same date. */
export function natively(project, gcode) {
  const folder = mkdtempSync(join(tmpdir(), 'sillon-flow-'));
  try {
    for (const [name, bytes] of Object.entries(unzipSync(project))) {
      mkdirSync(dirname(join(folder, name)), { recursive: true });
      writeFileSync(join(folder, name), bytes);
    }
    const date = /(\d{4}-\d\d-\d\d) at (\d\d:\d\d:\d\d) UTC/.exec(gcode);
    assert.ok(date, 'the file tells no date');
    const epoch = String(Date.parse(`${date[1]}T${date[2]}Z`) / 1000);
    const out = join(folder, 'native.gcode');
    execFileSync(program, ['generate', join(folder, 'project.json'), '--gcode', out], {
      env: { ...process.env, SOURCE_DATE_EPOCH: epoch },
    });
    return readFileSync(out, 'utf8');
  } finally {
    rmSync(folder, { recursive: true });
  }
}
