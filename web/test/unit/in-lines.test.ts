import assert from 'node:assert/strict';
import { test } from 'node:test';
import { inLines } from '../../src/model/in-lines.js';

test('a sentence becomes a block of lines of like length, of the same words', () => {
  assert.equal(inLines('Amélie'), 'Amélie');
  assert.equal(inLines('Anna & Tom'), 'Anna & Tom');
  const sentence = 'The quick brown fox jumps over the lazy dog';
  assert.equal(inLines(sentence), 'The quick brown fox\njumps over the lazy dog');
  const lines = inLines(`${sentence}, and ${sentence.toLowerCase()} once more.`).split('\n');
  assert.equal(lines.length, 3);
  assert.ok(Math.max(...lines.map(({ length }) => length)) < 1.35 * Math.min(...lines.map(({ length }) => length)));
  assert.equal(lines.join(' '), `${sentence}, and ${sentence.toLowerCase()} once more.`);
});

test('lines of one’s own, and words that nothing parts, stay', () => {
  assert.equal(inLines('a b c\nd'), 'a b c\nd');
  assert.equal(inLines('x'.repeat(90)), 'x'.repeat(90));
});
