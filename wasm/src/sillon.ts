#!/usr/bin/env node
// The command line, compiled for Node: npx sillon. docs/reference/cli.md says what it can do.
import { createRequire } from 'node:module';

// Glue code older than Node's fetch would fetch its module from a path, which is no address.
Reflect.deleteProperty(globalThis, 'fetch');
createRequire(import.meta.url)('./cli/sillon.cjs');
