// What a plate was made of before another card was tried: to come back to it asks for no file again.
import type { DirectionSource, Plate, SourceFile } from './plate.js';

export type Kind = DirectionSource['kind'];

export interface Left {
  /** The latest last. */
  directions: ReadonlyMap<Kind, DirectionSource>;
  /** From a file. */
  shape?: Pick<Plate, 'shape' | 'width' | 'height'>;
}

export const nothingLeft: Left = { directions: new Map() };

export const filesIn = (source: DirectionSource): readonly SourceFile[] =>
  'file' in source ? [source.file] : source.kind === 'lamp' ? source.pictures.map(({ file }) => file) : [];

/** What directions can be told from: the plate's own file, else that which was left last. */
export const filesFor = ({ directions }: Plate, left: Left): SourceFile[] =>
  [directions, ...[...left.directions.values()].reverse()].flatMap(filesIn);

export function leaving({ directions }: Plate, left: Left): Left {
  const others = [...left.directions].filter(([kind]) => kind !== directions.kind);
  return { ...left, directions: new Map([...others, [directions.kind, directions]]) };
}
