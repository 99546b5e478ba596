// Finds the places to look at in a worker, so that the page stays responsive.
import type { Toolpath } from 'sillon';
import { findMarks } from './marks.js';

self.addEventListener('message', ({ data }: MessageEvent<Toolpath>) => self.postMessage(findMarks(data)));
