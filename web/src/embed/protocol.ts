// Messages between a page and the studio in its frame: docs/guide/embedding.md. Each side treats the other as a
// stranger: malformed messages are dropped or refused, unknown fields are ignored.

import type { Failure } from '../model/problem.js';

/** Version of the protocol, raised by each change that an older side would misunderstand. */
export const version = 1;

export const most = {
  /** Requests that wait for an answer. */
  waiting: 32,
  files: 16,
  /** Size of one file [bytes]. */
  file: 64e6,
  /** Length of any text, including a project's JSON [characters]. */
  text: 1 << 20,
  name: 200,
  /** Length of a host's sentence about a file that it could not read [characters]. */
  told: 1000,
};

export type Fields = Readonly<Record<string, unknown>>;

/** Tells whether a value is a plain object. Only own fields count: read them with `field`. */
export const isFields = (value: unknown): value is Fields => {
  if (typeof value !== 'object' || value === null) return false;
  const kind: unknown = Object.getPrototypeOf(value);
  return kind === Object.prototype || kind === null;
};

/** Returns an own field; undefined if there is none. */
export const field = (fields: Fields, name: string): unknown =>
  Object.hasOwn(fields, name) ? fields[name] : undefined;

/** Returns a text field; undefined if it is missing, not text or too long. */
export const textField = (fields: Fields, name: string, longest: number): string | undefined => {
  const value = field(fields, name);
  return typeof value === 'string' && value.length <= longest ? value : undefined;
};

// --- The handshake -------------------------------------------------------------------------------------------------------

/** First message of the frame to its parent, whichever page that is: the frame is ready to connect. */
export const hello = { sillon: 'hello', v: version } as const;

/** Answer of the parent to the frame, with a port for all further messages. `exports`: files that the visitor
 * downloads go to the host. */
export interface Connect {
  sillon: 'connect';
  v: number;
  exports?: 'host';
}

const isGreeting = (data: unknown, word: string): data is Fields => isFields(data) && field(data, 'sillon') === word;

export const isHello = (data: unknown): boolean => isGreeting(data, 'hello');

/** Reads the parent's answer; undefined if it is malformed. */
export function connectFrom(data: unknown): Connect | undefined {
  if (!isGreeting(data, 'connect')) return undefined;
  const v = field(data, 'v');
  if (typeof v !== 'number') return undefined;
  return { sillon: 'connect', v, ...(field(data, 'exports') === 'host' ? { exports: 'host' } : {}) };
}

// --- Over the port -------------------------------------------------------------------------------------------------------

export const methods = [
  'load',
  'configure',
  'getProject',
  'generate',
  'exportGcode',
  'exportBody',
  'exportSvg',
  'exportProject',
  'exportView',
  'capture',
  'report',
  'cancel',
] as const;
export type Method = (typeof methods)[number];

export interface Request {
  v: number;
  id: number;
  method: string;
  params: Fields;
}

export type Reply = { v: number; id: number; result: unknown } | { v: number; id: number; error: Failure };

export const events = ['ready', 'progress', 'result', 'change', 'export', 'error'] as const;
export type EventName = (typeof events)[number];

export interface Told {
  v: number;
  event: EventName;
  detail: Fields;
}

const isId = (id: unknown): id is number => Number.isSafeInteger(id);

/** Reads a request. @returns undefined if it is too malformed to be answered */
export function requestFrom(data: unknown): Request | undefined {
  if (!isFields(data)) return undefined;
  const [v, id, method, params = {}] = [
    field(data, 'v'),
    field(data, 'id'),
    field(data, 'method'),
    field(data, 'params'),
  ];
  if (typeof v !== 'number' || !isId(id) || typeof method !== 'string' || !isFields(params)) return undefined;
  return { v, id, method, params };
}

function failureFrom(value: unknown): Failure | undefined {
  if (!isFields(value)) return undefined;
  const text = (name: string): string => textField(value, name, 10_000) ?? '';
  return { code: text('code'), message: text('message'), hint: text('hint') };
}

/** Reads a reply; undefined if it is malformed or of another version. */
export function replyFrom(data: unknown): Reply | undefined {
  if (!isFields(data)) return undefined;
  const [v, id, error] = [field(data, 'v'), field(data, 'id'), failureFrom(field(data, 'error'))];
  if (v !== version || !isId(id)) return undefined;
  return error === undefined ? { v, id, result: field(data, 'result') } : { v, id, error };
}

/** Reads an event; undefined if it is malformed, unknown or of another version. */
export function toldFrom(data: unknown): Told | undefined {
  if (!isFields(data)) return undefined;
  const [v, event, detail] = [field(data, 'v'), field(data, 'event'), field(data, 'detail')];
  const known = events.find((name) => name === event);
  if (v !== version || known === undefined || !isFields(detail)) return undefined;
  return { v, event: known, detail };
}

// --- Files ---------------------------------------------------------------------------------------------------------------

/** A file in a message: its bytes are transferred, not copied. */
export interface FileMessage {
  name: string;
  type: string;
  bytes: ArrayBuffer;
}

/** MIME types that the studio writes; a stranger's type could make a link run a script. */
const types = [
  'text/x-gcode',
  'model/3mf',
  'image/svg+xml',
  'image/png',
  'application/zip',
  'image/webp',
  'application/octet-stream',
];

/** Reads a file; control and path characters of its name become '_', an unknown type becomes plain bytes. */
export function fileFrom(value: unknown): FileMessage | undefined {
  if (!isFields(value)) return undefined;
  const [name, type, bytes] = [textField(value, 'name', most.name), field(value, 'type'), field(value, 'bytes')];
  if (name === undefined || !(bytes instanceof ArrayBuffer)) return undefined;
  const plain = name.replace(/[\p{Cc}\p{Cf}/\\:*?"<>|]+/gu, '_').replace(/^\.+/, '');
  const base = typeof type === 'string' ? (type.split(';')[0] ?? '') : '';
  return { name: plain || 'plate', type: types.includes(base) ? base : 'application/octet-stream', bytes };
}
