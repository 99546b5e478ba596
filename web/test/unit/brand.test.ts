// What a host may say of colour, corners and letters, and what comes of it.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { brandFrom, contrast } from '../../src/embed/brand.js';
import { Unfit } from '../../src/model/check.js';

const brand = (attributes: Record<string, unknown>) => brandFrom((name) => attributes[name]);

type Rgb = [number, number, number];
const pairOf = (value: string | undefined): [Rgb, Rgb] => {
  const found = /^light-dark\((#[0-9a-f]{6}), (#[0-9a-f]{6})\)$/.exec(value ?? '');
  const rgb = (hex = ''): Rgb => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16)) as Rgb;
  return [rgb(found?.[1]), rgb(found?.[2])];
};

test('nothing said changes nothing; empty words give the studio’s own look back', () => {
  assert.deepEqual(brand({}), {});
  const names = ['--accent', '--on-accent', '--accent-hover', '--tint', '--radius', '--radius-large', '--font'];
  assert.deepEqual(brand({ accent: '', radius: '', font: '' }), Object.fromEntries(names.map((name) => [name, ''])));
});

test('black and white have a contrast of 21, a colour with itself of 1', () => {
  assert.equal(contrast([0, 0, 0], [255, 255, 255]).toFixed(3), '21.000');
  assert.equal(contrast([90, 10, 200], [90, 10, 200]), 1);
});

test('a colour that can be read stays; every colour is readable on both grounds, and what stands on it, too', () => {
  assert.equal(brand({ accent: '#063' })['--accent']?.slice(0, 19), 'light-dark(#006633,');
  for (const accent of ['#000', '#fff', '#ff0', '#0000ff', '#777777', '#C33', '#e4e2dc']) {
    const made = brand({ accent });
    const colours = pairOf(made['--accent']);
    const over = pairOf(made['--on-accent']);
    const grounds: Rgb[] = [
      [0xf4, 0xf3, 0xef],
      [0x15, 0x18, 0x1b],
    ];
    colours.forEach((colour, k) => {
      assert.ok(contrast(colour, grounds[k] as Rgb) >= 4.5, `${accent} ${String(colour)}`);
      assert.ok(contrast(colour, over[k] as Rgb) >= 4.5, `${accent} ${String(over[k])}`);
    });
  }
});

test('corners are pixels, fonts are names in quotes behind which stand the system’s', () => {
  assert.deepEqual(brand({ radius: '10px' }), { '--radius': '10px', '--radius-large': '20px' });
  assert.deepEqual(brand({ radius: '0' }), { '--radius': '0px', '--radius-large': '0px' });
  assert.equal(
    brand({ font: `"Source Sans 3", Noto Sans, serif` })['--font'],
    `'Source Sans 3', 'Noto Sans', serif, system-ui, sans-serif`,
  );
});

test('anything else is refused with its name: no addresses, no functions, no other styles', () => {
  const bad: [string, unknown][] = [
    ['accent', 'red'],
    ['accent', '#12345'],
    ['accent', 'url(https://elsewhere.invalid/x)'],
    ['accent', '#fff;background:url(//x)'],
    ['accent', 'var(--bench)'],
    ['accent', 7],
    ['radius', '-1'],
    ['radius', '21'],
    ['radius', '1e1'],
    ['radius', '50%'],
    ['radius', 'calc(1px)'],
    ['font', 'url(x)'],
    ['font', "a'; background: red"],
    ['font', 'a}b{'],
    ['font', 'a\\62'],
    ['font', ','],
    ['font', 'a,b,c,d,e'],
    ['font', 'x'.repeat(41)],
    ['font', `'${'x'.repeat(300)}'`],
    ['font', ['Arial']],
  ];
  for (const [name, value] of bad) {
    assert.throws(
      () => brand({ [name]: value }),
      (error) => error instanceof Unfit && error.where === name,
      String(value),
    );
  }
});
