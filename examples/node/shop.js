// An upload becomes all that a shop shows and sells, in a folder: poster, view, G-code, and a JSON with grams and minutes.
//   node examples/node/shop.js upload.svg out/plates/42
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';

import { SillonError, preparePlate } from 'sillon';

const [upload, folder] = process.argv.slice(2);
try {
  const plate = await preparePlate(
    { shape: { file: await readFile(upload), pageWidth: 60 }, layers: [{ kind: 'direction', angle: 30 }] },
    { printer: { profile: 'prusa-mk4s', filament: 'pla' }, limits: { seconds: 30, memory: 256 } },
  );
  const { poster, view, gcode, page, grams, minutes, findings } = plate;
  const save = async (name, blob) => writeFile(join(folder, name), Buffer.from(await blob.arrayBuffer()));
  await mkdir(folder, { recursive: true });
  await save('poster.png', poster);
  await save('plate.view.png', view);
  await save('plate.gcode', gcode);
  await writeFile(join(folder, 'plate.json'), JSON.stringify({ page, grams, minutes, findings }));
  console.log(
    `${page.join(' x ')} mm, ${grams.toFixed(1)} g, ${Math.round(minutes)} minutes, ${findings.length} findings`,
  );
} catch (error) {
  if (!(error instanceof SillonError)) throw error;
  console.error(`${error.message}. ${error.hint}`);
  process.exitCode = 2; // the upload is refused; nothing was written
}
