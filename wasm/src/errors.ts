// The only kind of error that leaves the package.
import type * as api from '../sillon.js';
import { coreHints } from './hints.js';
import type { Call, Failure } from './protocol.js';

/** Hints that help against most errors of a kind. */
const hints: Record<api.ErrorCode, string> = {
  InvalidArgument: '',
  InvalidFile: '',
  ...coreHints,
  LoadFailed:
    'Check that all files of sillon/dist/engine are served there (option assetBase), and that the content security ' +
    "policy allows 'wasm-unsafe-eval' and, in connect-src, their origin.",
  Crashed: "Try again; if it happens again, with threads: 'off'.",
  Disposed: 'Create another engine.',
  Internal: 'Please report it, with the input that led to it.',
};

const aboutPictures = 'Shapes are SVG, PNG, JPEG, BMP or TGA; draw others to a canvas.';
const readers: Call['name'][] = [
  'generateToolpath',
  'readShape',
  'placeLayers',
  'drawLayers',
  'paintDrawing',
  'makeZones',
  'decodePicture',
];

export type SillonError = api.SillonError;

export const SillonError: typeof api.SillonError = class SillonError extends Error {
  declare readonly name: 'SillonError';
  readonly code: api.ErrorCode;
  readonly hint: string;
  readonly reason: api.ErrorReason | '';
  readonly values: Readonly<Record<string, number | string>>;

  static {
    // Defined on the prototype instead of as a field, so that the stack trace begins with it.
    Object.defineProperty(this.prototype, 'name', { value: 'SillonError' });
  }

  constructor(
    code: api.ErrorCode,
    message: string,
    hint: string = hints[code],
    told: Partial<Pick<api.SillonError, 'reason' | 'values'>> = {},
  ) {
    super(message);
    this.code = code;
    this.hint = hint;
    this.reason = told.reason ?? '';
    this.values = told.values ?? {};
  }
};

/** Makes the error for a failure of a call, or of a start. */
export function failureOf(failure: Failure & { code: api.ErrorCode }, call: Call['name'] | undefined): SillonError {
  const { code, message } = failure;
  const readsPictures = call !== undefined && readers.includes(call);
  return new SillonError(code, message, code === 'InvalidFile' && readsPictures ? aboutPictures : undefined, failure);
}

export const invalid = (message: string, hint?: string): SillonError =>
  new SillonError('InvalidArgument', message, hint);

export const messageOf = (problem: unknown): string => (problem instanceof Error ? problem.message : String(problem));
