// Builds the custom elements for other people's pages: each one file without imports, beside the studio in dist/embed.
import { fileURLToPath } from 'node:url';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));

export default {
  root: at('.'),
  publicDir: false,
  build: {
    outDir: at('dist/embed'),
    emptyOutDir: true,
    target: 'es2022',
    modulePreload: false,
    lib: {
      entry: {
        'sillon-studio': at('src/embed/sillon-studio.ts'),
        'sillon-view': at('src/embed/sillon-view.ts'),
      },
      formats: ['es'],
      fileName: (_, name) => `${name}.js`,
    },
  },
};
