#!/usr/bin/env node
// The command line, compiled for Node: npx sillon. docs/reference/cli.md describes it.
import { createRequire } from 'node:module';
import { MessageChannel, Worker, receiveMessageOnPort } from 'node:worker_threads';
import type { Answer, Asking } from './cli-texts.js';

const mostWait = 60_000; // [ms]; the thread may fail to start at all

/** Starts a thread that makes letters. Only the program itself finds out whether its files have text, and it asks
 * within a call, where the start of HarfBuzz cannot be awaited. */
function startTexts(): (name: string) => string {
  const { port1, port2 } = new MessageChannel();
  const asking: Asking = { port: port2, answered: new Int32Array(new SharedArrayBuffer(4)) };
  const thread = new Worker(new URL('./cli-texts.js', import.meta.url), {
    workerData: asking,
    transferList: [port2],
    execArgv: [],
  });
  thread.unref();
  const { answered } = asking;
  return (name) => {
    Atomics.store(answered, 0, 0);
    port1.postMessage(name);
    Atomics.wait(answered, 0, 0, mostWait);
    const answer = receiveMessageOnPort(port1)?.message as Answer | undefined;
    if (answer === undefined) throw new Error('the thread that makes letters does not answer');
    if ('problem' in answer) throw new Error(`letters cannot be made: ${answer.problem}`);
    return answer.made;
  };
}

let ask: ReturnType<typeof startTexts> | undefined;
Object.assign(globalThis, { sillonMadeElsewhere: (name: string) => (ask ??= startTexts())(name) });

// Glue code written before Node had fetch would fetch its module from a path, which is no address.
Reflect.deleteProperty(globalThis, 'fetch');
createRequire(import.meta.url)('./cli/sillon.cjs');
