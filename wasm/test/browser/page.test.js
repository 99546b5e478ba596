// What a page's visitor feels: errors that name their cause, aborts that end the work, a page that never freezes.
import assert from 'node:assert/strict';
import { cpSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { setTimeout as wait } from 'node:timers/promises';

import { lacking, launch } from '../support/browsers.js';
import { engineFolder, serveSite, threadsHaveScript } from '../support/pages.js';
import { headerSets } from '../support/server.js';

const projects = { usual: '/examples/stress_35.json', cold: '/examples/paper/brain.json' };
const engineFiles = {
  st: ['worker.js', 'sillon-st.js', 'sillon-st.wasm'],
  mt: ['sillon-mt.js', 'sillon-mt.wasm', ...(threadsHaveScript ? ['sillon-mt.worker.js'] : [])],
};
const inMs = (time) => `${time.toFixed(0)} ms`;

describe('Chromium', { skip: lacking('Chromium') }, () => {
  let browser, copies, isolated, plain, friendly;

  before(async () => {
    copies = mkdtempSync(join(tmpdir(), 'sillon-'));
    for (const name of [...engineFiles.st, ...engineFiles.mt]) {
      cpSync(engineFolder, join(copies, name), { recursive: true, filter: (path) => !path.endsWith(`/${name}`) });
    }
    const without = { '/without/': copies };
    isolated = await serveSite(headerSets.isolated, without);
    plain = await serveSite(headerSets.plain, without);
    friendly = await serveSite(headerSets.isolated, without, 200);
    browser = await launch('Chromium');
  });
  after(async () => {
    await browser?.close();
    for (const site of [isolated, plain, friendly]) site?.close();
    rmSync(copies, { recursive: true });
  });

  const failureOf = async (site, options) => {
    const { value, error } = await browser.attempt(site.page, 'plate', { options, project: projects.usual });
    assert.equal(value, undefined);
    assert.equal(error.name, 'SillonError');
    assert.equal(error.code, 'LoadFailed');
    assert.notEqual(error.hint, '');
    return error.message;
  };

  for (const name of engineFiles.st) {
    test(`without ${name}, a web page of status 404 or 200 in its place: the error names its address`, async () => {
      for (const site of [isolated, friendly]) {
        const assetBase = `${site.origin}/without/${name}`;
        const message = await failureOf(site, { threads: 'off', assetBase });
        assert.ok(message.includes(`${assetBase}/${name}`), message);
      }
    });
  }

  test('with no engine at all: the error names an address', async () => {
    const message = await failureOf(isolated, { assetBase: '/nowhere/' });
    assert.ok(message.includes(`${isolated.origin}/nowhere/`), message);
  });

  test('engine files of another origin that shares nothing: the error names an address', async () => {
    const message = await failureOf(isolated, { assetBase: `${plain.origin}/sillon/dist/engine` });
    assert.ok(message.includes(`${plain.origin}/sillon/dist/engine/`), message);
  });

  for (const name of engineFiles.mt) {
    test(`without ${name}: one thread, and the reason names its address`, async () => {
      const assetBase = `${isolated.origin}/without/${name}`;
      const { value, error } = await browser.attempt(isolated.page, 'plate', {
        options: { threads: 2, assetBase },
        project: projects.usual,
      });
      assert.equal(error, undefined);
      assert.equal(value.variant, 'st');
      assert.equal(value.threads, 1);
      assert.ok(value.reason.includes(`${assetBase}/${name}`), value.reason);
    });
  }

  // Three ways to stop a worker: the engine's shared memory, a shared byte beside it, and its end.
  for (const [kind, threads] of [
    ['isolated', 2],
    ['isolated', 'off'],
    ['plain', 'off'],
  ]) {
    test(`an abort ends the call at once and its work before the next call's: ${kind} page, threads ${threads}`, async (t) => {
      const site = kind === 'isolated' ? isolated : plain;
      let busy;
      const { value, error } = await browser.attempt(site.page, 'abort', { options: { threads } }, async () => {
        const before = await browser.cpuSeconds();
        await wait(500);
        busy = (await browser.cpuSeconds()) - before;
      });
      assert.equal(error, undefined);
      assert.equal(value.threads, threads === 'off' ? 1 : threads);
      assert.equal(value.outcome, 'AbortError');
      assert.ok(value.atOnce, 'the call was rejected late');
      assert.notEqual(value.digest, undefined); // of the small plate, made while the aborted one would not be done yet
      t.diagnostic(`${busy.toFixed(2)} s of CPU time in half a second after the last abort`);
    });
  }

  /** @param gone  the server is, once the engine has made a plate */
  const edited = async (headers, threads, gone, elsewhere) => {
    const site = await serveSite(headers);
    const other = elsewhere && (await serveSite(elsewhere));
    const page = await browser.playwright.newPage();
    const ask = async (task, args) => {
      const { value, error } = await page.evaluate(([task, args]) => globalThis.attempt(task, args), [task, args]);
      assert.equal(error, undefined, error?.message);
      return value;
    };
    try {
      await page.goto(site.page);
      const assetBase = other && `${other.origin}/sillon/dist/engine`;
      const loaded = await ask('load', { options: { threads, ...(other && { assetBase }) } });
      assert.equal(loaded.threads, threads === 'off' ? 1 : threads);
      if (gone) for (const one of [site, other]) one?.close();
      assert.deepEqual(await ask('edit'), { ...loaded, findings: 0 });
    } finally {
      await page.close();
      for (const one of [site, other]) one?.close();
    }
  };

  for (const [kind, threads, elsewhere] of [
    ['isolated', 2],
    ['isolated', 'off'],
    ['plain', 'off'],
    ['strict', 2],
    ['strictElsewhere', 2, 'isolatedShared'],
  ]) {
    const place = elsewhere === undefined ? '' : ', engine from another origin';
    test(`an engine that has made a plate needs its server no more: ${kind} page, threads ${threads}${place}`, () =>
      edited(headerSets[kind], threads, true, headerSets[elsewhere]));
  }

  test('a policy that forbids to hold scripts as blobs: the server is asked for them again', () => {
    const policy = headerSets.strict['Content-Security-Policy'].replace(' blob:', '');
    return edited({ ...headerSets.strict, 'Content-Security-Policy': policy }, 2, false);
  });

  for (const threads of ['off', 'auto']) {
    test(`the page's thread goes on while a plate is made, threads: ${threads}`, async (t) => {
      const page = await browser.playwright.newPage();
      await page.goto(isolated.page);
      const { made, turns } = await page.evaluate(async (threads) => {
        let turns = 0;
        let going = true;
        const turn = () => {
          if (going) setTimeout(turn, 0, ++turns);
        };
        turn();
        const made = await globalThis.attempt('work', { options: { threads } });
        going = false;
        return { made, turns };
      }, threads);
      assert.equal(made.error, undefined);
      t.diagnostic(`${turns} turns for ${made.value.points} points`);
      // Work on the page's own thread would leave it a turn before and one after.
      assert.ok(turns > 4, `${turns} turns`);
      await page.close();
    });
  }

  test('the first plate of a page never visited', async (t) => {
    await browser.attempt(plain.page, 'coldPlate', { options: {}, project: projects.cold }); // the browser is warm
    const { value, error } = await browser.attempt(isolated.page, 'coldPlate', { options: {}, project: projects.cold });
    assert.equal(error, undefined);
    t.diagnostic(`engine after ${inMs(value.started)}, plate after ${inMs(value.finished)}; meant to be 1500 ms`);
  });
});
