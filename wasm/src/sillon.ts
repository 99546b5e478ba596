#!/usr/bin/env node
// The command line, compiled for Node: npx sillon. docs/reference/cli.md says what it can do.
import { createRequire } from 'node:module';
import { offerTexts } from './cli-texts.js';

// Glue code older than Node's fetch would fetch its module from a path, which is no address.
Reflect.deleteProperty(globalThis, 'fetch');
if (process.argv.some((argument) => /^--(layer|text)|\.json$/.test(argument))) await offerTexts();
createRequire(import.meta.url)('./cli/sillon.cjs');
