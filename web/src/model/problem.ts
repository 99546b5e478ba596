// What went wrong, as plain data: the dictionary has a sentence (`problem.CODE`) and what to do about it (`hint.CODE`).
import type { ErrorCode, SillonError } from 'sillon';

export type ProblemCode =
  | ErrorCode
  /** A file of no kind that the page knows. */
  | 'UnknownFile'
  /** A printer's file among those for a plate. */
  | 'PrinterFileHere'
  | 'NotSliced'
  | 'BodyHere'
  /** A picture of a kind that this browser cannot read. */
  | 'BrowserPicture'
  /** A picture of one tone: nothing of it could be seen. */
  | 'OneTone'
  /** A drawing's text and pictures are not in its shape. */
  | 'LeftOut'
  /** A drawing's text is set in fonts that stand in for its own. */
  | 'OtherFont'
  /** A project whose zip, or whose studio.json, cannot be read. */
  | 'BrokenProject'
  /** More than one project among files that were dropped together. */
  | 'TooManyFiles'
  /** A file that tells no printer. */
  | 'PrinterFile'
  | 'LinkBroken'
  | 'LinkTooLong'
  | 'LinkTooNew'
  /** A value in a link that no control could set. */
  | 'LinkValue'
  /** A page that shows the studio asks for something that is not allowed. */
  | 'GuestValue'
  /** A file of an address that could not be fetched. */
  | 'GuestFile'
  | 'TextTooLong'
  | 'NoWebGl'
  | 'StorageFull'
  /** A part of the page that could not be fetched: a newer version has taken its place, or there is no network. */
  | 'PartMissing';

export interface Problem {
  code: ProblemCode;
  /** For the placeholders of the sentences; of what the engine refuses, its `reason` with the values of that. */
  values: Readonly<Record<string, string | number>>;
  /** What the engine or the browser said, in English; may be empty. */
  detail: string;
}

/** A problem in words, for another page. */
export interface Failure {
  code: string;
  message: string;
  hint: string;
}

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

/** From now on the error is known to be that of a part of the page which could not be fetched. */
export const markUnfetched = (error: Error): void => void unfetched.add(error);

/** Any error as a problem. An abort is none: ask `isAbort` first. */
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

/** Whether it is the engine's or the page's word on what it was given; of anything else the file has no fault. */
export const isOfFile = (error: unknown): boolean =>
  ['InvalidArgument', 'InvalidFile', 'EmptyShape', 'TooLarge'].includes(problemOf(error).code);

/** Whether both would be told in the same words. */
export const same = (a: Problem, b: Problem): boolean =>
  a.code === b.code && a.detail === b.detail && JSON.stringify(a.values) === JSON.stringify(b.values);
