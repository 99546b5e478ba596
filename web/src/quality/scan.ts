// Tells whether a phone would read the topmost QR code of the plate: a decoder looks at its computed look under lamps all around.
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

/** As a phone sees it from so far that single beads are no longer seen [pixels]. */
const pixelsPerModule = 5;

/** Modules along a side of a code that says so many bytes, about: the least has 21, and each larger size 4 more for some 16. */
const modulesFor = (bytes: number): number => 21 + 4 * Math.ceil(Math.max(0, bytes - 14) / 16);

/** Width of a picture of the plate in which the modules are large enough [pixels]. */
async function widthFor(plate: Plate, id: number, text: string, engine: Engine): Promise<number> {
  const side = (await layerBoxes(plate, engine)).get(id)?.size[0] ?? pageOf(plate)[0];
  const modules = modulesFor(new TextEncoder().encode(text).length);
  const pixels = (pixelsPerModule * modules * pageOf(plate)[0]) / side;
  return Math.round(Math.min(1024, Math.max(64, pixels)));
}

const asked = (worker: Worker, request: ScanRequest): Promise<boolean> =>
  new Promise((resolve, reject) => {
    worker.onmessage = ({ data }: MessageEvent<boolean>) => {
      resolve(data);
    };
    worker.onerror = ({ message }) => {
      reject(new Error(message));
    };
    worker.postMessage(request);
  });

/** @returns azimuths under which the code is read [degrees], 0 to 165; undefined where another plate came meanwhile */
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
