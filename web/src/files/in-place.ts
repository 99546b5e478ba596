// Files that can be written back to where they were opened, in browsers that provide file handles.

interface Picker {
  showOpenFilePicker?(options: { multiple: boolean }): Promise<FileSystemFileHandle[]>;
}
interface Writable extends FileSystemFileHandle {
  requestPermission?(options: { mode: 'readwrite' }): Promise<PermissionState>;
}

const isAbort = (error: unknown): boolean => error instanceof Error && error.name === 'AbortError';

type Handles = WeakMap<File, FileSystemHandle>;

/** Opens files. @param handles  receives their handles */
export const filesOf = (opened: readonly FileSystemFileHandle[], handles: Handles): Promise<File[]> =>
  Promise.all(
    opened.map(async (handle) => {
      const file = await handle.getFile();
      handles.set(file, handle);
      return file;
    }),
  );

/** Asks the visitor for files; empty where the dialog is dismissed. @param handles  receives their handles */
export async function pickInPlace(handles: Handles): Promise<File[]> {
  try {
    return await filesOf((await (window as Picker).showOpenFilePicker?.({ multiple: true })) ?? [], handles);
  } catch (error) {
    if (isAbort(error)) return [];
    throw error;
  }
}

/** Writes a file back. @returns false where the visitor does not allow it, so that the file must be downloaded
 * instead */
export async function writeBack(handle: FileSystemFileHandle, bytes: Blob): Promise<boolean> {
  const may = await (handle as Writable).requestPermission?.({ mode: 'readwrite' });
  if (may !== undefined && may !== 'granted') return false;
  // The file is replaced only when all bytes have been written, so a failure leaves it as it was.
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
