// Problems as plain data. The dictionary has a sentence for each (`problem.CODE`) and advice (`hint.CODE`).
import type { ErrorCode, SillonError } from 'sillon';

export type ProblemCode =
  | ErrorCode
  /** The file is of no kind that the page knows. */
  | 'UnknownFile'
  /** A printer's file was given among those for a plate. */
  | 'PrinterFileHere'
  | 'NotSliced'
  | 'BodyHere'
  /** The picture is of a kind that this browser cannot read. */
  | 'BrowserPicture'
  /** The picture has a single tone, so that nothing of it would show. */
  | 'OneTone'
  /** The drawing has text or pictures, which are left out of the shape. */
  | 'LeftOut'
  /** The drawing's text is set in substitutes for its own fonts. */
  | 'OtherFont'
  /** The project's zip, or the studio.json in it, cannot be read. */
  | 'BrokenProject'
  /** Several projects were dropped together. */
  | 'TooManyFiles'
  /** The file contains no printer. */
  | 'PrinterFile'
  | 'LinkBroken'
  | 'LinkTooLong'
  | 'LinkTooNew'
  /** A value in the link is one that no control could set. */
  | 'LinkValue'
  /** The page that shows the studio asks for something that is not allowed. */
  | 'GuestValue'
  /** A file could not be fetched from its address. */
  | 'GuestFile'
  | 'TextTooLong'
  | 'NoWebGl'
  | 'StorageFull'
  /** A part of the page could not be fetched: a newer version has replaced it, or there is no network. */
  | 'PartMissing';

export interface Problem {
  code: ProblemCode;
  /** Values for the placeholders of the sentences; for the engine's refusals also its `reason`. */
  values: Readonly<Record<string, string | number>>;
  /** The engine's or the browser's own message, in English; may be empty. */
  detail: string;
}

/** A problem in words, for the page that shows the studio. */
export interface Failure {
  code: string;
  message: string;
  hint: string;
}

/** A problem that is thrown as an error. */
export class StudioError extends Error implements Problem {
  constructor(
    readonly code: ProblemCode,
    readonly values: Problem['values'] = {},
    readonly detail = '',
  ) {
    super(detail === '' ? `${code} ${JSON.stringify(values)}` : `${code}: ${detail}`);
  }
}

const unfetched = new WeakSet();

/** Marks an error as one of a part of the page that could not be fetched. */
export const markUnfetched = (error: Error): void => void unfetched.add(error);

/** Any error as a problem. An abort is no problem: check `isAbort` first. */
export function problemOf(error: unknown): Problem {
  if (error instanceof StudioError) return { code: error.code, values: error.values, detail: error.detail };
  if (error instanceof Error && error.name === 'SillonError') {
    const { code, reason, values, message } = error as Error & Pick<SillonError, 'code' | 'reason' | 'values'>;
    return { code, values: reason === '' ? {} : { ...values, reason }, detail: message };
  }
  const code = error instanceof Error && unfetched.has(error) ? 'PartMissing' : 'Internal';
  return { code, values: {}, detail: error instanceof Error ? error.message : String(error) };
}

export const isAbort = (error: unknown): boolean => error instanceof Error && error.name === 'AbortError';

/** Tells whether the engine or the page rejects the file itself. Any other error is not the file's fault. */
export const isOfFile = (error: unknown): boolean =>
  ['InvalidArgument', 'InvalidFile', 'EmptyShape', 'TooLarge'].includes(problemOf(error).code);

/** Tells whether both problems would be told in the same words. */
export const same = (a: Problem, b: Problem): boolean =>
  a.code === b.code && a.detail === b.detail && JSON.stringify(a.values) === JSON.stringify(b.values);
