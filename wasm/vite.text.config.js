// Builds dist/engine/text.js, one file with HarfBuzz's glue and the maker of QR codes in it, and unpack.js. HarfBuzz would fetch its module
// while it is imported, from an address that bundlers do not follow; here start(wasm) takes it, and may be called again.
import { copyFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));

const startLater = {
  name: 'start-later',
  enforce: 'pre',
  transform(code, id) {
    if (!id.includes('harfbuzzjs')) return undefined;
    const begin = 'init(await createHarfBuzz());';
    const address = 'new URL("harfbuzz.wasm",import.meta.url).href';
    const collected = '\tcleanup();\n';
    if (id.endsWith('index.mjs') && code.includes(begin) && code.includes(collected)) {
      // What is collected of a memory that is broken would throw where nobody can catch it.
      return code
        .replace(begin, 'export const start = async (wasmBinary) => init(await createHarfBuzz({ wasmBinary }));')
        .replace(collected, '\ttry { cleanup(); } catch {}\n');
    }
    if (id.endsWith('harfbuzz.js') && code.includes(address)) return code.replace(address, '"harfbuzz.wasm"');
    throw new Error(`${id} is not the file of harfbuzzjs that this build knows`);
  },
};

// Emscripten's glue would make the one function of woff2-encoder out of text, which strict policies of pages forbid.
const withoutEval = {
  name: 'without-eval',
  enforce: 'pre',
  transform(code, id) {
    if (!id.includes('woff2-encoder')) return undefined;
    const begin = code.indexOf('(function(A,I){if(!(A instanceof Function))');
    const end = '(Function,m).apply(null,h)';
    const last = code.indexOf(end, begin);
    const values = 'h=[P,g,B,AQ,';
    if (begin < 0 || last < 0 || !code.slice(begin - 2000, begin).includes(values))
      throw new Error(`${id} is not the file of woff2-encoder that this build knows`);
    const call = `((types, [, invoke, entry, free]) => (...given) => {
      const held = [];
      const result = invoke(entry, ...given.map((one, k) => types[k + 2].toWireType(held, one)));
      free(held);
      return types[0].fromWireType(result);
    })(I,h)`;
    return code.slice(0, begin) + call + code.slice(last + end.length);
  },
};

export default {
  root: at('.'),
  publicDir: false,
  plugins: [
    startLater,
    withoutEval,
    {
      name: 'copy-module',
      closeBundle() {
        copyFileSync(at('../node_modules/harfbuzzjs/dist/harfbuzz.wasm'), at('dist/engine/harfbuzz.wasm'));
      },
    },
  ],
  build: {
    outDir: at('dist/engine'),
    emptyOutDir: false,
    target: 'es2022',
    lib: {
      entry: { text: at('src/text/text.ts'), unpack: at('src/text/unpack.ts') },
      formats: ['es'],
      fileName: (_, name) => `${name}.js`,
    },
    rollupOptions: { external: ['module', 'fs', 'path', 'url'] },
  },
};
