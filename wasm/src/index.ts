// Entry point for browsers, and for workers in them.
import type * as api from '../sillon.js';
import { startEngine } from './engine.js';
import { browser } from './platform-browser.js';
import { prepare } from './prepare.js';

export { SillonError } from './errors.js';

export const createEngine: typeof api.createEngine = (options) => startEngine(browser, options);

export const preparePlate: typeof api.preparePlate = (upload, options) => prepare(createEngine, upload, options);
