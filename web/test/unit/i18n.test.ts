import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterEach, test } from 'node:test';
import type { Report } from 'sillon';
import { en } from '../../src/i18n/en.js';
import { fr } from '../../src/i18n/fr.js';
import {
  choiceLabel,
  findingText,
  nullLabel,
  printerLabel,
  problemWords,
  progressWords,
  settingHelp,
  settingLabel,
  startLines,
  threadsWords,
  untoldText,
  valueText,
  verdictText,
  warningText,
} from '../../src/i18n/say.js';
import {
  formatBytes,
  formatDuration,
  formatNumber,
  hasText,
  language,
  languageFor,
  setLanguage,
  t,
  type Text,
} from '../../src/i18n/text.js';
import { printers } from '../../src/model/printers.js';
import { problemOf, StudioError } from '../../src/model/problem.js';
import { settingOf, settings } from '../../src/model/settings.js';
import { verdictsOf } from '../../src/model/verdicts.js';

afterEach(() => setLanguage('en'));

const forms = (text: Text): string[] => (typeof text === 'string' ? [text] : [text.one, text.other]);
const entries = (dictionary: object): [string, string[]][] =>
  Object.entries(dictionary as Record<string, Text>).map(([id, text]) => [id, forms(text)]);
const placeholders = (text: string): string[] => [...new Set(text.match(/\{\w+\}/g) ?? [])].sort();

test('both languages have the same ids and placeholders, and no text is empty', () => {
  const french = new Map(entries(fr));
  const english = entries(en);
  assert.deepEqual([...french.keys()].sort(), english.map(([id]) => id).sort());
  for (const [id, texts] of english) {
    const own = french.get(id) ?? [];
    assert.equal(own.length, texts.length, id);
    texts.forEach((text, k) => {
      assert.notEqual(text.trim(), '', id);
      assert.notEqual(own[k]?.trim(), '', id);
      assert.deepEqual(placeholders(own[k] ?? ''), placeholders(text), id);
    });
  }
});

test('French has its spaces: none that break before ; : ! ? » and units, none after «, no straight apostrophe', () => {
  const unit = /[\d}] (?:mm²|mm|cm²|%|°C|s|min|h|Mo|ko|g|m|octets)(?![\p{L}\d])/u;
  for (const [id, texts] of entries(fr)) {
    for (const text of texts) {
      assert.doesNotMatch(text, / [;:!?»]|« |'/, id);
      assert.doesNotMatch(text, /[\p{L}}][;!?»]/u, id);
      assert.doesNotMatch(text, unit, id);
    }
  }
});

test('English has no straight apostrophe either', () => {
  for (const [id, texts] of entries(en)) for (const text of texts) assert.doesNotMatch(text, /'/, id);
});

// What templates are made of, the compiler checks.
test('texts that the sources name are there, and all texts are for something', () => {
  const files = readdirSync('web/src', { recursive: true, encoding: 'utf8' }).filter(
    (file) => file.endsWith('.ts') && !/i18n.(en|fr)/.test(file),
  );
  const source = files.map((file) => readFileSync(join('web/src', file), 'utf8')).join('\n');
  const named = [...source.matchAll(/\bt\(\s*'([^']+)'/g)].map(([, id = '']) => id);
  assert.ok(named.length > 20);
  for (const id of named) assert.ok(hasText(id), id);
  const built = [...source.matchAll(/`([a-z]+\.(?:[\w.]|\$\{[^}`]*\})*)`/gi)].map(
    ([, template = '']) => new RegExp(`^${template.replace(/\$\{[^}]*\}/g, '.+')}$`),
  );
  for (const id of Object.keys(en)) {
    assert.ok(source.includes(`'${id}'`) || built.some((ids) => ids.test(id)), `nothing shows ${id}`);
  }
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

test('plurals follow the language: none is one of many in English, one in French', async () => {
  assert.equal(t('tool.strokes', { n: 1 }), '1 stroke');
  assert.equal(t('tool.strokes', { n: 0 }), '0 strokes');
  await setLanguage('fr');
  assert.equal(t('tool.strokes', { n: 0 }), '0 trait');
  assert.equal(t('tool.strokes', { n: 2 }), '2 traits');
});

test('the language is the first that is spoken, else English', () => {
  assert.equal(languageFor(['fr-CA', 'en']), 'fr');
  assert.equal(languageFor(['de', 'en-GB', 'fr']), 'en');
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
});

test('every setting has a label, a help, and words for its choices and its null', async () => {
  for (const spoken of ['en', 'fr'] as const) {
    await setLanguage(spoken);
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
  assert.equal(text('toolpath.minWidth', 0.5), '0.5\u00a0× spacing');
  assert.equal(text('print.place', [1, 2]), '1; 2\u00a0mm');
  assert.equal(text('print.place', null), 'Centred');
  assert.equal(text('print.mirror', true), 'Yes');
});

test('every problem has a sentence and what to do, without empty placeholders', () => {
  const words = problemWords(new StudioError('LinkValue', { where: 'width', value: '-1' }));
  assert.equal(words.message, 'The link sets width to -1, which is not allowed.');
  const file = (values: Record<string, string>): string =>
    problemWords({ code: 'InvalidFile', values, detail: '' }).message;
  assert.equal(file({}), 'A file cannot be read.');
  assert.equal(file({ name: 'a.svg' }), 'a.svg cannot be read.');
  assert.notEqual(words.hint, '');
  const codes = Object.keys(en).filter((id) => id.startsWith('problem.') && /^problem\.[A-Z]/.test(id));
  assert.ok(codes.length >= 20);
  for (const id of codes) assert.ok(hasText(id.replace('problem.', 'hint.')), id);
});

test('any error becomes a problem', () => {
  assert.equal(problemOf(new Error('x')).code, 'Internal');
  assert.equal(problemOf('x').detail, 'x');
  const engine = Object.assign(new Error('spacing is -1'), { name: 'SillonError', code: 'InvalidArgument' });
  assert.deepEqual(problemOf(engine), { code: 'InvalidArgument', values: {}, detail: 'spacing is -1' });
  assert.deepEqual(problemOf(new StudioError('LinkTooNew', { version: 2 })).values, { version: 2 });
});

// Whatever the engine can say of itself must have words here: these are read from its sources.
test('every stage of the engine has words', () => {
  const sources = ['pipeline', 'measure'].map((name) => readFileSync(`core/src/${name}.cpp`, 'utf8')).join('\n');
  const stages = [...sources.matchAll(/(?:clock\.start|beginStage)\("(\w+)"/g)].map(([, stage]) => stage ?? '');
  assert.ok(stages.length >= 10, `${stages.length} stages were found`);
  for (const stage of stages) assert.ok(hasText(`stage.${stage}`), stage);
});

test('every warning of the engine has words, with its numbers', async () => {
  const warnings: [string, string][] = [
    ['the plate leaves no room for a purge line; the nozzle is not primed before the first bead', ''],
    ['the skirt does not fit the bed and was left out', ''],
    ['a print of 4.5 mm stands on the bed while the start block homes; G28 and G29 must not come down', '4,5'],
    ['nothing is printed beside a print that stands on the bed; the nozzle is not primed', ''],
    ['startGcode moves along the bed at Z 0.3; what stands there is 5 mm high', '0,3'],
    ['endGcode moves along the bed at Z 5.5; what stands there is 5.6 mm high', '5,6'],
    ['the base layers cover only 57 % of the shape; what is thinner than their lines has nothing below it', '57'],
    ['filamentDiameter is 2.2 mm; filament is sold with 1.75 and 2.85', '2,2'],
    ['layerHeight is 0.06 mm; below 0.2 nozzle layers tear', '0,06'],
    ['flow is 0.5; usual are 0.8 to 1.1', '0,5'],
    ['baseFlow is 1.5; usual are 0.8 to 1.1', '1,5'],
    ['3 points have beads no wider than the layer is high (0.3 mm)', '0,3'],
    ["the beads cover 91.2 % of the shape's area; 97 to 105 print well", '91,2'],
    ['pressure advance is 0 after the print, until the printer restarts or another file sets it', ''],
    ['2 points of the path lie more than 0.1 mm outside the shape', '2'],
    ['7.5 % of the path is printed with a width held at 0.24 or 0.64 mm (0.6 and 1.6 nozzle)', '0,64'],
    ['the plate is mirrored but shown from above; writing on it reads backwards', ''],
    ['startGcode leaves the nozzle at 240 degrees; the first layer is meant for 215', '240'],
    ['line 7 of startGcode: 300 is beyond the bed', '7'],
    ['line 8 of endGcode: 300 is beyond the bed', '8'],
    ['endGcode leaves the nozzle or the bed hot; M104 S0 and M140 S0 turn them off', ''],
    ['speed is 300 mm/s; it is held at machineSpeed, 200', '300'],
    ['acceleration is 2000 mm/s2; it is held at machineAcceleration, 1250', '250'],
    ['maxFlow slows 20 % of the path', '20'],
    ['maxSegmentsPerSecond slows 31 % of the path', '31'],
    ['the file has 2345678 moves; hosts get slow above 2 million', '2\u202f345\u202f678'],
    ['the file has 123 MB; hosts get slow above 100', '123'],
  ];
  // Each must be what the sources would write: their fixed parts occur there.
  const sources = ['gcode', 'gcode_job'].map((name) => readFileSync(`core/src/${name}.cpp`, 'utf8')).join('\n');
  const written = [...sources.matchAll(/warnings\.(?:push_back|emplace_back)\(/g)].length;
  assert.equal(
    written,
    23,
    'the engine writes other warnings than before: add words for them in say.ts, and lines here',
  );
  await setLanguage('fr');
  for (const [warning, number] of warnings) {
    const fixed = warning
      .split(/\d[\d.]*|^(?:flow|baseFlow|maxFlow|maxSegmentsPerSecond|startGcode|endGcode)/)
      .filter((part) => part.length > 12);
    for (const part of fixed.slice(0, 1)) {
      assert.ok(sources.includes(part.trim().slice(0, 20)), `the engine does not write "${part}"`);
    }
    const text = warningText(warning);
    assert.notEqual(text, warning);
    assert.doesNotMatch(text, /\{|NaN|undefined/, warning);
    assert.ok(text.includes(number), `${text} lacks ${number}`);
  }
  assert.equal(warningText('something new'), 'something new');
});

test('the chip says why there is one thread', () => {
  const info = { version: '1', variant: 'st', threads: 1, reason: '' } as const;
  assert.deepEqual(threadsWords({ ...info, variant: 'mt', threads: 4 }, 'auto'), { count: '4 threads', why: '' });
  assert.equal(threadsWords(info, 'off').why, t('threads.off'));
  assert.equal(threadsWords(info, 'auto').why, t('threads.one'));
  const sentence = /return '(this page is not [^']*)'/.exec(readFileSync('wasm/src/platform-browser.ts', 'utf8'))?.[1];
  assert.ok(sentence !== undefined);
  assert.equal(threadsWords({ ...info, reason: sentence }, 'auto').why, t('threads.isolation'));
  assert.equal(threadsWords({ ...info, reason: 'threads were given up: x' }, 'auto').why, t('threads.givenUp'));
});

test('progress in words', () => {
  const words = progressWords({ job: 'making', stage: 'stitch', fraction: 0.999, secondsLeft: 61 });
  assert.deepEqual(words, {
    job: 'Laying beads',
    stage: 'Joining beads to one path',
    percent: '99%',
    left: '1 min left',
  });
  assert.equal(progressWords({ job: 'making', stage: 'other', fraction: 0, secondsLeft: undefined }).stage, 'other');
});

test('what a link lacks is listed', () => {
  assert.equal(
    untoldText(['shape', 'modes', 'strokes']),
    'A link cannot carry: the shape’s file, the mode map, and your strokes. Send the project file for those.',
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
  time: {},
  peakBytes: 0,
  threads: 1,
  digest: '',
  lengthMm: 24_000,
  alignment: -0.99,
  alignmentInterior: -0.99,
  alignmentConstrained: -0.99,
  coverage: 99.6,
  overlap: 0.4,
  spill: 0,
  uTurns: 300,
  dislocationBound: 250,
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
  assert.equal(texts[3], 'Beads run as asked: 98% on a scale where 0 is chance and 100 perfect.');
  assert.equal(texts[4], '300 hairpin turns, 3.1 per cm².');
  assert.equal(texts[6], 'Beads are 0.32 to 0.5 mm wide, 0.4 mm as a rule.');
});

test('each measure is judged by itself, in both languages', async () => {
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
    [{ kinks: 100 }, 'kinks', 'fair'],
    [{ width: { p01: 0.5, median: 1, p99: 2, belowHalf: 0, clamped: 0.03 } }, 'widths', 'fair'],
    [{ width: { p01: 0.5, median: 1, p99: 2, belowHalf: 0, clamped: 0.3 } }, 'widths', 'poor'],
    [{ fillRatio: 0.9 }, 'fill', 'fair'],
    [{ lostAreaMm2: 10 }, 'lost', 'fair'],
    [{ lostAreaMm2: 1000 }, 'lost', 'poor'],
    [{ crossings: 1 }, 'crossings', 'poor'],
    [{ toolpaths: 3 }, 'path', 'good'],
  ];
  for (const spoken of ['en', 'fr'] as const) {
    await setLanguage(spoken);
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

test('a plate that was not measured is not judged', () => {
  const unmeasured: Partial<Report> = { ...good };
  delete unmeasured.coverage;
  assert.deepEqual(verdictsOf(unmeasured as Report), []);
});

test('findings of the file are told in both languages, with their line', async () => {
  const header = readFileSync('core/include/sillon/gcode_check.hpp', 'utf8');
  const [, list = ''] = /std::string rule;\s*\/\/\/<([^;]*);?\n\s*bool error/.exec(header) ?? [];
  const rules = [...list.matchAll(/\b[a-z]+\b/g)].map(([word]) => word).filter((word) => word !== 'std');
  assert.ok(rules.length > 15, rules.join(' '));
  for (const language of ['en', 'fr'] as const) {
    await setLanguage(language);
    for (const rule of rules) {
      const finding = { rule, error: true, line: 0, count: 1, message: 'as the engine says it' };
      assert.notEqual(findingText(finding), finding.message, rule);
      assert.match(findingText({ ...finding, line: 12 }), /12/);
      assert.match(findingText({ ...finding, line: 12, count: 2 }), /12.*1/);
      assert.match(findingText({ ...finding, line: 12, count: 5 }), /12.*4/);
    }
  }
  await setLanguage('en');
  const unknown = { rule: 'taste', error: false, line: 0, count: 1, message: 'too sweet' };
  assert.equal(findingText(unknown), 'too sweet');
});

test('faults of the start block are shown beside their lines', () => {
  const block = 'G28\n  G1 X300\nM109 S200';
  assert.deepEqual(startLines(["line 2 of startGcode: a move over the bed's edge", 'flow is 2', ''], block), [
    { line: 2, code: 'G1 X300', what: "a move over the bed's edge" },
  ]);
  assert.deepEqual(startLines(['line 9 of startGcode: beyond its end'], block), []);
});
