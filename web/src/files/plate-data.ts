// A plate as data without bytes, for projects and storage; model/check-plate.ts reads it again.
import type { Plate, SourceFile } from '../model/plate.js';

/** Each once. */
export function filesOf({ shape, directions, modes }: Plate): SourceFile[] {
  const files = [shape, directions, modes].flatMap((part) =>
    'file' in part && part.file !== undefined ? [part.file] : [],
  );
  if (directions.kind === 'lamp') files.push(...directions.pictures.map(({ file }) => file));
  return [...new Map(files.map((file) => [file.id, file])).values()];
}

/** @param told  what stands for a file */
export function plateData(plate: Plate, told: (file: SourceFile) => unknown): unknown {
  const part = (source: object & { file?: SourceFile }): object =>
    source.file === undefined ? source : { ...source, file: told(source.file) };
  const { directions } = plate;
  return {
    ...plate,
    shape: part(plate.shape),
    directions:
      directions.kind === 'lamp' ? { ...directions, pictures: directions.pictures.map(part) } : part(directions),
    modes: part(plate.modes),
  };
}
