// Finds the places to look at beside the page's thread.
import type { Toolpath } from 'sillon';
import { findMarks } from './marks.js';

self.addEventListener('message', ({ data }: MessageEvent<Toolpath>) => {
  self.postMessage(findMarks(data));
});
