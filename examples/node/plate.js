// A plate from a script: a disc whose beads run around its centre, as G-code.
//   node examples/node/plate.js disc.gcode
import { writeFile } from 'node:fs/promises';

import { createEngine, SillonError } from 'sillon';

/** Directions as pixels instead of a picture file: 0..65535 is -90..90°, row 0 on top. */
function rings(side) {
  const samples = new Uint16Array(side * side);
  for (let row = 0; row < side; ++row) {
    for (let column = 0; column < side; ++column) {
      const ray = Math.atan2(side / 2 - row - 0.5, column + 0.5 - side / 2);
      const turns = (ray + Math.PI / 2) / Math.PI + 0.5; // a bead has no sense: half turns are the same
      samples[row * side + column] = Math.round((turns - Math.floor(turns)) * 65535);
    }
  }
  return { width: side, height: side, channels: 1, samples };
}

const engine = await createEngine();
try {
  const { toolpath, report } = await engine.generateToolpath(
    { shape: { builtin: 'disc', size: [60, 60] }, layers: [{ kind: 'map', file: rings(512) }] },
    { spacing: 0.45, perimeterMode: 'soft' },
  );
  const { blob, summary } = await engine.writeGcode(toolpath, { nozzleTemperature: 210 }, { layers: 2 });
  await writeFile(process.argv[2] ?? 'disc.gcode', Buffer.from(await blob.arrayBuffer()));
  console.log(`${report.toolpaths} toolpath, coverage ${report.coverage} %, alignment ${report.alignment}`);
  console.log(`${(summary.filamentMm / 1000).toFixed(2)} m filament, ${Math.round(summary.seconds / 60)} minutes`);
} catch (error) {
  if (!(error instanceof SillonError)) throw error;
  console.error(`${error.message}. ${error.hint}`);
  process.exitCode = 1;
} finally {
  engine.dispose();
}
