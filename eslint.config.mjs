import js from '@eslint/js';
import globals from 'globals';
import tseslint from 'typescript-eslint';

/** What each feature may use: the plate, its words, its files, and the elements that all panels are made of. */
const ground = ['model', 'i18n', 'files', 'studio', 'controls'];

/** The folders of web/src, and which others each may import from. */
const rooms = {
  model: [],
  i18n: ['model'],
  views: ['model'],
  files: ['model'],
  engine: ['model'],
  studio: ['model', 'i18n', 'files'],
  controls: ['model', 'i18n', 'studio'],
  shape: ground,
  layers: [...ground, 'quality'],
  quality: [...ground, 'views', 'engine'],
  print: [...ground, 'engine', 'quality', 'shape'],
  plates: [...ground, '\\.\\./\\.\\./examples'], // projects that it offers
  stage: [...ground, 'views', 'shape', 'layers', 'quality'],
  rebrush: [...ground, 'views', 'stage', 'print'],
  calibrate: [...ground, 'print'],
  embed: ['model', 'i18n', 'files', 'views', 'studio'],
  'service-worker': [],
};

const beyond = (room) => `^\\.\\./(?!(${rooms[room].join('|') || '-'})/)`;

/** Of the package, one room runs code and one reads tables; types may be used everywhere. */
function packageUse(room) {
  const names = { engine: '', model: 'presets\\.json|printers\\.json|filaments\\.json' }[room];
  return names === '' ? [] : [{ regex: `^sillon$|^sillon/(?!(${names ?? '-'})$)`, allowTypeImports: true }];
}

const walls = Object.keys(rooms).map((room) => ({
  files: [`web/src/${room}/**/*.ts`],
  rules: {
    '@typescript-eslint/no-restricted-imports': [
      'error',
      {
        patterns: [
          { regex: beyond(room), message: 'This folder must not know that one: see `rooms` in eslint.config.mjs.' },
          ...packageUse(room),
        ],
      },
    ],
    'no-restricted-syntax': [
      'error',
      {
        selector: `ImportExpression[source.value=/${beyond(room).replaceAll('/', '\\u002F')}/]`,
        message: 'This folder must not know that one: see `rooms` in eslint.config.mjs.',
      },
    ],
  },
}));

export default tseslint.config(
  { ignores: ['build/', 'out/', '**/dist/', 'web/build/', '**/node_modules/', 'wasm/test/types/'] },
  js.configs.recommended,
  {
    files: ['**/*.ts'],
    extends: [tseslint.configs.strictTypeChecked],
    languageOptions: { parserOptions: { projectService: true } },
    rules: {
      // `${number}` reads well in messages
      '@typescript-eslint/restrict-template-expressions': ['error', { allowNumber: true }],
      '@typescript-eslint/no-unused-vars': ['error', { argsIgnorePattern: '^_' }],
      // `() => f()` is what a listener reads like
      '@typescript-eslint/no-confusing-void-expression': ['error', { ignoreArrowShorthand: true }],
    },
  },
  {
    files: ['**/test/**/*.ts'],
    rules: {
      // node:test awaits its own
      '@typescript-eslint/no-floating-promises': [
        'error',
        { allowForKnownSafeCalls: [{ from: 'package', name: ['test', 'describe', 'it'], package: 'node:test' }] },
      ],
    },
  },
  ...walls,
  {
    files: ['**/*.js', '**/*.mjs'],
    languageOptions: { globals: { ...globals.node, ...globals.browser } },
    rules: { 'no-unused-vars': ['error', { argsIgnorePattern: '^_', varsIgnorePattern: '^_' }] },
  },
);
