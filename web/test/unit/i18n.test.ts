import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterEach, test } from 'node:test';
import type { Report } from 'sillon';
import { c } from '../../src/i18n/calibrate.js';
import { en, frame as english } from '../../src/i18n/en.js';
import { words as reasonWords } from '../../src/i18n/en/core/reasons.js';
import { words as plateWords } from '../../src/i18n/en/plates.js';
import { settingHelp } from '../../src/i18n/help.js';
import { l, layerLabel, type LayersTextId } from '../../src/i18n/layers.js';
import { languages, spoken } from '../../src/i18n/languages.js';
import { r, type RebrushTextId } from '../../src/i18n/rebrush.js';
import { findingText, importNoteText, startLines, warningText } from '../../src/i18n/say-core.js';
import { untoldText } from '../../src/i18n/say-link.js';
import { exactWords } from '../../src/i18n/say-problem.js';
import {
  choiceLabel,
  nullLabel,
  printerLabel,
  problemWords,
  progressWords,
  settingLabel,
  valueText,
} from '../../src/i18n/say.js';
import { threadsWords } from '../../src/i18n/say-threads.js';
import {
  formatBytes,
  formatDuration,
  formatNumber,
  hasText,
  language,
  languageFor,
  say,
  setLanguage,
  t,
  type Text,
} from '../../src/i18n/text.js';
import { verdictText } from '../../src/i18n/say-verdict.js';
import { printers } from '../../src/model/printers.js';
import { problemOf, StudioError, type Problem } from '../../src/model/problem.js';
import { layerSettings } from '../../src/model/layer-settings.js';
import { settingOf, settings } from '../../src/model/settings.js';
import { orderVerdicts, verdictsOf } from '../../src/model/verdicts.js';

afterEach(() => setLanguage('en'));

const forms = (text: Text): string[] => (typeof text === 'string' ? [text] : [text.one, text.other]);
const entries = (dictionary: object): [string, string[]][] =>
  Object.entries(dictionary as Record<string, Text>).map(([id, text]) => [id, forms(text)]);
const placeholders = (text: string): string[] => [...new Set(text.match(/\{\w+\}/g) ?? [])].sort();

/** The files of English: each has the words of a subject; those in core/ are made from the core's. */
const files = readdirSync('web/src/i18n/en', { recursive: true, encoding: 'utf8' })
  .filter((name) => name.endsWith('.ts'))
  .map((name) => name.replaceAll('\\', '/').replace('.ts', ''));
const wordsIn = async (file: string): Promise<Record<string, Text>> =>
  ((await import(`../../src/i18n/en/${file}.js`)) as { words: Record<string, Text> }).words;
const inEnglish = entries(Object.assign({}, ...(await Promise.all(files.map(wordsIn)))) as object);

/** Other languages have all in one file. */
const wordsOf = async (tag: string): Promise<[string, string[]][]> =>
  tag === 'en' ? inEnglish : entries((await languages[tag]?.words()) ?? {});

test('every language has a line, a file, and words for where the studio is blocked', async () => {
  const files = readdirSync('web/src/i18n').filter((name) => /^..\.ts$/.test(name));
  assert.deepEqual(files.sort(), spoken.map((tag) => `${tag}.ts`).sort());
  assert.ok(spoken.length > 2);
  const blocked = new Set<string>();
  for (const tag of spoken) {
    const { frame } = (await import(`../../src/i18n/${tag}.js`)) as { frame: typeof english };
    assert.deepEqual(Object.keys(frame), Object.keys(english), tag);
    for (const text of Object.values(frame)) assert.notEqual(text.trim(), '', tag);
    blocked.add(frame.blocked);
    assert.ok(Intl.PluralRules.supportedLocalesOf(tag).length > 0, `Intl does not know ${tag}`);
  }
  assert.equal(blocked.size, spoken.length);
});

test('all languages have the same ids and placeholders, and no text is empty', async () => {
  for (const tag of spoken) {
    const own = new Map(await wordsOf(tag));
    assert.deepEqual([...own.keys()].sort(), inEnglish.map(([id]) => id).sort());
    for (const [id, texts] of inEnglish) {
      const said = own.get(id) ?? [];
      assert.equal(said.length, texts.length, id);
      texts.forEach((text, k) => {
        assert.notEqual(text.trim(), '', id);
        assert.notEqual(said[k]?.trim(), '', id);
        assert.deepEqual(placeholders(said[k] ?? ''), placeholders(text), id);
      });
    }
  }
});

test('the sections of settings and the views share no name but that of the check, which is one', async () => {
  for (const tag of spoken) {
    const words = new Map(await wordsOf(tag));
    const named = (kind: string, names: string[]): string[] =>
      names.map((name) => words.get(`${kind}.${name}`)?.[0] ?? '');
    const rail = named('section', ['shape', 'layers', 'print']);
    const tabs = named('view', ['directions', 'toolpath', 'appearance', 'quality']);
    assert.deepEqual(named('section', ['quality']), tabs.slice(-1), tag);
    assert.equal(new Set([...rail, ...tabs, '']).size, 8, `${tag}: ${[...rail, ...tabs].join()}`);
  }
});

test('French has its spaces: none that break before ; : ! ? » and units, none after «, no straight apostrophe', async () => {
  const unit = /[\d}] (?:mm²|mm|cm²|%|°C|s|min|h|Mo|ko|g|m|octets)(?![\p{L}\d])/u;
  for (const [id, texts] of await wordsOf('fr')) {
    for (const text of texts) {
      assert.doesNotMatch(text, / [;:!?»]|« |'/, id);
      assert.doesNotMatch(text, /[\p{L}}][;!?»]/u, id);
      assert.doesNotMatch(text, unit, id);
    }
  }
});

test('German has „its quotes“, and no space that breaks before units and …', async () => {
  const unit = /[\d}] (?:mm²|mm|cm²|%|°C|s|min|h|MB|kB|g|m|Byte)(?![\p{L}\d])/u;
  for (const [id, texts] of await wordsOf('de')) {
    for (const text of texts) {
      assert.doesNotMatch(text, /['"”«»]| …|\.\.\.|\p{L}…/u, id);
      assert.equal(text.replace(/„[^„“]+“/g, '').search(/[„“]/), -1, id);
      assert.doesNotMatch(text, unit, id);
      assert.doesNotMatch(text, /[^\s\u00a0\u202f]%/, id);
    }
  }
});

test('no language has a straight apostrophe or quote', async () => {
  for (const tag of spoken)
    for (const [id, texts] of await wordsOf(tag)) for (const text of texts) assert.doesNotMatch(text, /['"]/, id);
});

/** Sources of the page without its words. */
const source = readdirSync('web/src', { recursive: true, encoding: 'utf8' })
  .filter((file) => file.endsWith('.ts') && !/i18n.(\w\w|en[\\/].*)\.ts$/.test(file))
  .map((file) => readFileSync(join('web/src', file), 'utf8'))
  .join('\n');

test('words that are loaded late speak every language', async () => {
  const said = new Set<string>();
  for (const tag of spoken) {
    await setLanguage(tag);
    said.add(say(plateWords, 'plates.title'));
  }
  assert.equal(said.size, spoken.length);
});

/** What `lackOf` gives. */
const lacks: string[] = ['nothing', 'noPicture'] satisfies RebrushTextId[];

// What templates are made of, the compiler checks.
test('texts that the sources name are there, and all texts are for something', () => {
  const named = [...source.matchAll(/\bt\(\s*'([^']+)'/g)].map(([, id = '']) => id);
  assert.ok(named.length > 20);
  for (const id of named) assert.ok(hasText(id), id);
  const built = [...source.matchAll(/`([a-z]+\.(?:[\w.]|\$\{[^}`]*\})*)`/gi)].map(
    ([, template = '']) => new RegExp(`^${template.replace(/\$\{[^}]*\}/g, '.+')}$`),
  );
  for (const [id] of inEnglish) {
    if (/^(calibrate|drawing|layers|rebrush|shaping)\./.test(id)) continue; // said without their prefix
    assert.ok(source.includes(`'${id}'`) || built.some((ids) => ids.test(id)), `nothing shows ${id}`);
  }
});

test('the view that re-brushes prints speaks every language, and shows all its words', async () => {
  const view = readdirSync('web/src/rebrush')
    .map((name) => readFileSync(join('web/src/rebrush', name), 'utf8'))
    .join('\n');
  const built = ['fit', 'way', 'side'].map((what) => `rebrush.${what}.`);
  for (const id of Object.keys(await wordsIn('rebrush'))) {
    const name = id.replace('rebrush.', '');
    assert.ok(view.includes(`'${name}'`) || built.some((start) => id.startsWith(start)) || lacks.includes(name), id);
  }
  const said = new Set<string>();
  for (const tag of spoken) {
    await setLanguage(tag);
    said.add(r('left', { n: 2 }));
    assert.doesNotMatch(r('chosen', { n: 1, all: 2, area: '3' }), /[{}]/, tag);
  }
  assert.equal(said.size, spoken.length);
});

test('the panel of a shape shows all its words', async () => {
  const fields = ['shape-fields', 'shape-panel', 'size-fields', 'thickness-field']
    .map((part) => readFileSync(`web/src/shape/${part}.ts`, 'utf8'))
    .join('\n');
  const built = [...fields.matchAll(/a\(`([\w.]+)\$\{[^}`]*\}(?:\.help)?`/g)].map(([, start = '']) => start);
  for (const id of Object.keys(await wordsIn('shaping'))) {
    const name = id.replace('shaping.', '');
    assert.ok(fields.includes(`'${name}'`) || built.some((start) => name.startsWith(start)), `nothing shows ${id}`);
  }
});

test('the panel of layers speaks every language, and shows all its words', async () => {
  const files = ['i18n/layers.ts', ...readdirSync('web/src/layers').map((name) => `layers/${name}`)];
  const panel = files.map((name) => readFileSync(join('web/src', name), 'utf8')).join('\n');
  const others = ['encoding', 'mode']; // their choices are named where the directions' are
  const choices = layerSettings.flatMap((setting) =>
    setting.kind === 'choice' && !others.includes(setting.key)
      ? setting.choices.map((choice) => `${setting.key}.${choice}`)
      : [],
  );
  const built = (name: string): boolean => choices.includes(name) || /^lack\./.test(name);
  for (const id of Object.keys(await wordsIn('layers'))) {
    const name = id.replace('layers.', '');
    assert.ok(panel.includes(`'${name}'`) || built(name), `nothing shows ${id}`);
  }
  const said = new Set<string>();
  for (const tag of spoken) {
    await setLanguage(tag);
    said.add(l('add'));
    for (const choice of choices) assert.notEqual(l(choice as LayersTextId), choice, tag);
    for (const { id } of layerSettings) {
      assert.notEqual(layerLabel({ id }), '', id);
      assert.match(settingHelp({ id }), /\.$/, id);
    }
  }
  assert.equal(said.size, spoken.length);
});

test('the calibration page and the first print speak every language, and show all their words', async () => {
  const others = ['print/spool-list.ts', 'print/print-panel.ts', 'app/first-print.ts'];
  const page = [...readdirSync('web/src/calibrate').map((name) => `calibrate/${name}`), ...others]
    .map((name) => readFileSync(join('web/src', name), 'utf8'))
    .join('\n');
  const built = [...page.matchAll(/c\(`([\w.]+\.|[\w.]*)\$\{[^}`]*\}(\w*)`/g)].map(
    ([, start = '', end = '']) => new RegExp(`^${start.replaceAll('.', '\\.')}[\\w-]+${end}$`),
  );
  for (const id of Object.keys(await wordsIn('calibrate'))) {
    const name = id.replace('calibrate.', '');
    assert.ok(page.includes(`'${name}'`) || built.some((names) => names.test(name)), `nothing shows ${id}`);
  }
  const said = new Set<string>();
  for (const tag of spoken) {
    await setLanguage(tag);
    said.add(c('finds.coupon'));
    assert.doesNotMatch(c('spools.imported', { n: 1 }), /[{}]/, tag);
  }
  assert.equal(said.size, spoken.length);
});

test('values are put in, numbers as the language writes them', async () => {
  assert.equal(t('setting.outOfRange', { name: 'Width', min: 0.5, max: 10000 }), 'Width must be 0.5 to 10,000.');
  assert.equal(t('setting.outOfRange', { name: 'Width', min: 'a' }), 'Width must be a to {max}.');
  await setLanguage('fr');
  assert.equal(language(), 'fr');
  assert.match(t('setting.outOfRange', { name: 'x', min: 0.5, max: 10000 }), /de 0,5 à 10\u202f000/);
});

test('values cannot bring placeholders of their own', () => {
  assert.equal(t('setting.value', { label: '{value}', value: 1 }), '{value}: 1');
});

test('plurals follow the language: none is one of many in English and German, one in French', async () => {
  assert.equal(t('tool.strokes', { n: 1 }), '1 stroke');
  assert.equal(t('tool.strokes', { n: 0 }), '0 strokes');
  await setLanguage('fr');
  assert.equal(t('tool.strokes', { n: 0 }), '0 trait');
  assert.equal(t('tool.strokes', { n: 2 }), '2 traits');
  await setLanguage('de');
  assert.equal(t('tool.strokes', { n: 0 }), '0 Striche');
  assert.equal(t('tool.strokes', { n: 1 }), '1 Strich');
});

test('the language is the first that is spoken, else English', () => {
  assert.equal(languageFor(['fr-CA', 'en']), 'fr');
  assert.equal(languageFor(['xx', 'en-GB', 'fr']), 'en');
  assert.equal(languageFor(['xx', 'de-AT', 'fr']), 'de');
  assert.equal(languageFor(['FR']), 'fr');
  assert.equal(languageFor(['constructor', 'toString', '']), 'en');
  assert.equal(languageFor([]), 'en');
});

test('durations and sizes', async () => {
  assert.equal(formatDuration(0.2), '1 s');
  assert.equal(formatDuration(59.4), '59 s');
  assert.equal(formatDuration(60), '1 min');
  assert.equal(formatDuration(3599), '1 h 00 min');
  assert.equal(formatDuration(2 * 3600 + 5 * 60), '2 h 05 min');
  assert.equal(formatBytes(12), '12 bytes');
  assert.equal(formatBytes(12_345), '12 kB');
  assert.equal(formatBytes(1_250_000), '1.3 MB');
  await setLanguage('fr');
  assert.equal(formatBytes(1_250_000), '1,3\u00a0Mo');
  assert.equal(formatNumber(1234.5678, 1), '1\u202f234,6');
  await setLanguage('de');
  assert.equal(formatBytes(1_250_000), '1,3\u00a0MB');
  assert.equal(formatNumber(1234.5678, 1), '1.234,6');
});

test('every setting has a label, a help, and words for its choices and its null', async () => {
  for (const tag of spoken) {
    await setLanguage(tag);
    for (const setting of settings) {
      assert.notEqual(settingLabel(setting), '');
      assert.match(settingHelp(setting), /\.$/);
      assert.doesNotMatch(valueText(setting, setting.default), /undefined|null|\{/, setting.id);
      if (setting.kind === 'choice') {
        for (const choice of setting.choices) assert.notEqual(choiceLabel(setting, choice), choice, setting.id);
      }
      if ('nullable' in setting && setting.nullable) assert.notEqual(nullLabel(setting), '', setting.id);
    }
  }
});

test('values are written with their units', () => {
  const text = (id: Parameters<typeof settingOf>[0], value: Parameters<typeof valueText>[1]): string =>
    valueText(settingOf(id), value);
  assert.equal(text('toolpath.spacing', 0.4), '0.4\u00a0mm');
  assert.equal(text('print.rotate', 90), '90°');
  assert.equal(text('toolpath.minWidth', 0.5), '0.5\u00a0× line width');
  assert.equal(text('print.place', [1, 2]), '1; 2\u00a0mm');
  assert.equal(text('print.place', null), 'Centred');
  assert.equal(text('print.mirror', true), 'Yes');
});

test('every problem has a sentence and what to do, without empty placeholders', () => {
  const words = problemWords(new StudioError('LinkValue', { where: 'width', value: '-1' }));
  assert.equal(words.message, 'The link sets width to -1, which is not allowed.');
  const file = (values: Record<string, string>): string =>
    problemWords({ code: 'InvalidFile', values, detail: '' }).message;
  assert.equal(file({}), 'A file could not be read.');
  assert.equal(file({ name: 'a.svg' }), 'a.svg could not be read.');
  assert.notEqual(words.hint, '');
  const codes = Object.keys(en).filter((id) => id.startsWith('problem.') && /^problem\.[A-Z]/.test(id));
  assert.ok(codes.length >= 20);
  for (const id of codes) assert.ok(hasText(id.replace('problem.', 'hint.')), id);
});

test('files of no kind that the page knows are told by what they are', () => {
  const told = (values: Record<string, string>) => exactWords({ code: 'UnknownFile', values, detail: '' });
  assert.equal(told({ name: 'a.png', format: 'empty' })?.message, 'a.png is empty.');
  assert.equal(told({ name: 'a.png', format: 'PDF' })?.message, 'a.png is a PDF file.');
  assert.equal(told({ name: 'a.mp3' }), undefined);
});

test('any error becomes a problem', () => {
  assert.equal(problemOf(new Error('x')).code, 'Internal');
  assert.equal(problemOf('x').detail, 'x');
  const engine = (reason: string, values: Record<string, number | string>) =>
    problemOf(Object.assign(new Error('it is -1'), { name: 'SillonError', code: 'InvalidArgument', reason, values }));
  assert.deepEqual(engine('', {}), { code: 'InvalidArgument', values: {}, detail: 'it is -1' });
  assert.deepEqual(engine('TooHigh', { height: 3, most: 2 }).values, { reason: 'TooHigh', height: 3, most: 2 });
  assert.deepEqual(problemOf(new StudioError('LinkTooNew', { version: 2 })).values, { version: 2 });
});

// Whatever the engine can say of itself must have words here: these are read from its sources.
test('every stage of the engine has words', () => {
  const sources = ['pipeline/steps', 'quality/metrics']
    .map((name) => readFileSync(`core/src/${name}.cpp`, 'utf8'))
    .join('\n');
  const stages = [...sources.matchAll(/(?:making\.start|beginStage)\("(\w+)"/g)].map(([, stage]) => stage ?? '');
  assert.ok(stages.length >= 10, `${stages.length} stages were found`);
  for (const stage of stages) assert.ok(hasText(`stage.${stage}`), stage);
});

test('every sentence of the core has words of its own in every language, with its values', async () => {
  const core = files.filter((file) => file.startsWith('core/') && !/\b(?:layer-)?settings$/.test(file));
  assert.ok(core.length >= 7);
  for (const file of core) {
    const rows = entries(await wordsIn(file));
    for (const tag of spoken.filter((tag) => tag !== 'en')) {
      const own = new Map(await wordsOf(tag));
      for (const [id, texts] of rows) {
        assert.notDeepEqual(own.get(id), texts, `${tag}: ${id}`);
        assert.deepEqual(own.get(id)?.map(placeholders), texts.map(placeholders), `${tag}: ${id}`);
      }
    }
  }
});

test('what the engine says is told with its values, as the language writes them, and settings by their labels', async () => {
  const reset = { code: 'PressureAdvanceReset', values: { value: 0.035 }, message: '' } as const;
  const held = { code: 'SpeedHeld', values: { field: 'printer.speed', asked: 300, held: 200 }, message: '' } as const;
  const low = {
    code: 'BlockMovesLow',
    values: { block: 'printer.endGcode', z: 5.5, height: 5.6 },
    message: '',
  } as const;
  const ofLayer = { code: 'DrawingUnread', values: { what: 'rotate', layer: 2 }, message: '' } as const;
  assert.match(warningText(ofLayer), /^Layer 2: These parts of the drawing .* rotate/);
  assert.match(warningText(reset), /^Pressure advance is 0\.035 after/);
  assert.match(warningText(held), /^“Speed” is 300 mm\/s; .* “Machine speed limit”, 200\.$/);
  for (const tag of spoken) {
    await setLanguage(tag);
    assert.ok(warningText(reset).includes(formatNumber(0.035, 3)), tag);
    assert.ok(warningText(low).startsWith(t('brought.name', { name: t('setting.printer.endGcode') })), tag);
    const note = { code: 'BedUnknown', values: { width: '220.5', depth: '200' }, message: '' };
    assert.ok(importNoteText(note).includes(formatNumber(220.5)), tag);
  }
  assert.equal(importNoteText({ code: 'taste', values: {}, message: 'too sweet' }), 'too sweet');
});

test('settings that a sentence names bear the labels of that language', async () => {
  const labels = await wordsIn('core/settings');
  const inQuotes = (text = ''): string[] => [...text.matchAll(/[“„«]\s*(.*?)\s*[”“»]/g)].map(([, label = '']) => label);
  const named = inEnglish
    .filter(([id]) => /^(warning|finding)\./.test(id))
    .map(([id, [text]]) => [id, inQuotes(text)] as const);
  assert.ok(named.flatMap(([, list]) => list).length > 8);
  for (const tag of spoken) {
    const own = new Map(await wordsOf(tag));
    for (const [id, list] of named) {
      const wanted = list.flatMap((label) => Object.keys(labels).filter((key) => labels[key] === label));
      const said = inQuotes(own.get(id)?.[0]);
      for (const key of wanted)
        assert.ok(
          own.get(key)?.some((label) => said.includes(label)),
          `${tag}: ${id}, ${key}`,
        );
    }
  }
});

test('the chip says why there is one thread', () => {
  const info = { version: '1', variant: 'st', threads: 1, reason: '', reasonCode: '' } as const;
  assert.deepEqual(threadsWords({ ...info, variant: 'mt', threads: 4 }, 'auto'), { count: '4 threads', why: '' });
  assert.equal(threadsWords(info, 'off').why, t('threads.off'));
  assert.equal(threadsWords(info, 'auto').why, t('threads.one'));
  assert.equal(threadsWords({ ...info, reasonCode: 'NotIsolated' }, 'auto').why, t('threads.isolation'));
  assert.equal(threadsWords({ ...info, reasonCode: 'GivenUp' }, 'auto').why, t('threads.givenUp'));
});

test('progress in words', () => {
  const words = progressWords({ job: 'making', stage: 'stitch', fraction: 0.999, secondsLeft: 61 });
  assert.deepEqual(words, {
    job: 'Laying beads',
    stage: 'Joining beads into one path',
    left: '1 min left',
  });
  assert.equal(progressWords({ job: 'making', stage: 'other', fraction: 0, secondsLeft: undefined }).stage, 'other');
});

test('what a link lacks is listed', () => {
  assert.equal(
    untoldText(['shape', 'layers', 'strokes']),
    'A link cannot carry: the shape’s file, layers with large files, and your strokes. Send the project file for those.',
  );
  assert.equal(untoldText([]), 'It holds the whole plate.');
});

test('printers have names', () => {
  for (const printer of printers) assert.notEqual(printerLabel(printer), '');
});

// --- Verdicts -------------------------------------------------------------------------------------------------------------

const good: Report = {
  version: '1',
  spacing: 0.4,
  grid: [10, 10],
  parts: 1,
  cycles: 9,
  toolpaths: 1,
  points: 100,
  longestJointMm: 1,
  gapJoints: 0,
  unjoined: 0,
  apart: [],
  time: {},
  peakBytes: 0,
  threads: 1,
  digest: '',
  notes: [],
  warnings: [],
  lengthMm: 24_000,
  alignment: -0.99,
  alignmentInterior: -0.99,
  alignmentConstrained: -0.99,
  coverage: 99.6,
  overlap: 0.4,
  spill: 0,
  uTurns: 300,
  turnBound: 250,
  kinks: 1,
  crossings: 0,
  width: { p01: 0.8, median: 1, p99: 1.25, belowHalf: 0, clamped: 0 },
  fillRatio: 0.999,
  lostAreaMm2: 0,
};

test('a good plate is called good, in plain sentences', () => {
  const verdicts = verdictsOf(good);
  assert.deepEqual(
    verdicts.map(({ measure }) => measure),
    ['path', 'coverage', 'overlap', 'alignment', 'uTurns', 'kinks', 'widths', 'fill', 'lost'],
  );
  for (const verdict of verdicts) {
    assert.equal(verdict.level, 'good', verdict.measure);
    assert.doesNotMatch(verdictText(verdict), /\{/);
  }
  const texts = verdicts.map(verdictText);
  assert.equal(texts[0], 'One closed path of 24 m: the nozzle never lifts.');
  assert.equal(texts[3], 'Beads follow the directions: 98% on a scale where 0 is random and 100 is perfect.');
  assert.equal(texts[4], '300 U-turns, 3.1 per cm².');
  assert.equal(texts[6], 'Beads are 0.32 to 0.5 mm wide, typically 0.4 mm.');
});

test('the order of beads is judged by what a slicer leaves, in every language', async () => {
  for (const tag of spoken) {
    await setLanguage(tag);
    const bad = orderVerdicts({ over30: 0.3, over120: 0.276, most: 250, squeezed: 0.107 });
    assert.ok(bad.every(({ level }) => level === 'fair'));
    assert.match(bad.map(verdictText).join('\n'), /27[.,]6.*3[^]*10[.,]7/);
    const good = orderVerdicts({ over30: 0.01, over120: 0.004, most: 9, squeezed: 0.021 });
    assert.ok(good.every(({ level }) => level === 'good'));
    assert.match(good.map(verdictText).join('\n'), /0[.,]4.*3[^]*2[.,]1/);
  }
  await setLanguage('en');
});

test('each measure is judged by itself, in every language', async () => {
  const bad: [Partial<Report>, string, string][] = [
    [{ coverage: 97 }, 'coverage', 'fair'],
    [{ coverage: 80 }, 'coverage', 'poor'],
    [{ overlap: 3 }, 'overlap', 'fair'],
    [{ overlap: 9 }, 'overlap', 'poor'],
    [{ alignmentConstrained: -0.9 }, 'alignment', 'fair'],
    [{ alignmentConstrained: -0.4 }, 'alignment', 'poor'],
    [{ alignmentConstrained: 0 }, 'alignment', 'good'],
    [{ uTurns: 1000 }, 'uTurns', 'fair'],
    [{ uTurns: 5000 }, 'uTurns', 'poor'],
    [{ uTurns: 5000, turnBound: 5000 }, 'uTurns', 'fair'],
    [{ kinks: 100 }, 'kinks', 'fair'],
    [{ width: { p01: 0.5, median: 1, p99: 2, belowHalf: 0, clamped: 0.03 } }, 'widths', 'fair'],
    [{ width: { p01: 0.5, median: 1, p99: 2, belowHalf: 0, clamped: 0.3 } }, 'widths', 'poor'],
    [{ fillRatio: 0.9 }, 'fill', 'fair'],
    [{ lostAreaMm2: 10 }, 'lost', 'fair'],
    [{ lostAreaMm2: 1000 }, 'lost', 'poor'],
    [{ crossings: 1 }, 'crossings', 'poor'],
    [{ toolpaths: 3 }, 'path', 'good'],
    [{ toolpaths: 3, parts: 2, unjoined: 1, apart: [[20, 9]] }, 'path', 'fair'],
  ];
  for (const tag of spoken) {
    await setLanguage(tag);
    for (const [change, measure, level] of bad) {
      const verdicts = verdictsOf({ ...good, ...change });
      const verdict = verdicts.find((one) => one.measure === measure);
      assert.ok(verdict !== undefined, measure);
      assert.equal(verdict.level, level, JSON.stringify(change));
      assert.doesNotMatch(verdictText(verdict), /\{|NaN/);
      for (const other of verdicts) if (other !== verdict) assert.equal(other.level, 'good', other.measure);
    }
  }
});

test('no more U-turns than the directions need are no fault of the path', () => {
  const told = (turnBound: number): string | undefined =>
    verdictsOf({ ...good, uTurns: 1000, turnBound })
      .map(verdictText)
      .find((text) => text.includes('U-turn'));
  assert.match(told(1000) ?? '', /^1,000 U-turns, .* No more than these directions need \(about 1,000\)/);
  assert.doesNotMatch(told(999) ?? '', /No more/);
});

test('a plate that was not measured is not judged', () => {
  const unmeasured: Partial<Report> = { ...good };
  delete unmeasured.coverage;
  assert.deepEqual(verdictsOf(unmeasured as Report), []);
});

test('findings of the file are told in every language, with their line', async () => {
  const finding = { code: 'too-hot', line: 0, count: 1, values: { limit: '300', degrees: '480.5' }, message: '' };
  for (const tag of spoken) {
    await setLanguage(tag);
    assert.ok(findingText(finding).includes(formatNumber(480.5)), tag);
    assert.match(findingText({ ...finding, line: 12 }), /12/);
    assert.match(findingText({ ...finding, line: 12, count: 2 }), /12.*1/);
    assert.match(findingText({ ...finding, line: 12, count: 5 }), /12.*4/);
  }
  await setLanguage('en');
  assert.equal(findingText({ ...finding, line: 7 }), 'Line 7: Hotter than 300 °C: 480.5.');
  assert.equal(findingText({ ...finding, code: 'taste', message: 'too sweet' }), 'too sweet');
});

test('why the engine refuses a plate has words in every language', async () => {
  const sentences: Readonly<Record<string, string>> = reasonWords;
  const own = ['SettingOutOfRange', 'OverBedEdge', 'PlateTooLarge'];
  const reasons = [...own, ...Object.keys(sentences).map((id) => id.slice('reason.'.length))];
  assert.ok(reasons.length >= 200);
  const numbers = {
    value: 0.5,
    low: 0.05,
    high: 0.32,
    left: 2,
    back: 5.5,
    spacing: 0.4,
    leastSpacing: 0.7,
    percent: 57,
  };
  const named = (reason: string): Record<string, number | string> =>
    Object.fromEntries(placeholders(sentences[`reason.${reason}`] ?? '').map((name) => [name.slice(1, -1), 2.5]));
  const told = (reason: string) => {
    const all = { ...(own.includes(reason) ? numbers : named(reason)), setting: 'print.layerHeight', reason };
    return exactWords({ code: 'DoesNotFit', values: all, detail: '' }) ?? { message: '' };
  };
  const english = new Map(reasons.map((reason) => [reason, told(reason).message]));
  for (const name of spoken) {
    await setLanguage(name);
    for (const reason of reasons) {
      const { message, hint = '' } = told(reason);
      assert.notEqual(message, '', reason);
      assert.doesNotMatch(message + hint, /[{}]|undefined/, reason);
      if (name !== 'en') assert.notEqual(message, english.get(reason), `${name}: ${reason}`);
    }
  }
  await setLanguage('en');
  assert.equal(told('SettingOutOfRange').message, '“Layer height” is 0.5\u00a0mm; it must be 0.05 to 0.32\u00a0mm.');
  assert.equal(
    told('OverBedEdge').message,
    'The plate lies over the edge of the bed: 2 mm on the left and 5.5 mm at the back.',
  );
  assert.match(told('PlateTooLarge').hint ?? '', /at least 0\.7 mm\. .* 57 %/);
  assert.equal(told('EndLine').message.startsWith('Line'), true);
  assert.equal(told('').message, '');
});

test('the place of a fault stands before what the engine refuses', () => {
  const told = (values: Problem['values']) =>
    exactWords({ code: 'InvalidFile', values: { reason: 'NoInside', ...values }, detail: '' })?.message ?? '';
  const alone = told({});
  assert.equal(told({ layer: 2 }), `Layer 2: ${alone}`);
  assert.equal(told({ place: '“a.svg”' }), `“a.svg”: ${alone}`);
  assert.equal(told({ element: '<path>', elementLine: 3 }), `<path> in line 3: ${alone}`);
  const size = { setting: 'size', value: 60, low: -20, high: 50 };
  assert.match(told({ reason: 'SettingOutOfRange', ...size, unit: 'mm' }), /60\u00a0mm.*50\u00a0mm/);
  assert.match(told({ reason: 'SettingOutOfRange', ...size, unit: 'degrees' }), /60°.*50°/);
});

test('faults of the start block are shown beside their lines', () => {
  const block = 'G28\n  G1 X300\nM109 S200';
  const warning = (line: number) =>
    ({ code: 'StartLine', values: { line, what: 'far out', rule: 'bounds' }, message: '' }) as const;
  const problem = (values: Record<string, number | string>) =>
    ({ code: 'InvalidArgument', values, detail: '' }) as const;
  const refused = problem({ reason: 'StartLine', line: 2, what: "a move over the bed's edge", rule: 'bounds' });
  assert.deepEqual(startLines([warning(2)], undefined, block), [{ line: 2, code: 'G1 X300', what: 'far out' }]);
  assert.deepEqual(startLines([], refused, block), [{ line: 2, code: 'G1 X300', what: "a move over the bed's edge" }]);
  const other = problem({ reason: 'EndLine', line: 2, what: 'far out', rule: 'bounds' });
  assert.deepEqual(startLines([warning(9)], other, block), []);
});
