// A small plate in a thread of Node, with and without threads of the engine's own. Ends by itself.
import { parentPort } from 'node:worker_threads';

import { createEngine } from 'sillon';

import { small } from './jobs.js';

const made = [];
for (const threads of [1, 2]) {
  const engine = await createEngine({ threads });
  const { report } = await engine.generateToolpath(...small);
  made.push({ variant: engine.info.variant, digest: report.digest });
}
parentPort?.postMessage(made);
