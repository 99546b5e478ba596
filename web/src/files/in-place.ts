// Files that can be written back where they were opened, in browsers that lend their handles.

interface Picker {
  showOpenFilePicker?(options: { multiple: boolean }): Promise<FileSystemFileHandle[]>;
}
interface Writable extends FileSystemFileHandle {
  requestPermission?(options: { mode: 'readwrite' }): Promise<PermissionState>;
}

const isAbort = (error: unknown): boolean => error instanceof Error && error.name === 'AbortError';

/** Asks for files; none where the question is dismissed. @param handles  gets theirs */
export async function pickInPlace(handles: WeakMap<File, FileSystemHandle>): Promise<File[]> {
  try {
    const picked = (await (window as Picker).showOpenFilePicker?.({ multiple: true })) ?? [];
    return await Promise.all(
      picked.map(async (handle) => {
        const file = await handle.getFile();
        handles.set(file, handle);
        return file;
      }),
    );
  } catch (error) {
    if (isAbort(error)) return [];
    throw error;
  }
}

/** @returns whether it was written: the visitor may say no, and then it is for the downloads */
export async function writeBack(handle: FileSystemFileHandle, bytes: Blob): Promise<boolean> {
  const may = await (handle as Writable).requestPermission?.({ mode: 'readwrite' });
  if (may !== undefined && may !== 'granted') return false;
  // The file changes when all of it is there, and not at all where that fails.
  const stream = await handle.createWritable();
  try {
    await stream.write(bytes);
  } catch (error) {
    await stream.abort().catch(() => undefined);
    throw error;
  }
  await stream.close();
  return true;
}
