import type { DirectionSource } from '../model/plate.js';

/** The source of one kind. */
export type SourceOf<Kind extends DirectionSource['kind']> = Extract<DirectionSource, { kind: Kind }>;
