// A plate as data without bytes, for projects and storage; model/check-plate.ts reads it again.
import { filesOfLayer, layerData } from '../model/layer-list.js';
import type { DirectionSource, Plate, SourceFile } from '../model/plate.js';

/** Each once. */
export function filesOf({ shape, directions, modes, layers }: Plate): SourceFile[] {
  const files = [shape, directions, modes].flatMap((part) =>
    'file' in part && part.file !== undefined ? [part.file] : [],
  );
  if (directions.kind === 'lamp') files.push(...directions.pictures.map(({ file }) => file));
  files.push(...layers.flatMap(filesOfLayer));
  return [...new Map(files.map((file) => [file.id, file])).values()];
}

/** @param told  what stands for a file */
export function partData(
  source: Plate['shape' | 'modes'] | DirectionSource,
  told: (file: SourceFile) => unknown,
): object {
  const part = (one: object & { file?: SourceFile }): object =>
    one.file === undefined ? one : { ...one, file: told(one.file) };
  return 'pictures' in source ? { ...source, pictures: source.pictures.map(part) } : part(source);
}

export const plateData = (plate: Plate, told: (file: SourceFile) => unknown): unknown => ({
  ...plate,
  shape: partData(plate.shape, told),
  directions: partData(plate.directions, told),
  modes: partData(plate.modes, told),
  layers: plate.layers.map((layer) => layerData(layer, told)),
});
