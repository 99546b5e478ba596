// Fetches the files that attributes name. Only http and https addresses and blobs of the page itself are allowed, since
// a stranger may have written the attributes.
import { readAll } from '../files/stream.js';
import { field, isFields, most } from './protocol.js';

export interface Asked {
  url: string;
  /** Role of the file, see `load` of the protocol. */
  role: string;
}

export interface Fetched {
  name: string;
  bytes: ArrayBuffer;
  role: string;
}

const allowed = ['http:', 'https:', 'blob:'];

/** Returns the last part of an address as a file name. */
function nameOf({ pathname }: URL): string {
  const last = pathname.split('/').at(-1) ?? '';
  try {
    return decodeURIComponent(last).slice(0, most.name) || 'file';
  } catch {
    return 'file';
  }
}

/** Fetches one file.
 * @param credentials  'same-origin' for the page's own files, 'omit' for those that a project names
 * @throws Error with one sentence for people; the signal's reason */
async function bytesAt(url: URL, credentials: RequestCredentials, signal?: AbortSignal): Promise<ArrayBuffer> {
  if (!allowed.includes(url.protocol)) throw new Error(`${url.protocol} addresses are not fetched`);
  let response: Response;
  try {
    response = await fetch(url, { credentials, signal: signal ?? null });
  } catch {
    signal?.throwIfAborted();
    throw new Error(
      `${url.href} could not be fetched: there is no connection, or its site is not there or does not allow this one to read it`,
    );
  }
  if (!response.ok) throw new Error(`${url.href} came with status ${response.status}`);
  if (response.body === null) return new ArrayBuffer(0);
  const tooLong = (): Error => new Error(`${url.href} has more than ${most.file} bytes; no more are allowed`);
  return (await readAll(response.body, most.file, tooLong)).arrayBuffer();
}

/** Returns the names of the files that a project needs, with the files that the studio drew from. */
function namedBy(bytes: ArrayBuffer): string[] {
  if (bytes.byteLength > most.text) return [];
  let project: unknown;
  try {
    project = JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    return [];
  }
  if (!isFields(project) || field(project, 'sillon') === undefined) return [];
  const listOf = (list: unknown): unknown[] => (Array.isArray(list) ? (list as unknown[]) : []);
  const layers = listOf(field(project, 'layers')).filter(isFields);
  const parts = [field(project, 'shape'), ...layers, ...layers.flatMap((layer) => listOf(field(layer, 'pictures')))];
  const studio = field(project, 'studio');
  const kept = isFields(studio) ? field(studio, 'files') : undefined;
  const named = ['file', 'maskFile', 'modeFile'];
  const own = parts.filter(isFields).flatMap((part) => named.map((key) => field(part, key)));
  const fonts = layers
    .map((layer) => field(layer, 'font'))
    .filter((font) => /\.(?:ttf|otf|ttc|woff2?)$/i.test(String(font)));
  const names = [...own, ...fonts, ...Object.keys(kept ?? {})];
  return [...new Set(names.filter((name): name is string => typeof name === 'string' && name !== ''))];
}

/** Resolves a file that a project names, only inside the project's folder and without a query: the project's author
 * must not make the visitor's browser request anything else from the host's site. */
function besideProject(name: string, project: URL): URL {
  const short = name.slice(0, 100);
  if (!URL.canParse(name, project)) throw new Error(`${short} is not an address`);
  const url = new URL(name, project);
  if (url.origin !== project.origin) throw new Error(`${short} lies on another site than its project`);
  const folder = project.protocol === 'blob:' ? undefined : new URL('.', project).pathname;
  // Some servers decode %2f and %5c as path separators, which would lead out of the folder.
  const below = folder !== undefined && url.pathname.startsWith(folder) && !/%2f|%5c/i.test(url.pathname);
  if (!below || url.search !== '') {
    throw new Error(`${short} does not lie in the folder of its project or below it`);
  }
  return url;
}

/** Fetches files and, for each project, the files that it names.
 * @param base  base of relative addresses
 * @throws Error with one sentence for people; the signal's reason */
export async function fetchFiles(files: readonly Asked[], base: string, signal?: AbortSignal): Promise<Fetched[]> {
  const addressOf = (text: string, from: string | URL): URL => {
    if (!URL.canParse(text, from)) throw new Error(`${text.slice(0, 100)} is not an address`);
    return new URL(text, from);
  };
  const fetched: Fetched[] = [];
  for (const { url: text, role } of files) {
    const url = addressOf(text, base);
    const bytes = await bytesAt(url, 'same-origin', signal);
    fetched.push({ name: nameOf(url), bytes, role });
    for (const name of namedBy(bytes)) {
      const beside = besideProject(name, url);
      fetched.push({ name: nameOf(beside), bytes: await bytesAt(beside, 'omit', signal), role: '' });
    }
  }
  if (fetched.length > most.files)
    throw new Error(`there are ${fetched.length} files; at most ${most.files} are allowed`);
  return fetched;
}
