// The one kind of error that leaves the package.
import type * as api from '../sillon.js';

/** What helps against most errors of a kind. */
const hints: Record<api.ErrorCode, string> = {
  InvalidArgument: '',
  InvalidFile: 'Shapes are SVG, PNG, JPEG, BMP or TGA; draw other formats to a canvas and hand over its pixels.',
  TooLarge: 'Use a larger spacing, a smaller shape or smaller pictures.',
  EmptyShape: 'Check that the shape has filled areas that are wider than the spacing.',
  DoesNotFit: 'Make the shape smaller, or check printer.bedMin, printer.bedMax and print.place.',
  OutOfMemory: 'Use a larger spacing or a smaller shape, or close what else needs much memory.',
  LoadFailed:
    'Check that all files of sillon/dist/engine are served there (option assetBase), and that the content security ' +
    "policy allows 'wasm-unsafe-eval'.",
  Crashed: "Try again; if it happens again, with threads: 'off'.",
  Disposed: 'Create another engine.',
  Internal: 'Please report it, with the input that led to it.',
};

export type SillonError = api.SillonError;

export const SillonError: typeof api.SillonError = class SillonError extends Error {
  declare readonly name: 'SillonError';
  readonly code: api.ErrorCode;
  readonly hint: string;

  static {
    // Not a field: then the stack trace begins with it.
    Object.defineProperty(this.prototype, 'name', { value: 'SillonError' });
  }

  constructor(code: api.ErrorCode, message: string, hint: string = hints[code]) {
    super(message);
    this.code = code;
    this.hint = hint;
  }
};

export const invalid = (message: string, hint?: string): SillonError =>
  new SillonError('InvalidArgument', message, hint);

export const messageOf = (problem: unknown): string => (problem instanceof Error ? problem.message : String(problem));
