// Whether a phone would read the QR code of the plate: its computed look under lamps all around, and a decoder.
import type { Engine } from 'sillon';
import { moduleShare } from '../generators/qr.js';
import { shapeRoom } from '../generators/shape-room.js';
import { usualLight } from '../model/lamp.js';
import { viewLook } from '../model/filaments.js';
import { isRound, roomShape } from '../model/result.js';
import { step } from './stretches.js';
import type { PlateResult } from '../model/state.js';
import { startWorker } from '../engine/start-worker.js';
import scanWorker from '../views/scan.worker.ts?worker&url';
import type { ScanRequest } from '../views/scan.worker.js';
import './scan-note.js';
import { pageOf } from '../model/plate.js';

/** As a phone sees it from so far that single beads are no longer seen [pixels]. */
const pixelsPerModule = 5;

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
  const { directions } = plate;
  if (directions.kind !== 'qr') return undefined;
  const { text } = directions;
  if (text === '') return []; // a decoder may well read nothing from a code of nothing
  const room = roomShape(plate) === undefined ? undefined : await shapeRoom(plate, engine);
  const share = await moduleShare(directions, pageOf(plate), isRound(plate), room);
  const width = Math.round(Math.min(1024, Math.max(64, pixelsPerModule / share)));
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
