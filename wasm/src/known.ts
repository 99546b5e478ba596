// Numbers by which the worker recognises values that it was given or has made, so that each travels only once.
import type * as api from '../sillon.js';
import type { Call, Known } from './protocol.js';

interface Mark {
  number: number;
  sum: number;
}

let last = 0;

export const newNumber = (): number => ++last;

/** Returns a 32-bit hash of the views' memory. A change of one word always changes it; larger changes almost always
 * do. */
function sumOf(views: readonly ArrayBufferView[]): number {
  let sum = 0x811c9dc5;
  for (const { buffer, byteOffset, byteLength } of views) {
    const wide = byteOffset % 4 === 0 ? byteLength >> 2 : 0;
    for (const word of new Int32Array(buffer, wide > 0 ? byteOffset : 0, wide)) sum = Math.imul(sum ^ word, 0x01000193);
    const rest = new Uint8Array(buffer, byteOffset + 4 * wide, byteLength - 4 * wide);
    for (const byte of rest) sum = Math.imul(sum ^ byte, 0x01000193);
    sum = Math.imul(sum ^ byteLength, 0x01000193);
  }
  return sum;
}

/** Function that returns all memory of an object's content; none for a Blob, which cannot change. */
type Memory = () => readonly ArrayBufferView[];
const nothing: Memory = () => [];

/** Marks of objects of one kind: the same file may be known as a print and as a picture. */
class Kind {
  readonly #marks = new WeakMap<object, Mark>();

  mark(object: object, number: number, memory = nothing): void {
    this.#marks.set(object, { number, sum: sumOf(memory()) });
  }

  /** Returns the object's number. The result is 0 if the object was never marked, or if its memory has changed since. */
  find(object: object, memory = nothing): number {
    const mark = this.#marks.get(object);
    return mark !== undefined && mark.sum === sumOf(memory()) ? mark.number : 0;
  }

  /** Returns the object's number; marks it if it has none. */
  numberOf(object: object, memory = nothing): number {
    const found = this.find(object, memory);
    if (found !== 0) return found;
    const number = newNumber();
    this.mark(object, number, memory);
    return number;
  }
}

/** Marks of lists of cycles. */
export const beads = new Kind();
/** Marks of files that the engine has written. */
export const gcodes = new Kind();
export const pictures = new Kind();
export const prints = new Kind();

const absent = new Uint8Array(0);

/** @param cycles  a list of cycles, or of whatever a user put in their place */
export const memoryOf =
  (cycles: readonly Partial<api.Cycle | undefined>[]): Memory =>
  () =>
    cycles.flatMap((cycle) => [cycle?.points, cycle?.widths].map((part) => (ArrayBuffer.isView(part) ? part : absent)));

type Change = <T>(part: Known<T>, name: string) => Promise<Known<T>>;

/** Returns the call with each part that the worker may know passed through `change`. */
export async function withKnown(call: Call, change: Change): Promise<Call> {
  const sent = { ...call };
  if ('file' in sent && sent.file !== undefined) sent.file = await change(sent.file, 'file');
  if ('toolpath' in sent) sent.toolpath = { ...sent.toolpath, cycles: await change(sent.toolpath.cycles, 'toolpath') };
  if ('below' in sent && sent.below !== undefined) {
    sent.below = { ...sent.below, cycles: await change(sent.below.cycles, 'below') };
  }
  if (!('files' in sent)) return sent;
  const files = { ...sent.files };
  for (const [name, part] of Object.entries(files)) files[name] = await change(part, name);
  return { ...sent, files };
}
