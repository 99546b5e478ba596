// Takes in what is dropped or pasted: files and texts become layers while layers are in use, else a plate is made of files, and
// texts are offered to be one.
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

/** @returns the place on the page [mm]; undefined: beside the plate */
function placeOf({ stage, store }: Studio, at: PointerPlace | undefined): Point | undefined {
  if (stage === undefined || at === undefined) return undefined;
  const canvas = stage.getBoundingClientRect();
  const { left, top, width, height } = stage.plateBox();
  const [x, y] = [(at.clientX - canvas.left - left) / width, (at.clientY - canvas.top - top) / height];
  const [wide, tall] = pageOf(store.state.plate);
  return x >= 0 && x <= 1 && y >= 0 && y <= 1 ? [x * wide, (1 - y) * tall] : undefined;
}

/** A drawing that was copied as text. */
const drawingOf = (text: string): File[] =>
  /^\s*</.test(text) && text.includes('<svg') ? [new File([text], 'pasted.svg', { type: 'image/svg+xml' })] : [];

/** @throws what opening files throws */
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
  studio.show(undefined); // no plate changes behind a sheet
  const { onePrint } = await import('../files/open.js');
  if (onShape) await studio.open(files, 'shape');
  else if (!composing || (await onePrint(files)) !== '') await studio.open(files);
  else await addFiles(studio, files, place);
}
