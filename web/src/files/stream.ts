/** Reads a stream to its end. @param tooLong  error for more than `most` bytes: a small file may unpack to any size, and
 * servers send wrong lengths */
export async function readAll(
  stream: ReadableStream<Uint8Array<ArrayBuffer>>,
  most: number,
  tooLong: (bytes: number) => Error,
): Promise<Blob> {
  const pieces: Uint8Array<ArrayBuffer>[] = [];
  let size = 0;
  const reader = stream.getReader();
  for (let next = await reader.read(); !next.done; next = await reader.read()) {
    size += next.value.length;
    if (size > most) {
      void reader.cancel().catch(() => undefined);
      throw tooLong(size);
    }
    pieces.push(next.value);
  }
  return new Blob(pieces);
}
