// Writes what is made from the table of settings (the tables of docs/reference/project.md, the types of wasm/sillon.d.ts,
// the studio's defaults and ranges), from the core's sentences (the studio's English of settings, warnings, notes, findings
// and refusals, and the hints of errors in wasm/src/hints.ts), from the appearance model (its constants and spools for the studio's views, and light
// to test these by), from the profiles of filaments, from the constants of loops, from facts that programs share (web/src/model/facts.ts, wasm/src/facts.ts) and from the
// includes of core (which room includes which, in docs/internals/rooms.md).
//   node tools/generate.mjs SILLON           writes them
//   node tools/generate.mjs SILLON --check   names what is out of date, and ends with 1 if anything is
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { drawRooms, includesOfRooms } from './rooms.mjs';

const root = join(dirname(fileURLToPath(import.meta.url)), '..');
const [program, mode] = process.argv.slice(2);
const told = (...words) => JSON.parse(execFileSync(program, [...words, '--json'], { encoding: 'utf8' }));
const { settings, facts } = told('settings');

const sections = [...new Set(settings.map(({ section }) => section))];
const of = (section) => settings.filter((setting) => setting.section === section);

const quoted = (text) => `'${text}'`;

// The table is ASCII, as messages on any console must be.
const typeset = (text) =>
  text
    .replace(/(\d) degrees Celsius/g, '$1 °C')
    .replace(/(\d) degrees/g, '$1°')
    .replace(/-(\d)/g, '−$1')
    .replace(/(\w)'(\w|\s)/g, '$1’$2')
    .replace(/ x (?!and )/g, ' × ')
    .replace('sigma', 'σ');
const units = {
  'degrees Celsius': '°C',
  degrees: '°',
  spacings: 'τ',
  'mm/s2': 'mm/s²',
  'mm3/s': 'mm³/s',
  'g/cm3': 'g/cm³',
};
const unitOf = ({ unit = '' }) => units[unit] ?? unit;

// --- docs/reference/project.md --------------------------------------------------------------------------------------------------

function rangeText({ type, choices, low, high, maxBytes, most }) {
  if (choices !== undefined) return choices.map((choice) => `\`${choice}\``).join(' ');
  if (type === 'flag') return '`false` `true`';
  if (maxBytes !== undefined) return type === 'block' ? `${maxBytes / 1024} KiB` : '';
  if (most !== undefined) return `up to ${most}`;
  if (low === undefined) return '';
  return `${low} to ${high > Number.MAX_SAFE_INTEGER ? '2^64 − 1' : high}`.replaceAll('-', '−');
}

function defaultText({ default: value, type }) {
  if (value === undefined) return '';
  const json = Array.isArray(value) ? `[${value.join(', ')}]` : JSON.stringify(value);
  return type === 'number' || type === 'integer' || type === 'flag'
    ? value === null
      ? '`null`'
      : json
    : `\`${json}\``;
}

function docsRow(setting) {
  const { key, level, help, option } = setting;
  const meaning = typeset(help)
    .replaceAll('|', '\\|')
    .replaceAll(/"([a-z0-9-]+)"/g, '`$1`');
  const kinds = setting.kinds === undefined ? '' : `${setting.kinds.join(', ')}: `;
  const sentence = `${kinds}${meaning}${level === 'expert' ? ' (expert)' : ''}`;
  const cells = [`\`${key}\``, defaultText(setting), unitOf(setting), rangeText(setting), sentence];
  cells.push(option === undefined ? '' : `\`${option}\``);
  return `| ${cells.join(' | ')} |`.replaceAll('|  |', '| |').replaceAll('|  |', '| |');
}

function docs(text) {
  const head = ['| key | default | unit | range | meaning | option |', '|---|---|---|---|---|---|'];
  for (const section of sections) {
    const title = `## \`${section}\`\n`;
    const begin = text.indexOf(title);
    if (begin < 0) throw new Error(`docs/reference/project.md has no heading "${title.trim()}"`);
    const table = text.indexOf('\n| ', begin) + 1;
    const end = text.indexOf('\n\n', table);
    text = text.slice(0, table) + [...head, ...of(section).map(docsRow)].join('\n') + text.slice(end);
  }
  return text;
}

// --- wasm/sillon.d.ts --------------------------------------------------------------------------------------------------

function typeOf({ type, choices, nullable }) {
  const plain = {
    number: 'number',
    integer: 'number',
    flag: 'boolean',
    pair: '[number, number]',
    'integer pair': '[number, number]',
    pictures: 'LampPicture[]',
    colours: 'ColourAngle[]',
    strokes: 'Stroke[]',
    choice: choices?.map((choice) => `'${choice}'`).join(' | '),
  };
  return `${plain[type] ?? 'string'}${nullable ? ' | null' : ''}`;
}

/** 2^53 - 1 is as far as JavaScript counts. */
const mostOf = ({ high }) => Math.min(high, Number.MAX_SAFE_INTEGER);

function typeRow(setting) {
  const { key, low, help } = setting;
  const range = low === undefined ? '' : `${low}..${mostOf(setting)} ${unitOf(setting)}`.trim();
  const kinds = setting.kinds === undefined ? '' : `of ${setting.kinds.join(', ')}`;
  const value = setting.default === undefined ? '' : `default ${JSON.stringify(setting.default)}`;
  const facts = [range, value, kinds].filter((fact) => fact !== '').join(', ');
  return `  /** ${typeset(help)}.${facts === '' ? '' : ` ${facts[0].toUpperCase()}${facts.slice(1)}.`} */\n  ${key}: ${typeOf(setting)};`;
}

const interfaces = {
  PictureParams: 'pictures',
  Layer: 'layers',
  ToolpathParams: 'toolpath',
  PrinterValues: 'printer',
  PrintParams: 'print',
};

function types(text) {
  for (const [name, section] of Object.entries(interfaces)) {
    const head = `export interface ${name} {\n`;
    const begin = text.indexOf(head) + head.length;
    const rows = of(section).filter(({ type }) => type !== 'name');
    // What a section of the package has besides follows an empty line.
    const end = Math.min(...['\n}', '\n\n'].map((stop) => text.indexOf(stop, begin)).filter((at) => at > 0));
    text = text.slice(0, begin) + rows.map(typeRow).join('\n') + text.slice(end);
  }
  const reasons = 'export type PlainReason =\n';
  const begin = text.indexOf(reasons) + reasons.length;
  const rows = Object.entries(words.reasons).map(
    ([code, said]) => `  /** ${sentence(typeset(said))} */\n  | '${code}'`,
  );
  text = `${text.slice(0, begin)}${rows.join('\n')};${text.slice(text.indexOf('\n\n', begin))}`;
  return text.replace(/^(export type CalibrationKind = ).*;$/m, `$1${facts.calibrationKinds.map(quoted).join(' | ')};`);
}

// --- web/src/model/setting-table.ts ---------------------------------------------------------------------------------------

function studioRow(setting) {
  const { key, type, level, choices, low, unit, nullable } = setting;
  const facts = { type, level, default: setting.default };
  if (choices !== undefined) facts.choices = choices;
  if (unit !== undefined) facts.unit = unit === 'spacings' ? 'spacing' : unitOf(setting);
  if (low !== undefined) Object.assign(facts, { low, high: mostOf(setting) });
  if (nullable) facts.nullable = nullable;
  if (setting.maxBytes !== undefined) facts.maxBytes = setting.maxBytes;
  if (setting.most !== undefined) facts.most = setting.most;
  const text = Object.entries(facts).map(([name, value]) => `${name}: ${JSON.stringify(value).replaceAll('"', "'")}`);
  return `${key}: { ${text.join(', ')} },`;
}

/** Names are no values of their own, and lists have controls of their own. */
const isValue = ({ type }) => !['name', 'pictures', 'colours', 'strokes'].includes(type);

const studioRows = (section, indent) =>
  of(section)
    .filter(isValue)
    .map((setting) => indent + studioRow(setting))
    .join('\n');

const studioSection = (section) => `  ${section}: {\n${studioRows(section, '    ')}\n  },`;

/** Without type, level and unit, which the panel knows: the first view carries these. */
const shapeRows = () =>
  of('shape')
    .filter(
      (setting) =>
        isValue(setting) &&
        setting.key !== 'file' &&
        !['size', 'pageWidth', 'unitless', 'paint', 'keepThin'].includes(setting.key),
    )
    .map(
      (setting) =>
        `  ${studioRow(setting)
          .replace(/type: '[^']*', level: '[^']*', /, '')
          .replace(/unit: '[^']*', /, '')}`,
    )
    .join('\n');

/** First visits need these of layers. */
const layerKinds = () => `// Made by tools/generate.mjs from the core's table of settings: ./dev generate.

/** The kinds of layers that have a value; of what is not here, all kinds. */
export const kindsOf: Readonly<Record<string, string>> = {
${of('layers')
  .filter(({ kinds }) => kinds !== undefined)
  .map(({ key, kinds }) => `  ${key}: '${kinds.join(' ')}',`)
  .join('\n')}
};
`;

/** First visits need no more of layers: these stand apart. */
const layerTable = () => `// Made by tools/generate.mjs from the core's table of settings: ./dev generate.
export const layerTable = {
${studioRows('layers', '  ')}
} as const;

/** The most entries of each list that layers have. */
export const mostEntries = {
${of('layers')
  .filter(({ most }) => most !== undefined)
  .map(({ key, most }) => `  ${key}: ${most},`)
  .join('\n')}
} as const;
`;

const settingTable = () => `// Made by tools/generate.mjs from the core's table of settings: ./dev generate.
export const table = {
${['pictures', ...sectionsAtFirst].map(studioSection).join('\n')}
} as const;

/** Ranges, choices and defaults of shapes that are no files. */
export const shapeTable = {
${shapeRows()}
} as const;
`;

// --- web/src/i18n/en/core, wasm/src/hints.ts ---------------------------------------------------------------------------------

const words = told('words');
const sectionsAtFirst = ['toolpath', 'print', 'printer'];
const sectionsOfStudio = ['layers', ...sectionsAtFirst];
const settingsOfStudio = settings.filter((setting) => sectionsOfStudio.includes(setting.section) && isValue(setting));
const labels = new Map(settings.map(({ section, key, label }) => [`${section}.${key}`, typeset(label)]));

const sentence = (text) => text[0].toUpperCase() + text.slice(1) + (text.endsWith('.') ? '' : '.');

/** A sentence as a page prints it: settings by their labels, units and quotes as in books. */
const printed = (text) =>
  typeset(text)
    .replace(/\b[a-z]+\.[a-z][A-Za-z]+\b/g, (name) => (labels.has(name) ? `“${labels.get(name)}”` : name))
    .replace(/"([^"]*)"/g, '“$1”')
    .replace(/(\}) degrees/g, '$1 °C')
    .replace(/ %/g, '%')
    .replace(/ um\b/g, ' µm')
    .replace(/\b(k?mm|s)([23])\b/g, (_, unit, power) => unit + { 2: '²', 3: '³' }[power]);

/** The help without the meaning of null, which has a label of its own there. */
const helpOf = ({ help }) => sentence(printed(help.replace(/; null [^;]*/, '')));

const wordsFile = (rows) => `// Made by tools/generate.mjs from the core's words: ./dev generate.
export const words = {
${rows.map(([id, text]) => `  ${JSON.stringify(id).replaceAll('"', "'")}: ${JSON.stringify(text)},`).join('\n')}
} as const;
`;

const labelsFile = (sections) =>
  wordsFile(
    settingsOfStudio
      .filter(({ section }) => sections.includes(section))
      .map(({ section, key }) => [`setting.${section}.${key}`, labels.get(`${section}.${key}`)]),
  );

const sentencesFile = (kind, prefix, write = (text) => sentence(printed(text))) =>
  wordsFile(Object.entries(words[kind]).map(([code, text]) => [prefix + code, write(text)]));

/** Beside whole sentences of the studio: without a full stop. */
const phrase = (text) => sentence(printed(text)).replace(/\.$/, '');

const hints = () => `// Made by tools/generate.mjs from the core's words: ./dev generate.
export const coreHints = {
${Object.entries(words.hints)
  .map(([code, text]) => `  ${code}: ${JSON.stringify(sentence(text))},`)
  .join('\n')}
} as const;
`;

// --- web/src/model/appearance.ts, web/test/light.json ------------------------------------------------------------------------

const look = told('spools');
const { filaments } = told('filaments');

const sides = ({ nozzleSide, bedSide }) =>
  `{ nozzleSide: [${nozzleSide.join(', ')}], bedSide: [${bedSide.join(', ')}] }`;

const spoolRow = ({ key, colour, fine, wide }) => `  ${key}: {
    colour: [${colour.join(', ')}],
    fine: ${sides(fine)},
    wide: ${sides(wide)},
  },`;

const valuesOfFilament = [
  'filamentType',
  'filamentDensity',
  'nozzleTemperature',
  'firstLayerNozzleTemperature',
  'bedTemperature',
];

const filamentRow = ({ id, printer }) => {
  const values = valuesOfFilament.map((key) => `    ${key}: ${JSON.stringify(printer[key]).replaceAll('"', "'")},\n`);
  return `  ${/\W/.test(id) ? quoted(id) : id}: {\n${values.join('')}  },`;
};

const appearance = () => `// Made by tools/generate.mjs from the core's appearance model and spools: ./dev generate.

/** Slope of a bead's round top at its edge; share of the brightest light that every direction sends; slopes of lamps; contrast
 * below which pictures are seen but faintly; nozzles of the measured spools [mm]. */
export const appearance = {
${Object.entries(look)
  .filter(([key, value]) => key !== 'version' && typeof value === 'number')
  .map(([key, value]) => `  ${key}: ${value},`)
  .join('\n')}
} as const;

/** Colour of the body, sRGB 0..255; RMS slopes along and across the bead [degrees], by nozzle. */
export const spools = {
${look.spools.map(spoolRow).join('\n')}
} as const;

/** Values of a printer that filaments ask for. */
export const filamentProfiles = {
${filaments.map(filamentRow).join('\n')}
} as const;
`;

/** Light by direction, k/36 of a half turn from +x, under lamps at azimuth 60 and elevation 45 degrees. */
const light = () =>
  `{\n${look.spools.map(({ key, fine, light }) => `  "${key}": ${JSON.stringify({ slopes: fine.nozzleSide, light })}`).join(',\n')}\n}\n`;

// --- docs/internals/rooms.md, docs/pictures/rooms.svg ---------------------------------------------------------------------------

/** The table's last column; rooms in the order of the table. */
function rooms(text) {
  const includes = includesOfRooms(root);
  const order = [...text.matchAll(/^\| `(\w+)` \|/gm)].map(([, room]) => room);
  const missing = [...includes.keys()].filter((room) => !order.includes(room));
  if (missing.length > 0) throw new Error(`docs/internals/rooms.md has no row for ${missing.join(', ')}`);
  return text.replace(/^(\| `(\w+)` \|.*\|)[^|]*\|$/gm, (_, row, room) => {
    const names = order.filter((other) => other !== 'base' && includes.get(room)?.has(other));
    return `${row} ${names.join(', ')} |`.replace('|  |', '| |');
  });
}

// --- Fonts ---------------------------------------------------------------------------------------------------------------

const loop = () => `// Made by ./dev generate from core/data/loop.json.

/** Longer side [pixels] and most bytes of a loop of moving light; its frames and how long each is shown [ms]; the quality that is tried
 * first, 0..100, and by how much the next one is lower. */
export const loop = {
${Object.entries(JSON.parse(readFileSync(join(root, 'core/data/loop.json'), 'utf8')))
  .map(([key, value]) => `  ${key}: ${value},`)
  .join('\n')}
} as const;
`;

const fonts = JSON.parse(readFileSync(join(root, 'core/data/fonts/fonts.json'), 'utf8'));
const fontsOfPackage = () => `// Made by ./dev generate from core/data/fonts/fonts.json.
/** Files of the fonts that come with the engine, in dist/engine, by name. */
export const fontFiles: ReadonlyMap<string, string> = new Map([
${fonts.map(({ name, file }) => `  ['${name}', '${file}'],`).join('\n')}
]);
`;
const fontsOfStudio = () => `// Made by ./dev generate from core/data/fonts/fonts.json.
/** The fonts that come with the engine, in the order in which they are offered. */
export const builtInFonts = [${fonts.map(({ name }) => `'${name}'`).join(', ')}] as const;
`;

// --- web/src/model/facts.ts, wasm/src/facts.ts ------------------------------------------------------------------------------

const kindsOfCalibration = `/** In the core's order. */
export const calibrationKinds = [${facts.calibrationKinds.map(quoted).join(', ')}] as const;
`;

const numbers = (values) =>
  `{ ${Object.entries(values)
    .map(([key, value]) => `${key}: ${value}`)
    .join(', ')} } as const`;

const factsOfStudio = () => `// Made by tools/generate.mjs from the core's facts: ./dev generate.

/** Speed of oriented beads at which an extruder keeps up without pressure advance [mm/s]. */
export const evenSpeed = ${facts.evenSpeed};

export const mostLayers = ${facts.mostLayers};

/** A bead's neighbour lies to one side of it: the least and the greatest distance across, and the greatest along, in shares of the
 * mean of both widths. */
export const neighbours = ${numbers(facts.neighbours)};

${kindsOfCalibration}`;

const usual = (name) => settings.find(({ key }) => key === name).default;

const factsOfPackage = () => `// Made by tools/generate.mjs from the core's facts: ./dev generate.

/** Limits of core/include/sillon/text/text.hpp. */
export const letterLimits = ${numbers(facts.letters)};

/** Default of texts and codes that name none. */
export const usualFont = '${usual('font')}';
export const usualCorrection = '${usual('correction')}';

${kindsOfCalibration}`;

// --- Files ---------------------------------------------------------------------------------------------------------------

const made = {
  'docs/reference/project.md': docs,
  'docs/internals/rooms.md': rooms,
  'docs/pictures/rooms.svg': () => drawRooms(root),
  'wasm/sillon.d.ts': types,
  'web/src/model/setting-table.ts': settingTable,
  'web/src/model/layer-table.ts': layerTable,
  'web/src/model/layer-kinds.ts': layerKinds,
  'web/src/i18n/en/core/settings.ts': () => labelsFile(sectionsAtFirst),
  'web/src/i18n/en/core/layer-settings.ts': () => labelsFile(['layers']),
  'web/src/i18n/en/core/setting-help.ts': () =>
    wordsFile(settingsOfStudio.map((setting) => [`help.${setting.section}.${setting.key}`, helpOf(setting)])),
  'web/src/i18n/en/core/warnings.ts': () => sentencesFile('warnings', 'warning.'),
  'web/src/i18n/en/core/import-notes.ts': () => sentencesFile('importNotes', 'note.'),
  'web/src/i18n/en/core/findings.ts': () => sentencesFile('findings', 'finding.'),
  'web/src/i18n/en/core/reasons.ts': () => sentencesFile('reasons', 'reason.'),
  'web/src/i18n/en/core/faces.ts': () => sentencesFile('surfaces', 'rebrush.left.', phrase),
  'web/src/i18n/en/core/hints.ts': () => sentencesFile('hints', 'hint.'),
  'wasm/src/hints.ts': hints,
  'wasm/src/fonts.ts': fontsOfPackage,
  'web/src/model/fonts.ts': fontsOfStudio,
  'web/src/model/appearance.ts': appearance,
  'web/src/model/loop.ts': loop,
  'web/src/model/facts.ts': factsOfStudio,
  'wasm/src/facts.ts': factsOfPackage,
  'web/test/light.json': light,
};

let stale = 0;
for (const [path, make] of Object.entries(made)) {
  const file = join(root, path);
  const before = existsSync(file) ? readFileSync(file, 'utf8') : '';
  const after = make(before);
  if (after === before) continue;
  if (mode === '--check') {
    console.error(`${path} is out of date: run ./dev generate`);
    stale = 1;
  } else {
    writeFileSync(file, after);
    console.log(path);
  }
}
process.exitCode = stale;
