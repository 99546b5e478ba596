// Offers to use a text that was pasted or dropped on a plate without layers: on an untouched plate as a name sign,
// otherwise as letters where there is room. The text may have come by mistake, so it is not used at once.
import { words } from '../i18n/en/files.js';
import { say, t } from '../i18n/text.js';
import { addText } from '../layers/add-layer.js';
import { newPlateOn } from '../model/brought.js';
import { inLines } from '../model/in-lines.js';
import { nextLayerId } from '../model/layer-list.js';
import type { Plate } from '../model/plate.js';
import { templates } from '../plates/templates.js';
import type { Studio } from '../studio/studio.js';
import { layersFor } from './example-layers.js';

/** Most letters that are offered: with more, they would be lower than ten beads on a name sign. */
export const mostLetters = 120;
const shownLetters = 40;
const mostOfName = 80; // most letters of a name, as in its field
const room = { width: 0.83, height: 0.6 }; // shares of the sign, within its border

/** Tells whether nobody has changed the plate yet. */
function isUntouched({ store }: Studio): boolean {
  const { plate, welcome } = store.state;
  const parts = ({ name, shape, layers, width, height }: Plate): string =>
    JSON.stringify([name, shape, layers, width, height]);
  return welcome || parts(plate) === parts(newPlateOn(plate.printer));
}

/** Returns the example's name sign with other letters, as large as its border allows. */
async function signOf(studio: Studio, text: string): Promise<Plate> {
  const sign = templates.find(({ id }) => id === 'nameSign');
  if (sign === undefined || typeof sign.shape === 'string') throw new Error('there is no name sign');
  const { width, height, shape } = sign;
  const layers = await layersFor(sign.layers, () => Promise.reject(new Error('a name sign has no files')));
  const plate: Plate = {
    ...studio.store.state.plate,
    name: Array.from(text.replaceAll('\n', ' ')).slice(0, mostOfName).join(''),
    shape,
    width,
    height,
    layers: layers.map((layer) => (layer.kind === 'text' ? { ...layer, text, size: [0, 0] } : layer)),
  };
  const boxes = await studio.services.layerBoxes(plate);
  const fitted = plate.layers.map((layer) => {
    const size = boxes.get(layer.id)?.size;
    if (layer.kind !== 'text' || size === undefined) return layer;
    const scale = Math.min((room.width * width) / size[0], (room.height * height) / size[1]);
    return { ...layer, textSize: Math.max(1, Math.floor(10 * scale * layer.textSize) / 10) };
  });
  return { ...plate, layers: fitted };
}

/** Makes a sign of an untouched plate, or adds the text to it. */
async function make(studio: Studio, text: string): Promise<void> {
  const { store } = studio;
  studio.settle();
  studio.show(undefined); // a plate must not change behind a sheet
  if (store.state.mode === 'edit' && isUntouched(studio)) {
    const plate = await signOf(studio, text);
    studio.change(() => plate);
    store.set({ layer: nextLayerId(plate) - 1 });
    studio.stage?.fit();
  } else await addText(studio, text);
  const made = store.state.plate;
  studio.notify(say(words, 'files.textMade'), {
    label: t('verb.undo'),
    run: () => {
      if (store.state.plate === made) store.undo();
    },
  });
}

/** Offers a text. @param given  text as it came; an empty one, or one that is too long for a plate, is not offered */
export function offerText(studio: Studio, given: string): void {
  const text = given.replaceAll('\r\n', '\n').trim();
  const letters = Array.from(text);
  if (letters.length > mostLetters) {
    studio.notify(say(words, 'files.textLong', { length: letters.length, max: mostLetters }));
    return;
  }
  if (text === '') return;
  const shown = letters.length > shownLetters ? `${letters.slice(0, shownLetters).join('')}…` : text;
  studio.notify(say(words, 'files.text', { text: shown }), {
    label: say(words, 'files.makeText'),
    run: () => void studio.attempt(() => make(studio, inLines(text))),
  });
}
