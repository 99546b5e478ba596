// Entry point for Node.
import type * as api from '../sillon.js';
import { startEngine } from './engine.js';
import { node } from './platform-node.js';
import { prepare } from './prepare.js';

export { SillonError } from './errors.js';

export const createEngine: typeof api.createEngine = (options) => startEngine(node, options);

export const preparePlate: typeof api.preparePlate = (upload, options) => prepare(createEngine, upload, options);
