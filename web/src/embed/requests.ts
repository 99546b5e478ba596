// Checks the parameters of a host's requests.
import type { Opening } from '../model/file-role.js';
import { StudioError } from '../model/problem.js';
import { field, isFields, most, textField, type Fields } from './protocol.js';

/** Error of a request that is refused with one sentence and has no other effect. */
export class Refused extends Error {
  constructor(
    readonly code: 'BadRequest' | 'UnknownMethod' | 'TooLarge' | 'Busy' | 'Version',
    message: string,
  ) {
    super(message);
  }
}

/** Reads one file of a request. @throws Refused */
function openingFrom(value: unknown, k: number): Opening {
  const name = isFields(value) ? textField(value, 'name', most.name) : undefined;
  const bytes = isFields(value) ? field(value, 'bytes') : undefined;
  const role = isFields(value) ? (field(value, 'role') ?? '') : undefined;
  if (name === undefined || !(bytes instanceof ArrayBuffer) || typeof role !== 'string') {
    throw new Refused('BadRequest', `files[${k}] must be { name: text, bytes: ArrayBuffer, role: text or nothing }`);
  }
  if (bytes.byteLength > most.file) {
    throw new Refused('TooLarge', `files[${k}] has ${bytes.byteLength} bytes; at most ${most.file} are allowed`);
  }
  return { file: new File([bytes], name), role: role.slice(0, most.name) };
}

/** Turns a project in a request into a file. @throws Refused */
function projectFile(project: unknown): Opening {
  let text: string;
  try {
    text = JSON.stringify(project);
  } catch {
    throw new Refused('BadRequest', 'project cannot be written as JSON');
  }
  if (text.length > most.text) {
    throw new Refused('TooLarge', `project has ${text.length} characters; at most ${most.text} are allowed`);
  }
  return { file: new File([text], 'project.json'), role: '' };
}

/** Returns the files of `load`: a project as plain JSON, files, or both if the project names files.
 * @throws Refused; StudioError if the host could not read a file that it names */
export function openingsFrom(params: Fields): Opening[] {
  const failed = textField(params, 'failed', most.text);
  if (failed !== undefined) throw new StudioError('GuestFile', {}, failed.slice(0, most.told));
  const [project, files = []] = [field(params, 'project'), field(params, 'files')];
  if (project !== undefined && !isFields(project)) throw new Refused('BadRequest', 'project must be an object');
  if (!Array.isArray(files)) throw new Refused('BadRequest', 'files must be a list');
  if (files.length > most.files) {
    throw new Refused('TooLarge', `there are ${files.length} files; at most ${most.files} are allowed`);
  }
  const openings = [...(project === undefined ? [] : [projectFile(project)]), ...files.map(openingFrom)];
  if (openings.length === 0) throw new Refused('BadRequest', 'there is neither a project nor a file to load');
  return openings;
}

/** Reads a number with a default and bounds. @throws Refused */
function numberIn(params: Fields, name: string, usual: number, min: number, max: number): number {
  const value = field(params, name) ?? usual;
  if (typeof value !== 'number' || !(value >= min && value <= max)) {
    throw new Refused('BadRequest', `${name} must be a number from ${min} to ${max}`);
  }
  return value;
}

/** Returns the kind of picture that `capture` asks for. @throws Refused */
export function checkedCapture(params: Fields): 'image' | 'loop' {
  const type = field(params, 'type') ?? 'image';
  if (type === 'image' || type === 'loop') return type;
  throw new Refused('BadRequest', 'type must be image or loop');
}

/** Returns the width of a picture [pixels]. @throws Refused */
export const checkedPicture = (params: Fields): number => Math.round(numberIn(params, 'width', 1600, 16, 4096));
