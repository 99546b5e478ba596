// What of a drawing reaches the browser's own renderer: what is listed, and no more of it than ends soon.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { plainDrawing, UnfitDrawing } from '../../src/files/plain-drawing.js';

const svg = (inner: string, attributes = 'viewBox="0 0 60 40"'): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" ${attributes}>${inner}</svg>`;
const plain = (inner: string): string => plainDrawing(svg(inner)).text;
const weight = (inner: string): number => plainDrawing(svg(inner)).weight;

/** Ten times ten times ... of what the first level shows. @param level  a group that shows `id` ten times */
const tenfold = (first: string, levels: number, show: (id: string) => string): string => {
  const deeper = Array.from({ length: levels }, (_, k) => `<g id="a${k + 1}">${show(`a${k}`).repeat(10)}</g>`);
  return `<defs><g id="a0">${first}</g>${deeper.join('')}</defs>${show(`a${levels}`)}`;
};
const use = (id: string): string => `<use xlink:href="#${id}"/>`;
const shape = '<rect width="1" height="1"/>';

const endless: [what: string, drawing: string][] = [
  ['uses of uses', tenfold(shape, 6, use)],
  ['uses by href', tenfold(shape, 11, (id) => `<use href="#${id}"/>`)],
  ['uses behind entities', tenfold(shape, 6, (id) => `<use href="&#x23;${id}"/>`)],
  ['uses of themselves', '<g id="a"><use href="#a"/></g>'],
  [
    'masks under masks',
    Array.from(
      { length: 8 },
      (_, k) => `<mask id="m${k + 1}">${`<g mask="url(#m${k})">${shape}</g>`.repeat(10)}</mask>`,
    )
      .join('')
      .concat(`<mask id="m0">${shape}</mask><g mask="url(#m8)">${shape}</g>`),
  ],
  [
    'clip paths under clip paths, by a style sheet',
    `<style>${Array.from({ length: 8 }, (_, k) => `.c${k} { clip-path: url(#p${k}) }`).join('')}</style>` +
      Array.from(
        { length: 8 },
        (_, k) => `<clipPath id="p${k + 1}">${`<path class="c${k}" d="M0 0h1v1z"/>`.repeat(10)}</clipPath>`,
      ).join('') +
      `<clipPath id="p0">${shape}</clipPath><g style="clip-path: url('#p8')">${shape}</g>`,
  ],
  ['layers without end', '<g opacity="0.9">'.repeat(150).concat('</g>'.repeat(150)).repeat(20)],
  ['layers by a rule for all', `<style>* { opacity: .5 }</style>${shape.repeat(3000)}`],
  ['a long path, over and over', `<path id="a" d="M0 0${'l1 1'.repeat(50_000)}"/>${use('a').repeat(100)}`],
  ['more elements than can be', shape.repeat(50_000)],
  ['depth', '<g>'.repeat(300).concat('</g>'.repeat(300))],
];

for (const [what, drawing] of endless) {
  test(`${what}: no browser is asked to draw them`, () => {
    assert.throws(() => plainDrawing(svg(drawing)), UnfitDrawing);
  });
}

test('what is costly and no area of one colour is left out, with all that is in it', () => {
  const out = plain(`
    <filter id="f"><feTurbulence numOctaves="9"/></filter><pattern id="p" width="1" height="1">${shape}</pattern>
    <marker id="k">${shape}</marker><image href="data:image/svg+xml,x"/><text>Hello</text>
    <foreignObject><div xmlns="http://www.w3.org/1999/xhtml">x</div></foreignObject><script>go()</script>
    <rect width="9" height="9" fill="url(#p)" filter="url(#f)" marker-start="url(#k)" onload="go()"
      style="filter: blur(500px); mask: linear-gradient(red, blue), url(#a); fill: re\\64; animation: x 1s"
      stroke="url(https://elsewhere.example/#p)" stroke-dasharray="0.0001"><animate attributeName="x"/></rect>
    <circle r="3" style="fill: var(--none, navy)"/><use href="https://elsewhere.example/#x"/>
    <style>@import "x.css"; @media print { rect { fill: red } } rect:hover { fill: red } .a, * g > rect { filter: url(#f); fill: lime }</style>`);
  assert.doesNotMatch(
    out,
    /filter|feTurb|pattern|marker|image|text>|Hello|foreign|div|script|go\(|blur|linear|animat|dash|http:\/\/(?!www\.w3\.org\/2000\/svg)|https|import|media|hover|re\\/,
  );
  assert.match(out, /<rect width="9" height="9" fill="#808080"><\/rect>/);
  assert.match(out, /fill:navy/);
  assert.match(out, /<style>\.a,\* g &gt; rect\{fill:lime\}<\/style>/);
});

test('areas, strokes, groups, gradients, clip paths, masks and styles stay as they are', () => {
  const kept = `<defs><linearGradient id="g" gradientUnits="userSpaceOnUse"><stop offset="0" stop-color="red"></stop></linearGradient>
<clipPath id="c"><path d="M0 0h1v1z" transform="translate(1)"></path></clipPath></defs>
<g fill="url(#g)" clip-path="url(#c)"><path d="M1 2L3 4" stroke="#123" stroke-width="2"></path><use href="#c" x="3"></use></g>`;
  const tight = kept.replace(/>\s+</g, '><');
  assert.ok(plain(kept).endsWith(`>${tight}</svg>`), plain(kept));
});

test('prefixes, entities and comments of drawing programs are read', () => {
  const out =
    plainDrawing(`\ufeff<?xml version="1.0"?><!DOCTYPE svg PUBLIC "x" "y" [<!ENTITY st0 "fill:#FF0000;"><!ENTITY ns "http://x/">]>
    <!-- <svg> --><svg:svg xmlns:svg="http://www.w3.org/2000/svg" xmlns:i="&ns;" viewBox='0 0 9 9'>
    <i:pgf><svg:rect id="lost"/></i:pgf><svg:path style="&st0;" d='M0,0 "'/><svg:style><![CDATA[.b > .c{fill:#0f0}]]></svg:style>
    <svg:switch><svg:g systemLanguage="de"><svg:rect/></svg:g><svg:g systemLanguage="en"><svg:circle r="1"/></svg:g></svg:switch>
    </svg:svg>`).text;
  assert.match(
    out,
    /^<svg viewBox="0 0 9 9" xmlns="http:\/\/www\.w3\.org\/2000\/svg"><style>\.b &gt; \.c\{fill:#0f0\}<\/style>/,
  );
  assert.match(
    out,
    /<path d="M0,0 &quot;" style="fill:#FF0000"><\/path><switch><g><circle r="1"><\/circle><\/g><\/switch>/,
  );
  assert.doesNotMatch(out, /lost|pgf|rect/);
});

test('a drawing weighs what its uses make of it', () => {
  assert.ok(weight(shape.repeat(100)) < 110);
  const shown = weight(`<g id="a">${shape.repeat(99)}</g>${use('a').repeat(9)}`);
  assert.ok(shown > 1000 && shown < 1100, String(shown));
});

test('gradients of many colours keep sixteen of them', () => {
  const stops = Array.from({ length: 1000 }, (_, k) => `<stop offset="${k / 1000}" stop-color="red"/>`).join('');
  assert.equal(plain(`<linearGradient id="g">${stops}</linearGradient>`).match(/<stop /g)?.length, 16);
});

for (const broken of [
  '',
  'text',
  '<svg',
  '<svg><g></svg>',
  '<svg a=b></svg>',
  '<html></html>',
  '<svg><!-- </svg>',
  '<svg><g/>',
]) {
  test(`no drawing is made of ${JSON.stringify(broken)}`, () => {
    assert.throws(() => plainDrawing(broken), UnfitDrawing);
  });
}
