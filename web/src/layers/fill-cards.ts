// Cards for the fills; choosing one replaces the ground.
import { html, type TemplateResult } from 'lit';
import { cards, type Option } from '../controls/fields.js';
import { t } from '../i18n/text.js';
import {
  filledWith,
  groundFill,
  groundOf,
  isPictureFill,
  patternFills,
  pictureFills,
  type Fill,
  type PictureFill,
} from '../model/fills.js';
import { lampFor } from '../model/lamp.js';
import type { LayerValues } from '../model/layers.js';
import { filesFor, leaving, leftOf } from '../model/left.js';
import type { SourceFile } from '../model/plate.js';
import type { Studio } from '../studio/studio.js';
import { pictureFiles } from './add-layer.js';
import { fillIcons } from './icons.js';

export type FillGroup = 'pictures' | 'patterns';

/** A card for each fill, in groups. @param pictureOf  address of a picture of the plate with this fill */
export function fillCards(
  studio: Studio,
  pictureOf: (fill: Fill) => string | undefined,
  groups: readonly FillGroup[] = ['pictures', 'patterns'],
): TemplateResult {
  const { plate } = studio.store.state;
  const option = (value: Fill): Option<Fill> => ({
    value,
    label: t(`source.${value}`),
    icon: fillIcons[value],
    picture: pictureOf(value),
  });
  const fillsOf = { pictures: pictureFills, patterns: patternFills };
  const group = (id: FillGroup): TemplateResult =>
    html`<h3>${t(`source.${id}`)}</h3>
      ${cards<Fill>({
        id: `source-${id}`,
        label: t(`source.${id}`),
        value: groundFill(plate),
        options: fillsOf[id].map(option),
        onChoose: (chosen) => void chooseFill(studio, chosen),
      })}`;
  return html`${groups.map(group)}`;
}

/** Fills the plate with something else, and asks for a file where the fill needs one and none is known. */
export async function chooseFill(studio: Studio, fill: Fill): Promise<void> {
  const { plate } = studio.store.state;
  if (fill === groundFill(plate)) return;
  if (!isPictureFill(fill)) {
    use(studio, fill, leftOf(studio.left, fill, undefined));
    return;
  }
  const file = fileFor(studio, fill);
  if (file !== undefined) {
    await useFile(studio, fill, file);
    return;
  }
  const files = await studio.pick(pictureFiles); // the card stays as it was until a picture is there
  if (files.length === 0) return;
  await studio.open(files, fill === 'colours' ? fill : undefined);
  const opened = fileFor(studio, fill);
  if (opened !== undefined && groundFill(studio.store.state.plate) !== fill) await useFile(studio, fill, opened);
}

/** A known file from which the directions of this fill can come. */
function fileFor({ store, left }: Studio, fill: PictureFill): SourceFile | undefined {
  const { plate } = store.state;
  if (fill === 'colours' && plate.shape.kind === 'file') return plate.shape.file;
  const isSvg = ({ bytes }: SourceFile): boolean => bytes.type === 'image/svg+xml';
  const drawn = fill !== 'picture' && fill !== 'map'; // pictures and maps need pixels, all other fills accept drawings
  return filesFor(plate, left).find((file) => drawn || !isSvg(file));
}

/** Fills the plate from a file, with the values that it had there before, if any. */
async function useFile(studio: Studio, fill: PictureFill, file: SourceFile): Promise<void> {
  const before = leftOf(studio.left, fill, file);
  if (before !== undefined) use(studio, fill, before);
  else if (fill === 'picture') {
    use(studio, fill, { pictures: [{ file, lamp: lampFor([], studio.homeLight()) }] });
  } else if (fill === 'colours') {
    await studio.attempt(async () => {
      const [{ coloursOf }, running] = await Promise.all([import('../files/drawn.js'), studio.services.engine()]);
      use(studio, fill, { file, colours: await coloursOf(file, running) });
    });
  } else use(studio, fill, { file });
}

/** Fills the plate, and remembers the ground that is replaced. */
function use(studio: Studio, fill: Fill, given: Partial<LayerValues> = {}): void {
  const { plate: before } = studio.store.state;
  studio.left = leaving(before, studio.left);
  studio.change((plate) => filledWith(plate, fill, given));
  // The new ground becomes the chosen layer, so that the cards stay visible.
  if (groundOf(before) === undefined) studio.store.set({ layer: groundOf(studio.store.state.plate)?.id });
}
