// Tells whether a phone would read the topmost QR code of the plate: a decoder looks at the plate's computed appearance
// under lamps from all sides.
import type { Engine } from 'sillon';
import { layerBoxes } from '../engine/layer-boxes.js';
import { startWorker } from '../engine/start-worker.js';
import { usualLight } from '../model/lamp.js';
import { drawnLayers } from '../model/layers.js';
import { viewLook } from '../model/filaments.js';
import { pageOf, type Plate } from '../model/plate.js';
import type { PlateResult } from '../model/state.js';
import scanWorker from '../views/scan.worker.ts?worker&url';
import type { ScanRequest } from '../views/scan.worker.js';
import './scan-note.js';
import { step } from './stretches.js';

/** Pixels per module, as a phone sees a code from so far away that single beads blur. */
const pixelsPerModule = 5;

/** Approximate number of modules along a code's side for this many bytes: 21 for the smallest code, and 4 more for
 * about every 16 bytes. */
const modulesFor = (bytes: number): number => 21 + 4 * Math.ceil(Math.max(0, bytes - 14) / 16);

/** Width of a picture of the plate that shows the modules at that size [pixels]. */
async function widthFor(plate: Plate, id: number, text: string, engine: Engine): Promise<number> {
  const side = (await layerBoxes(plate, engine)).get(id)?.size[0] ?? pageOf(plate)[0];
  const modules = modulesFor(new TextEncoder().encode(text).length);
  const pixels = (pixelsPerModule * modules * pageOf(plate)[0]) / side;
  return Math.round(Math.min(1024, Math.max(64, pixels)));
}

/** Asks the worker whether its decoder reads the text in a picture. */
const asked = (worker: Worker, request: ScanRequest): Promise<boolean> =>
  new Promise((resolve, reject) => {
    worker.onmessage = ({ data }: MessageEvent<boolean>) => resolve(data);
    worker.onerror = ({ message }) => reject(new Error(message));
    worker.postMessage(request);
  });

/** Finds the lamps under which the code is read.
 * @param wanted  false when another plate has come meanwhile
 * @returns azimuths [degrees], 0 to 165; undefined where the plate has no code, or is no longer wanted */
export async function scan(
  { plate, toolpath }: PlateResult,
  engine: Engine,
  wanted: () => boolean,
): Promise<number[] | undefined> {
  const code = drawnLayers(plate)
    .filter(({ kind }) => kind === 'code')
    .at(-1);
  if (code === undefined) return undefined;
  const { text } = code;
  const width = await widthFor(plate, code.id, text, engine);
  const worker = startWorker(scanWorker, 'scan');
  const read: number[] = [];
  try {
    for (let azimuth = 0; azimuth < 180; azimuth += step) {
      if (!wanted()) return undefined;
      const lamp = { lightAzimuth: azimuth, lightElevation: usualLight.elevation };
      const picture = await engine.renderPreview(toolpath, { panels: 'look', width, ...viewLook(plate), ...lamp });
      if (await asked(worker, { picture, text })) read.push(azimuth);
    }
  } finally {
    worker.terminate();
  }
  return wanted() ? read : undefined;
}
