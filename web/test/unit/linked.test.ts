// Sentences that name a setting lead to it, and the Print section has every setting in one place.
import assert from 'node:assert/strict';
import { readdirSync } from 'node:fs';
import { afterEach, test } from 'node:test';
import { piecesOf } from '../../src/controls/linked.js';
import { languages, spoken } from '../../src/i18n/languages.js';
import { settingLabel } from '../../src/i18n/say.js';
import { warningText } from '../../src/i18n/say-core.js';
import { setLanguage, type Text } from '../../src/i18n/text.js';
import { expertSettings, settings } from '../../src/model/settings.js';
import { isAtFirst, settingGroups, settingsAtFirst } from '../../src/model/setting-groups.js';

afterEach(() => setLanguage('en'));

const fieldsOf = (text: string): string[] =>
  piecesOf(text).flatMap((piece) => (typeof piece === 'string' ? [] : [piece.field]));
const forms = (text: Text): string[] => (typeof text === 'string' ? [text] : [text.one, text.other]);

test('what is between quotes and is the name of a setting leads to it, in the quotes of each language', async () => {
  assert.deepEqual(piecesOf('A smaller “Line width” or “more” would help.'), [
    'A smaller ',
    '“',
    { label: 'Line width', field: 'toolpath.spacing' },
    '”',
    ' or ',
    '“',
    'more',
    '”',
    ' would help.',
  ]);
  assert.deepEqual(fieldsOf('Fine, under “Quality”, removes most; “Rim” does not.'), ['quality', 'print.rim']);
  assert.deepEqual(fieldsOf('Without a quote, Line width is a word.'), []);
  await setLanguage('de');
  assert.deepEqual(fieldsOf('Eine kleinere „Linienbreite“ hilft, nicht „Line width“.'), ['toolpath.spacing']);
  await setLanguage('fr');
  assert.deepEqual(fieldsOf('Une «\u00a0Largeur de ligne\u00a0» plus petite aide.'), ['toolpath.spacing']);
});

test('a sentence about a value names its setting between quotes', async () => {
  const values = { field: 'printer.showSpeed', asked: 90, held: 60 };
  for (const tag of spoken) {
    await setLanguage(tag);
    assert.equal(fieldsOf(warningText({ code: 'SpeedHeld', values, message: '' }))[0], 'printer.showSpeed', tag);
  }
});

test('every language names the same settings in the same sentences, and no two settings have one name', async () => {
  const english = Object.assign(
    {},
    ...(await Promise.all(
      readdirSync('web/src/i18n/en', { recursive: true, encoding: 'utf8' })
        .filter((name) => name.endsWith('.ts'))
        .map(async (name) => {
          const file = name.replaceAll('\\', '/').replace('.ts', '.js');
          return ((await import(`../../src/i18n/en/${file}`)) as { words: object }).words;
        }),
    )),
  ) as Record<string, Text>;
  const named = Object.entries(english).flatMap(([id, text]) =>
    forms(text).map((form, k) => [id, k, fieldsOf(form)] as const),
  );
  assert.ok(named.filter(([, , fields]) => fields.length > 0).length > 20);
  for (const tag of spoken) {
    await setLanguage(tag);
    const words = (await languages[tag]?.words()) as Record<string, Text> | undefined;
    for (const [id, k, fields] of named) {
      const text = words?.[id];
      if (tag !== 'en' && text !== undefined)
        assert.deepEqual(new Set(fieldsOf(forms(text)[k] ?? '')), new Set(fields), `${tag}: ${id}`);
    }
    const labels = settings.filter(({ id }) => !expertSettings.has(id)).map(settingLabel);
    assert.equal(new Set(labels).size, labels.length, tag);
  }
});

test('each setting is seen at first or is in one group, and few are seen at first', () => {
  const grouped = settingGroups.flatMap(({ rows }) => rows.map(({ id }) => id));
  const wanted = settings.map(({ id }) => id).filter((id) => !expertSettings.has(id));
  assert.deepEqual([...grouped, ...settingsAtFirst].sort(), wanted.sort());
  assert.ok(grouped.every((id) => !isAtFirst(id)));
  for (const { name, rows } of settingGroups) assert.ok(rows.length > 3 && rows.length < 26, `${name}: ${rows.length}`);
  // Printer, filament, thickness and quality are no settings of the table.
  assert.ok(settingsAtFirst.length + 4 <= 15);
});
