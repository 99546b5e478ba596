// Makes a plate without and with threads, and forgets to dispose of the engines.
import { createEngine } from 'sillon';

import { small } from './jobs.js';

const digests = [];
for (const threads of [1, 2]) {
  const engine = await createEngine({ threads, idleTimeout: Infinity });
  digests.push((await engine.generateToolpath(...small)).report.digest);
}
console.log(digests.join(' '));
