// Takes content that is dropped or pasted. While layers are in use, files and texts become layers; otherwise files make
// a plate, and texts are offered.
import { addFiles, addText } from '../layers/add-layer.js';
import type { Point } from '../model/layer-frame.js';
import { pageOf } from '../model/plate.js';
import { openAddress } from '../studio/addresses.js';
import { composes, offers } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';

/** Place of a pointer [CSS pixels]. */
export type PointerPlace = Pick<MouseEvent, 'clientX' | 'clientY'>;

export interface Handed {
  files: File[];
  text: string;
  address: string;
  at: PointerPlace | undefined;
  /** The files are meant for the plate's shape. */
  onShape?: boolean;
  /** Handle of the only file. */
  handle?: Promise<FileSystemHandle | null> | undefined;
}

/** Converts a pointer's place. @returns the place on the page [mm]; undefined: beside the plate */
function placeOf({ stage, store }: Studio, at: PointerPlace | undefined): Point | undefined {
  if (stage === undefined || at === undefined) return undefined;
  const canvas = stage.getBoundingClientRect();
  const { left, top, width, height } = stage.plateBox();
  const [x, y] = [(at.clientX - canvas.left - left) / width, (at.clientY - canvas.top - top) / height];
  const [wide, tall] = pageOf(store.state.plate);
  return x >= 0 && x <= 1 && y >= 0 && y <= 1 ? [x * wide, (1 - y) * tall] : undefined;
}

/** Returns a drawing that was copied as text. */
const drawingOf = (text: string): File[] =>
  /^\s*</.test(text) && text.includes('<svg') ? [new File([text], 'pasted.svg', { type: 'image/svg+xml' })] : [];

/** Uses content that was handed to the page. @throws errors of opening files */
export async function takeIn(studio: Studio, { text, address, at, onShape, handle, ...given }: Handed): Promise<void> {
  const files = given.files.length > 0 ? given.files : address === '' ? drawingOf(text) : [];
  const composing = composes(studio.store.state);
  const place = placeOf(studio, at);
  const [file] = files;
  if (file === undefined) {
    const linked = address === '' ? text : address;
    if (/^\s*https?:\/\/\S+\s*$/i.test(linked)) openAddress(studio, linked);
    else if (composing) {
      studio.show(undefined);
      await addText(studio, text, place);
    } else if (offers(studio.store.state, 'layers')) {
      (await import('./offer-text.js')).offerText(studio, text);
    }
    return;
  }
  const found = await handle;
  if (found?.kind === 'file') studio.handles.set(file, found);
  studio.show(undefined); // a plate must not change behind a sheet
  const { onePrint } = await import('../files/open.js');
  if (onShape) await studio.open(files, 'shape');
  else if (!composing || (await onePrint(files)) !== '') await studio.open(files);
  else await addFiles(studio, files, place);
}
