// The 3D body that a plate lies on. The plate is one of its level top faces, and slicers get both together.
import { fieldsOf, numberIn, textIn, Unfit } from './check.js';
import type { Body, Plate, SourceFile } from './plate.js';
import { StudioError } from './problem.js';

const furthest = 10_000; // [mm], the core's own limit for coordinates

const same = (a: number, b: number): boolean => Math.abs(a - b) < 0.01;

/** The body and its face for the engine, in mm.
 * @throws StudioError InvalidArgument with the reason OffBody where the plate is no longer that face */
export function bodyInput({ shape, width, height, body }: Plate) {
  if (body === undefined) return undefined;
  const [x, y, z] = body.face;
  const isFace = shape.kind === 'file' && shape.file.id === body.outline;
  if (!isFace || !same(width, body.size[0]) || !same(height, body.size[1]))
    throw new StudioError('InvalidArgument', { reason: 'OffBody', name: body.file.name });
  const grown = Math.max(0, shape.offset); // the page is this much larger on each side
  return { body: body.file.bytes, face: [x - grown, y - grown, z] as const };
}

/** The body's part of a project, with a path in place of its file. */
export const toldBody = ({ body }: Plate, pathOf: (file: SourceFile) => string): object =>
  body === undefined ? {} : { body: { ...body, file: pathOf(body.file) } };

const pairOf = (value: unknown, where: string): unknown[] => {
  if (!Array.isArray(value)) throw new Unfit(where, value);
  return value as unknown[];
};

/** Reads the body's part of a project; empty where the project has none.
 * @param fileAt  finds a file of the project by its path
 * @throws Unfit for values that no plate can have, and the errors of `fileAt` */
export async function bodyFrom(
  value: unknown,
  fileAt: (path: string) => Promise<SourceFile | undefined>,
): Promise<{ body?: Body }> {
  if (value === undefined) return {};
  const fields = fieldsOf(value, 'studio.body', ['file', 'face', 'size', 'outline']);
  const [x, y, z] = pairOf(fields['face'], 'studio.body.face');
  const [width, height] = pairOf(fields['size'], 'studio.body.size');
  const number = (one: unknown): number => numberIn(one, 'studio.body', -furthest, furthest);
  const file = await fileAt(textIn(fields['file'], 'studio.body.file', 1000));
  if (file === undefined) throw new Unfit('studio.body.file', fields['file']);
  return {
    body: {
      file,
      face: [number(x), number(y), number(z)],
      size: [number(width), number(height)],
      outline: textIn(fields['outline'], 'studio.body.outline', 1000),
    },
  };
}
