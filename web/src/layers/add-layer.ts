// Adds layers of a given kind, or from files whose bytes decide on the kind.
import { words } from '../i18n/en/files.js';
import { l } from '../i18n/layers.js';
import { say, t } from '../i18n/text.js';
import { StudioError } from '../model/problem.js';
import type { Point } from '../model/layer-frame.js';
import {
  changeLayer,
  duplicated,
  isFontFile,
  layerOf,
  middleOf,
  mostLayers,
  newLayer,
  nextLayerId,
  withLayer,
} from '../model/layer-list.js';
import { layerTable } from '../model/layer-table.js';
import { needsFile, type LayerKind, type LayerValues } from '../model/layers.js';
import type { Plate, PlateLayer, SourceFile } from '../model/plate.js';
import { without } from '../model/without.js';
import type { Studio } from '../studio/studio.js';
import { chosenLayer } from './arranging.js';
import { withPlaces } from './placing.js';

export const drawingFiles = '.svg,.svgz,.png,.jpg,.jpeg,image/*';
export const pictureFiles = '.png,.jpg,.jpeg,image/*';
export const fontFiles = '.ttf,.otf,.woff,.woff2';

const newPicture = (plate: Plate, file: SourceFile): LayerValues =>
  newLayer(plate, 'picture', { pictures: [{ file, lamp: null }] });

/** Puts layers on top, as one undo step, and chooses the last of them.
 * @param at  place to which a hand has dragged the first [mm]; undefined: any free place
 * @returns false where there is nothing to add, or the plate cannot take all of them */
async function put(studio: Studio, made: (plate: Plate) => readonly LayerValues[], at?: Point): Promise<boolean> {
  const wanted = made(studio.store.state.plate);
  if (wanted.length === 0) return false;
  const values = await withPlaces(studio, wanted, at);
  if (studio.store.state.plate.layers.length + values.length > mostLayers) {
    studio.notify(l('full', { n: mostLayers }));
    return false;
  }
  studio.settle();
  studio.change((now) => values.reduce(withLayer, now));
  studio.store.set({ layer: nextLayerId(studio.store.state.plate) - 1, cropping: false, tool: 'pan' });
  return true;
}

const isDrawing = ({ bytes }: SourceFile): boolean => bytes.type === 'image/svg+xml';

/** Appends ".ttf" to the name of a font file if the core would not recognise the file as a font by its name. */
export const namedFont = (file: SourceFile): SourceFile =>
  isFontFile(file.name) ? file : { ...file, name: `${file.name}.ttf` };

interface ReadLayerFile {
  file: SourceFile;
  isFont: boolean;
}

/** Reads files that layers can be made of, and reports why others cannot be used. A project among them is opened
 * instead. */
async function readAll(studio: Studio, files: readonly File[]): Promise<ReadLayerFile[]> {
  const { readFile } = await import('../files/open.js');
  const found: ReadLayerFile[] = [];
  for (const given of files) {
    await studio.attempt(async () => {
      const { source, kind, notes } = await readFile(given);
      if (kind === 'zip' || kind === 'json') {
        await studio.open([given]);
        return;
      }
      for (const note of notes) studio.notify(say(words, `files.${note}`));
      found.push({ file: kind === 'font' ? namedFont(source) : source, isFont: kind === 'font' });
    });
  }
  return found;
}

/** Asks the visitor for one file. @returns undefined where none was chosen, or it cannot be used */
export async function chosenFile(studio: Studio, accept: string): Promise<SourceFile | undefined> {
  const [given] = await studio.pick(accept);
  return given && oneFile(studio, [given], accept);
}

/** The first of the files, if it is of an accepted kind. @returns undefined otherwise, after telling the visitor */
export async function oneFile(studio: Studio, files: readonly File[], accept: string): Promise<SourceFile | undefined> {
  const wanted = accept === fontFiles;
  const [found] = await readAll(studio, files.slice(0, 1));
  if (found === undefined) return undefined;
  if (found.isFont === wanted && (accept !== pictureFiles || !isDrawing(found.file))) return found.file;
  studio.fail(new StudioError('UnknownFile', { name: found.file.name }));
  return undefined;
}

/** Switches to the panel of layers if a panel is open; otherwise the plate stays uncovered. */
function showLayers(studio: Studio): void {
  if (studio.store.state.panel !== '') studio.setPanel('layers');
}

/** Makes a layer of each file: a drawing, a picture, or a text in that font. The first font goes to the chosen text, if
 * there is one.
 * @param at  place where the first layer was dropped [mm] */
export async function addFiles(studio: Studio, files: readonly File[], at?: Point): Promise<void> {
  const found = await readAll(studio, files);
  const chosen = chosenLayer(studio.store.state);
  const font = chosen?.kind === 'text' ? found.find(({ isFont }) => isFont) : undefined;
  if (chosen !== undefined && font !== undefined) {
    studio.settle();
    studio.change((plate) => changeLayer(plate, chosen.id, () => ({ font: font.file })));
  }
  const layers = (plate: Plate): LayerValues[] =>
    found
      .filter((one) => one !== font)
      .map(({ file, isFont }) => {
        if (isFont) return newLayer(plate, 'text', { font: file });
        return isDrawing(file) ? newLayer(plate, 'drawing', { file }) : newPicture(plate, file);
      });
  await put(studio, layers, at);
  if (found.length > 0) showLayers(studio);
}

/** Adds a layer of text. @param at  place where it was dropped [mm] */
export async function addText(studio: Studio, letters: string, at?: Point): Promise<void> {
  const text = letters.replaceAll('\r\n', '\n').trim();
  const { maxBytes } = layerTable.text;
  const length = new TextEncoder().encode(text).length;
  if (length > maxBytes) studio.notify(t('setting.tooLong', { name: l('kind.text'), length, max: maxBytes }));
  else if (text !== '' && (await put(studio, (plate) => [newLayer(plate, 'text', { text })], at))) showLayers(studio);
}

/** Puts a copy above a layer, at a free place. */
export async function duplicate(studio: Studio, layer: PlateLayer): Promise<void> {
  const [values] = await withPlaces(studio, [
    { ...without(layer, 'id'), at: middleOf(studio.store.state.plate, layer) },
  ]);
  const { plate } = studio.store.state;
  const next = nextLayerId(plate);
  if (values === undefined || layerOf(plate, layer.id) === undefined) return; // the layer was deleted meanwhile
  if (plate.layers.length >= mostLayers) {
    studio.notify(l('full', { n: mostLayers }));
    return;
  }
  studio.settle();
  studio.change((now) => duplicated(now, layer.id, values));
  studio.store.set({ layer: next, cropping: false });
}

/** Adds a layer of this kind, and asks for its file where it needs one. @returns false where none was added */
export async function addLayer(studio: Studio, kind: LayerKind): Promise<boolean> {
  const fresh = newLayer(studio.store.state.plate, kind);
  if (kind !== 'picture' && !needsFile(fresh)) return put(studio, (plate) => [newLayer(plate, kind)]);
  const file = await chosenFile(studio, kind === 'drawing' || kind === 'tones' ? drawingFiles : pictureFiles);
  return (
    file !== undefined &&
    put(studio, (plate) => [kind === 'picture' ? newPicture(plate, file) : newLayer(plate, kind, { file })])
  );
}
