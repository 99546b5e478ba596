// <sillon-studio> in a page of another site: what attributes set, what methods give, what events tell; and the plain frame.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { unzipSync } from 'fflate';

import { lacking } from '../../../wasm/test/support/browsers.js';
import { project, startHosts } from './support/hosts.js';
import { sharedBench } from './support/shared.js';
import { keptPlate, until } from './support/waits.js';

const skip = lacking('Chromium');
const hosts = sharedBench(skip, startHosts);

/** A page with the element, which is `ready`. @param more  of the page: `site`, `small` */
async function element(attributes = {}, more = {}) {
  const visit = await hosts.open(more);
  const { page } = visit;
  const ready = await page.evaluate(
    async ({ studio, attributes }) => {
      await import(`${studio}embed/sillon-studio.js`);
      const element = document.createElement('sillon-studio');
      globalThis.element = element;
      globalThis.heard = [];
      for (const name of ['ready', 'progress', 'result', 'change', 'export', 'error']) {
        element.addEventListener(name, ({ detail }) => globalThis.heard.push({ name, detail }));
      }
      for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
      const ready = new Promise((resolve) => element.addEventListener('ready', ({ detail }) => resolve(detail)));
      document.body.append(element);
      return ready;
    },
    { studio: hosts.studio, attributes },
  );
  const frame = page.frames().find((one) => one.url().startsWith(hosts.studio));
  return { ...visit, frame, ready };
}

let usual;

/** The element without attributes that other tests have used, as long as these went well: for what follows a `load`. */
async function usualElement() {
  if (usual === undefined || usual.page.isClosed()) usual = await element({}, { kept: true });
  else hosts.take(usual);
  usual.problems.length = 0;
  await usual.page.evaluate(() => (globalThis.heard.length = 0));
  await load(usual.page);
  return usual;
}

const state = (frame, read) => frame.evaluate(`(${read})(document.querySelector('sillon-app').studio.store.state)`);

/** Not by waitForFunction, whose eval the studio's policy forbids. */
const stateIs = (frame, read) =>
  until(async () => {
    const there = await frame.evaluate(() => document.querySelector('sillon-app') !== null);
    return there && state(frame, read);
  }, read);
const load = (page) => page.evaluate((project) => globalThis.element.load(project), project);

test('methods give the plate that was loaded, as project, report and files', { skip }, async () => {
  const { page, frame, ready, problems } = await usualElement();
  assert.ok(ready.threads >= 1 && typeof ready.why === 'string' && /^\d/.test(ready.version));
  const made = await page.evaluate(async (project) => {
    const { element } = globalThis;
    await element.load(project);
    const told = await element.getProject();
    const report = await element.generate();
    const files = {};
    for (const method of ['exportGcode', 'exportSvg', 'exportProject', 'capture']) {
      const { name, blob } = await element[method]({ width: 200 });
      const bytes = new Uint8Array(await blob.arrayBuffer());
      files[method] = { name, type: blob.type, size: bytes.length, head: Array.from(bytes.subarray(0, 4)) };
    }
    const zip = Array.from(new Uint8Array(await (await element.exportProject()).blob.arrayBuffer()));
    const again = await element.report();
    const flat = await element.exportBody().catch(({ message }) => message);
    await element.load({ ...project, print: { ...project.print, base: 2 } });
    const { name, blob } = await element.exportBody();
    files.exportBody = { name, type: blob.type, size: blob.size };
    return { told, report, flat, again, files, zip };
  }, project);
  assert.deepEqual([made.told.shape.builtin, made.told.shape.size], ['disc', [16, 16]]);
  assert.equal(made.told.print.base, 0);
  assert.equal(made.report.toolpaths, 1);
  assert.ok(made.report.grams > 0.05 && made.report.grams < 1, String(made.report.grams)); // 16 mm, one layer
  assert.ok(made.report.minutes > 0.1 && made.report.minutes < 10, String(made.report.minutes));
  assert.deepEqual(made.again, made.report);
  assert.deepEqual(JSON.parse(Buffer.from(unzipSync(Uint8Array.from(made.zip))['project.json'])), made.told);
  const { exportGcode, exportBody, exportSvg, exportProject, capture } = made.files;
  assert.match(exportGcode.name, /^project_0\.4mm_PLA_\d+m\.gcode$/);
  assert.equal(exportGcode.type, 'text/x-gcode');
  assert.ok(exportGcode.size > 10_000);
  assert.deepEqual([exportSvg.name, exportSvg.type], ['project.svg', 'image/svg+xml']);
  assert.deepEqual([exportProject.name, exportProject.head], ['project.sillon.zip', [0x50, 0x4b, 3, 4]]);
  assert.deepEqual([capture.name, capture.head], ['project.png', [0x89, 0x50, 0x4e, 0x47]]);
  assert.match(made.flat, /“Bottom layers” is 0/);
  assert.deepEqual([exportBody.name, exportBody.type], ['project.base.3mf', 'model/3mf']);
  assert.ok(exportBody.size > 1000);
  assert.equal(await frame.evaluate(() => crossOriginIsolated), true);
  assert.deepEqual(problems, []);
});

test('the file comes with what it takes and what is to be known of it', { skip }, async () => {
  const { page } = await usualElement();
  const { grams, seconds, findings, size } = await page.evaluate(async (project) => {
    const { element } = globalThis;
    await element.load({ ...project, print: { ...project.print, purgeLength: 0 } });
    const { blob, summary, findings } = await element.exportGcode();
    return { grams: summary.filamentGrams, seconds: summary.seconds, findings, size: [blob.size, summary.bytes] };
  }, project);
  assert.ok(grams > 0.01 && grams < 1, `${grams} g`);
  assert.ok(seconds > 5 && seconds < 600, `${seconds} s`);
  assert.equal(size[0], size[1]);
  assert.ok(Array.isArray(findings));
  for (const { code, message } of findings) assert.ok(code !== '' && message !== '');
});

test(
  'every promise settles: of an element taken away, and of a call given up before there is a studio',
  { skip },
  async () => {
    const { page } = await hosts.open();
    const outcomes = await page.evaluate(
      async ({ studio }) => {
        await import(`${studio}embed/sillon-studio.js`);
        const outcome = (promise) =>
          promise.then(
            () => 'done',
            ({ name, code }) => (name === 'AbortError' ? name : code),
          );
        const waiting = document.createElement('sillon-studio'); // in no page yet
        const control = new AbortController();
        const given = outcome(waiting.generate({ signal: control.signal }));
        control.abort();
        const taken = document.createElement('sillon-studio');
        document.body.append(taken);
        const gone = [taken.generate(), taken.report(), taken.load({ sillon: 1 })].map(outcome);
        await new Promise((resolve) => setTimeout(resolve)); // they wait for the frame
        taken.remove();
        const wrong = document.createElement('sillon-studio');
        wrong.setAttribute('base', 'data:text/html,');
        document.body.append(wrong);
        return Promise.all([given, ...gone, outcome(wrong.getProject())]);
      },
      { studio: hosts.studio },
    );
    assert.deepEqual(outcomes, ['AbortError', 'Closed', 'Closed', 'Closed', 'BadAttribute']);
  },
);

test('every promise settles, of an element taken away while files are on their way', { skip }, async () => {
  const { page } = await element();
  const outcomes = await page.evaluate(async () => {
    const { element } = globalThis;
    const outcome = (promise) =>
      promise.then(
        () => 'done',
        ({ code }) => code,
      );
    const arrivals = [];
    globalThis.fetch = () => new Promise((resolve) => arrivals.push(resolve));
    element.shape = 'a.svg';
    const waiting = [outcome(element.generate())]; // for the file of the attribute
    while (arrivals.length < 1) await new Promise((resolve) => setTimeout(resolve));
    waiting.push(outcome(element.load('b.svg')));
    while (arrivals.length < 2) await new Promise((resolve) => setTimeout(resolve));
    element.remove();
    for (const arrive of arrivals) arrive(new Response('<svg xmlns="http://www.w3.org/2000/svg"/>'));
    waiting.push(outcome(element.report()));
    const late = new Promise((resolve) => setTimeout(resolve, 5000, 'never'));
    return Promise.all(waiting.map((one) => Promise.race([one, late])));
  });
  assert.deepEqual(outcomes, ['Closed', 'Closed', 'Closed']);
  await page.evaluate(async () => {
    const { element } = globalThis;
    element.removeAttribute('shape');
    document.body.append(element);
    await element.info(); // put into a page again, it opens again
  });
});

test('after an abort and a removal no rejection is left that nobody handles', { skip }, async () => {
  const { page, problems } = await element();
  const outcome = await page.evaluate(async (project) => {
    const { element } = globalThis;
    await element.load({ ...project, shape: { builtin: 'disc', size: [300, 300] } });
    const control = new AbortController();
    const work = element.generate({ signal: control.signal });
    await new Promise((resolve) => element.addEventListener('progress', resolve, { once: true }));
    control.abort();
    for (let k = 0; k < 4; ++k) await undefined; // the frame is asked to stop, and has not answered
    element.remove();
    const code = await work.catch(({ code }) => code);
    await new Promise((resolve) => setTimeout(resolve, 300));
    return code;
  }, project);
  assert.equal(outcome, 'Closed');
  assert.deepEqual(problems, []);
});

test('a signal that outlives its calls keeps nothing of them', { skip }, async () => {
  const { page } = await usualElement();
  await load(page);
  const kept = await page.evaluate(async () => {
    const { signal } = new AbortController();
    let kept = 0;
    const { addEventListener, removeEventListener } = signal;
    signal.addEventListener = (...given) => (++kept, addEventListener.apply(signal, given));
    signal.removeEventListener = (...given) => (--kept, removeEventListener.apply(signal, given));
    for (let k = 0; k < 3; ++k) await globalThis.element.generate({ signal });
    const early = document.createElement('sillon-studio'); // waits for its frame
    document.body.append(early);
    await early.exportProject({ signal });
    early.remove();
    return kept;
  });
  assert.equal(kept, 0);
});

test('what cannot be loaded or asked for is refused with a code', { skip }, async () => {
  const { page } = await usualElement();
  const nothing = ['generate', 'exportGcode', 'exportBody', 'exportSvg', 'exportProject', 'exportView', 'capture'];
  const names = await page.evaluate((methods) => {
    const refused = methods.map((method) => globalThis.element[method](null)); // none throws
    return Promise.all(refused.map((one) => one.catch(({ name }) => name)));
  }, nothing);
  assert.deepEqual(
    names,
    nothing.map(() => 'TypeError'),
  );
  const codes = await page.evaluate(() => {
    const { element } = globalThis;
    const refused = [
      element.capture({ width: () => 1 }),
      element.capture({ width: 0 }),
      element.load('missing.json'),
      element.load('ftp://shop.example/plate.svg'),
      element.load({ sillon: 1, shape: () => 1 }),
      element.load(5),
    ];
    return Promise.all(
      refused.map((one) =>
        one.then(
          () => 'done',
          ({ name, code }) => `${name} ${code}`,
        ),
      ),
    );
  });
  assert.deepEqual(
    codes,
    ['BadRequest', 'BadRequest', 'LoadFailed', 'LoadFailed', 'BadRequest', 'BadRequest'].map(
      (code) => `StudioFrameError ${code}`,
    ),
  );
});

test(
  'far below, the studio is not loaded until somebody comes near; a poster stands there meanwhile',
  { skip },
  async () => {
    const { page } = await hosts.open();
    await page.evaluate(
      async ({ studio }) => {
        document.body.style.paddingTop = '5000px';
        const early = document.createElement('sillon-studio'); // as in a page's HTML: older than its script
        for (const [name, value] of [
          ['base', studio],
          ['mode', 'view'],
          ['src', 'examples/logo.json'],
        ]) {
          early.setAttribute(name, value);
        }
        document.body.append(early);
        globalThis.early = early;
        await import(`${studio}embed/sillon-studio.js`);
        const element = document.createElement('sillon-studio');
        globalThis.ready = new Promise((resolve) => element.addEventListener('ready', resolve, { once: true }));
        element.setAttribute('poster', `${studio}icon.svg`);
        document.body.append(element);
        globalThis.element = element;
      },
      { studio: hosts.studio },
    );
    const poster = page.locator('sillon-studio:last-of-type img');
    await poster.waitFor();
    await page.evaluate(
      () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(resolve)))),
    );
    const addresses = await page.evaluate(() =>
      [globalThis.early, globalThis.element].map((one) => one.shadowRoot.querySelector('iframe').src),
    );
    assert.deepEqual(addresses, ['', '']);
    await page.evaluate(() => globalThis.early.remove());
    await page.evaluate(() => globalThis.element.scrollIntoView());
    await page.evaluate(() => globalThis.ready.then(() => undefined));
    assert.equal(await poster.isVisible(), false);
  },
);

test(
  'properties that are set before the script has come are attributes; undefined takes them away',
  { skip },
  async () => {
    const { page } = await hosts.open();
    const seen = await page.evaluate(
      async ({ studio }) => {
        const element = document.createElement('sillon-studio');
        Object.assign(element, { mode: 'view', units: 'in' });
        document.body.append(element);
        await import(`${studio}embed/sillon-studio.js`);
        await element.info();
        const address = new URL(element.shadowRoot.querySelector('iframe').src).search;
        element.units = undefined;
        return [address, element.mode, element.getAttribute('units')];
      },
      { studio: hosts.studio },
    );
    assert.deepEqual(seen, ['?mode=view&units=in', 'view', null]);
  },
);

test('events tell progress, result and changes by the visitor', { skip }, async () => {
  const { page, frame } = await usualElement();
  await load(page);
  await page.evaluate(() => globalThis.element.generate());
  await page.evaluate(() => (globalThis.heard.length = 0));
  await frame.evaluate(() =>
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, width: 60, height: 60 })),
  );
  await page.evaluate(() => globalThis.element.generate());
  const heard = await page.evaluate(() => globalThis.heard);
  const named = (name) => heard.filter((one) => one.name === name).map(({ detail }) => detail);
  assert.deepEqual(named('change'), [{ name: 'project', width: 60, height: 60 }]);
  assert.equal(named('result').at(-1).report.toolpaths, 1);
  assert.ok(named('progress').length > 0);
  for (const { stage, fraction, etaMs } of named('progress')) {
    assert.equal(typeof stage, 'string');
    assert.ok(fraction >= 0 && fraction <= 1);
    assert.ok(etaMs === null || etaMs >= 0);
  }
  assert.deepEqual(named('error'), []);
});

test('an abort rejects, ends the work, and leaves the studio usable', { skip }, async () => {
  const { page, frame } = await usualElement();
  const outcome = await page.evaluate(async (project) => {
    const { element } = globalThis;
    await element.load({ ...project, shape: { builtin: 'disc', size: [300, 300] }, toolpath: { spacing: 0.25 } });
    const control = new AbortController();
    const work = element.generate({ signal: control.signal });
    await new Promise((resolve) => element.addEventListener('progress', resolve, { once: true }));
    control.abort();
    return work.then(
      () => 'finished',
      ({ name }) => name,
    );
  }, project);
  assert.equal(outcome, 'AbortError');
  await stateIs(frame, (state) => state.cancelled && state.progress === undefined);
  await load(page);
  assert.equal(await page.evaluate(async () => (await globalThis.element.generate()).toolpaths), 1);
});

test('files are fetched by the host’s page, and a project brings what it names', { skip }, async () => {
  const { page, frame } = await element({ project: 'examples/logo.json', printer: 'prusa-mk4s' });
  await stateIs(frame, (state) => state.plate.shape.kind === 'file' && state.plate.layers[0].kind === 'map');
  assert.equal(await state(frame, (state) => state.plate.name), 'logo');
  assert.match(await state(frame, (state) => state.plate.printer.name), /MK4/);
  await page.evaluate(() => {
    globalThis.element.removeAttribute('project');
    globalThis.element.shape = 'examples/inputs/logo.svg';
    globalThis.element.image = 'examples/inputs/photo.png';
  });
  await stateIs(
    frame,
    (state) => state.plate.shape.file?.name === 'logo.svg' && state.plate.layers[0].kind === 'picture',
  );
});

test('no other plate is made while the one of the attributes is on its way', { skip }, async () => {
  let arrive;
  const arrived = new Promise((resolve) => (arrive = resolve));
  const prepare = async (page) => {
    await page.route('**/stress_17.json', async (route) => {
      await arrived;
      await route.continue();
    });
  };
  const opened = element({ project: 'examples/stress_17.json' }, { prepare });
  const frame = await until(() =>
    hosts.browser
      .contexts()
      .flatMap((context) => context.pages().flatMap((page) => page.frames()))
      .find((one) => one.url().includes('waits')),
  );
  await stateIs(frame, (state) => state.plate !== undefined);
  await new Promise((resolve) => setTimeout(resolve, 1500)); // else it would begin at once
  assert.deepEqual(await state(frame, ({ result, progress }) => [result === undefined, progress === undefined]), [
    true,
    true,
  ]);
  arrive();
  const { page } = await opened;
  await page.evaluate(() => globalThis.element.generate());
  const results = await page.evaluate(() => globalThis.heard.filter(({ name }) => name === 'result').length);
  assert.equal(results, 1);
  assert.equal(await state(frame, (state) => state.plate.name), 'stress_17');
});

const ofPlate = [
  ...['generate', 'report', 'getProject', 'exportGcode', 'exportBody', 'exportSvg', 'exportProject', 'exportView'],
  'capture',
];

/** What each method that gives something of a plate rejects with. */
const refusals = (page) =>
  page.evaluate(
    (methods) =>
      Promise.all(
        methods.map((method) =>
          globalThis.element[method]().then(
            () => `${method} gives something`,
            ({ code, message }) => `${code}: ${message}`,
          ),
        ),
      ),
    ofPlate,
  );
const results = (page) => page.evaluate(() => globalThis.heard.filter(({ name }) => name === 'result').length);
const errorsOf = (page) =>
  page.evaluate(() =>
    globalThis.heard.filter(({ name }) => name === 'error').map(({ detail }) => `${detail.code}: ${detail.message}`),
  );

/** Nothing but words all over the frame. @returns these */
async function wordsInstead(frame) {
  const words = frame.getByRole('alert');
  await words.waitFor();
  const { width, height } = await frame.evaluate(() => ({ width: innerWidth, height: innerHeight }));
  const box = await words.evaluate((one) => one.getBoundingClientRect().toJSON());
  assert.deepEqual([box.x, box.y, box.width, box.height], [0, 0, width, height]);
  assert.equal(await frame.locator('sillon-app').isVisible(), false);
  return words.innerText();
}

const noDrawing = { name: 'refused.svg', body: 'no drawing' };
const lacksFile = {
  name: 'lacks.json',
  body: JSON.stringify({ sillon: 1, shape: { file: 'nowhere.svg' }, layers: [{ kind: 'direction' }] }),
};
const served = async (page) => {
  for (const { name, body } of [noDrawing, lacksFile])
    await page.route(`**/${name}`, (route) => route.fulfill({ body }));
};

for (const [what, attributes, expected] of [
  ['a project that is not there', { project: 'gone.json' }, /^LoadFailed: .*gone\.json came with status 404$/],
  ['a drawing that is refused', { shape: 'refused.svg' }, /^UnknownFile: .*refused\.svg/],
  ['a project whose file is missing', { src: 'lacks.json' }, /^LoadFailed: .*nowhere\.svg came with status 404$/],
]) {
  test(`in the place of ${what} there is no other plate, no result and no file`, { skip }, async () => {
    const { page, frame, problems } = await element(attributes, { small: false, prepare: served });
    const told = await until(async () => (await errorsOf(page))[0], 'the error');
    assert.match(told, expected);
    assert.deepEqual(
      await refusals(page),
      ofPlate.map(() => told),
    );
    assert.ok((await wordsInstead(frame)).includes(told.replace(/^\w+: /, '')));
    assert.deepEqual(await state(frame, ({ result, progress }) => [result === undefined, progress === undefined]), [
      true,
      true,
    ]);
    assert.equal(await results(page), 0);
    await load(page);
    assert.equal(await page.evaluate(async () => (await globalThis.element.generate()).toolpaths), 1);
    assert.equal(await results(page), 1);
    assert.equal(await frame.locator('sillon-canvas').isVisible(), true);
    assert.deepEqual(await errorsOf(page), [told]);
    assert.deepEqual(problems, []);
  });
}

test('what cannot be shown takes the place of a plate that was there, until another is', { skip }, async () => {
  const { page, context, frame } = await element({}, { prepare: served });
  await page.evaluate(() => globalThis.element.generate()); // of nothing that is named: the studio's own
  await until(async () => (await results(page)) > 0, 'its result');
  const refused = async (name) => {
    const before = await results(page);
    const [first, ...others] = new Set(await refusals(page));
    assert.deepEqual(others, []);
    assert.match(first, name);
    await wordsInstead(frame);
    assert.equal(await results(page), before);
  };
  /** With its result, which may come later than its files. */
  const loaded = async () => {
    const before = await results(page);
    await load(page);
    await until(async () => (await results(page)) > before, 'the result');
  };
  await page.evaluate(() => (globalThis.element.image = 'gone.png'));
  await refused(/^LoadFailed: .*gone\.png/);
  await page.evaluate(() => globalThis.element.removeAttribute('image'));
  await refused(/gone\.png/);
  await loaded();
  assert.equal(await page.evaluate(async () => (await globalThis.element.exportSvg()).name), 'project.svg');
  const upload = page.evaluate(() =>
    globalThis.element.load(new File(['no drawing'], 'upload.svg')).catch(({ code, message }) => `${code}: ${message}`),
  );
  assert.match(await upload, /^UnknownFile: .*upload\.svg/);
  await refused(/^UnknownFile: .*upload\.svg/);
  await loaded();
  await frame.locator('sillon-canvas').waitFor();
  await context.setOffline(true);
  await page.evaluate(() => (globalThis.element.project = 'examples/stress_17.json'));
  await refused(/^LoadFailed: .*stress_17\.json could not be fetched: there is no connection/);
  await context.setOffline(false);
  await page.evaluate(() => (globalThis.element.project = './examples/stress_17.json'));
  await page.evaluate(() => globalThis.element.generate());
  assert.equal(await state(frame, ({ plate, result }) => result.plate === plate && plate.name), 'stress_17');
});

test('the poster stands in the place of what cannot be shown, if it is there itself', { skip }, async () => {
  const { page, frame } = await element({ project: 'gone.json', poster: `${hosts.studio}icon.svg` });
  const poster = page.locator('sillon-studio img');
  await poster.waitFor();
  const box = (one) => one.evaluate((one) => one.getBoundingClientRect().toJSON());
  assert.deepEqual(await box(poster), await box(page.locator('sillon-studio iframe')));
  await page.evaluate(() => (globalThis.element.poster = 'gone.png'));
  await poster.waitFor({ state: 'hidden' });
  assert.match(await wordsInstead(frame), /gone\.json/);
  await page.evaluate((studio) => (globalThis.element.poster = `${studio}icon.svg`), hosts.studio);
  await poster.waitFor();
  await load(page);
  await poster.waitFor({ state: 'hidden' });
});

test('a frame that comes anew shows what its page named last', { skip }, async () => {
  const { page, frame } = await element({ project: 'examples/stress_17.json' });
  const name = () => page.evaluate(async () => (await globalThis.element.exportSvg()).name);
  assert.equal(await name(), 'stress_17.svg');
  const anew = async (loads) => {
    await page.evaluate(() => {
      globalThis.ready = new Promise((resolve) =>
        globalThis.element.addEventListener('ready', resolve, { once: true }),
      );
    });
    await loads();
    await page.evaluate(() => globalThis.ready.then(() => undefined));
  };
  await anew(() => frame.evaluate(() => setTimeout(() => location.reload())));
  assert.equal(await name(), 'stress_17.svg');
  await load(page);
  await anew(() => page.evaluate(() => document.body.prepend(globalThis.element)));
  assert.equal(await name(), 'project.svg');
});

test('a plain frame whose address names what is not there shows that and nothing else', { skip }, async () => {
  const { page } = await hosts.open();
  const answers = await page.evaluate(
    async ({ studio, project }) => {
      const path = 'embed.html?project=gone.json';
      const { ask, messages, ready } = globalThis.connect(await globalThis.frameOf({ studio, path }));
      const { error } = await ask('exportProject');
      await ready;
      globalThis.more = async () => {
        await ask('load', { project });
        return (await ask('generate')).result.report.toolpaths;
      };
      return { error, results: messages.filter(({ event }) => event === 'result').length };
    },
    { studio: hosts.studio, project },
  );
  assert.equal(answers.error.code, 'GuestFile');
  assert.equal(answers.results, 0);
  const frame = page.frames().find((one) => one.url().includes('embed.html'));
  assert.match(await wordsInstead(frame), /^A file that this page names could not be opened\..*gone\.json.*404/);
  assert.equal(await page.evaluate(() => globalThis.more()), 1);
  await frame.locator('sillon-canvas').waitFor();
});

test('a download goes to the host, or to the visitor where the host lets it', { skip }, async () => {
  const { page, frame } = await element({ mode: 'customize', controls: 'size download' });
  await load(page);
  await page.evaluate(() => globalThis.element.generate());
  const svg = async () => {
    await frame.locator('[popovertarget=export]').click();
    await frame.locator('#export').getByRole('button', { name: 'Drawing (SVG)' }).click();
  };
  const [download] = await Promise.all([page.waitForEvent('download'), svg()]);
  assert.equal(download.suggestedFilename(), 'project.svg');

  const downloads = [];
  page.on('download', (download) => downloads.push(download.suggestedFilename()));
  await page.evaluate(() => {
    globalThis.taken = new Promise((resolve) => {
      const take = (event) => {
        event.preventDefault();
        const { name, type, blob } = event.detail;
        void blob.text().then((text) => resolve({ name, type, begins: text.slice(0, 200) }));
      };
      globalThis.element.addEventListener('export', take, { once: true });
    });
  });
  await svg();
  const { name, type, begins } = await page.evaluate(() => globalThis.taken);
  assert.deepEqual([name, type], ['project.svg', 'image/svg+xml']);
  assert.match(begins, /<svg/);
  // The next one is not taken, and the only one to come.
  await frame.evaluate(() =>
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, name: 'Next' })),
  );
  await Promise.all([page.waitForEvent('download'), svg()]);
  assert.deepEqual(downloads, ['Next.svg']);
});

test('customize shows only what the host names; view shows nothing but the plate', { skip }, async () => {
  const { page, frame } = await element({ mode: 'customize', controls: 'name, size, toolpath.spacing' });
  await page.setViewportSize({ width: 1000, height: 700 });
  await page.addStyleTag({ content: 'sillon-studio { width: 960px; height: 640px }' });
  const names = async () =>
    frame
      .locator('sillon-app button:visible')
      .evaluateAll((all) => all.map((one) => one.ariaLabel ?? one.innerText.trim()));
  await frame.locator('nav').getByRole('button', { name: 'Customize' }).click();
  await frame.getByLabel('Line width', { exact: false }).first().waitFor();
  assert.equal(await frame.locator('nav button').count(), 1);
  for (const absent of ['Download', 'Open', 'Gallery', 'Menu']) {
    assert.ok(!(await names()).some((name) => name.startsWith(absent)), absent);
  }
  await page.evaluate(() => (globalThis.element.mode = 'view'));
  await frame.locator('nav').waitFor({ state: 'detached' });
  assert.deepEqual(await frame.locator('sillon-header, sillon-status, sillon-tools').count(), 0);
  const { width, height } = await frame.locator('sillon-canvas').boundingBox();
  assert.deepEqual([width, height], [960, 640]);
  await page.evaluate(() => globalThis.element.removeAttribute('mode'));
  await frame.locator('nav button').nth(2).waitFor();
});

test('language, theme and units are the host’s choice, and are not kept', { skip }, async () => {
  const { page, frame } = await element({ lang: 'fr-CA', theme: 'dark', units: 'in' });
  await load(page);
  await stateIs(frame, (state) => state.plate.width === 16);
  assert.equal(await frame.evaluate(() => document.documentElement.dataset.theme), 'dark');
  assert.match((await frame.locator('sillon-status .figures').innerText()).replaceAll('\u00a0', ' '), /0,63 × 0,63 in/);
  await page.evaluate(() => {
    globalThis.element.lang = 'en';
    globalThis.element.units = 'mm';
    globalThis.element.theme = 'light';
  });
  await stateIs(frame, (state) => state.language === 'en' && state.units === 'mm' && state.theme === 'light');
  assert.match(await frame.locator('sillon-status .figures').innerText(), /16 × 16 mm/);
  const kept = await frame.evaluate(() => {
    try {
      return localStorage.length;
    } catch {
      return 0; // as frames of other sites find it
    }
  });
  assert.equal(kept, 0);
});

test('attributes that are set while the studio loads are taken once it is there', { skip }, async () => {
  const { page } = await hosts.open();
  await page.evaluate(
    async ({ studio }) => {
      await import(`${studio}embed/sillon-studio.js`);
      const element = document.createElement('sillon-studio');
      element.theme = 'light';
      document.body.append(element);
      const ready = element.info(); // loads it
      element.theme = 'dark';
      element.mode = 'view';
      await ready;
      await element.report(); // requests are answered in order
    },
    { studio: hosts.studio },
  );
  const frame = page.frames().find((one) => one.url().includes('embed.html'));
  assert.deepEqual(await state(frame, ({ theme, mode }) => [theme, mode]), ['dark', 'view']);
});

test('without the attribute the language is the visitor’s again', { skip }, async () => {
  const { page, frame } = await element({ lang: 'de' }, { locale: 'fr-CA' });
  await stateIs(frame, (state) => state.language === 'de');
  await page.evaluate(() => globalThis.element.removeAttribute('lang'));
  await stateIs(frame, (state) => state.language === 'fr');
});

test('it wears the colour, corners and font of its page, and gives them back', { skip }, async () => {
  const { page, frame } = await element({ accent: '#7a1fa2', radius: '12', font: 'Georgia, serif', theme: 'light' });
  const look = () =>
    frame.evaluate(() => {
      const { style } = document.documentElement;
      const { fontFamily } = getComputedStyle(document.body);
      const probe = document.createElement('p');
      probe.style.cssText = 'color: var(--accent); border-radius: var(--radius)';
      document.body.append(probe);
      const { color, borderRadius } = getComputedStyle(probe);
      probe.remove();
      return { color, borderRadius, fontFamily, own: style.length > 0 };
    });
  assert.deepEqual(await look(), {
    color: 'rgb(122, 31, 162)',
    borderRadius: '12px',
    fontFamily: 'Georgia, serif, system-ui, sans-serif',
    own: true,
  });
  await page.evaluate(async () => {
    const { element } = globalThis;
    for (const name of ['accent', 'radius', 'font']) element.removeAttribute(name);
    await element.report(); // requests are answered in order
  });
  const plain = await look();
  assert.deepEqual([plain.color, plain.borderRadius, plain.own], ['rgb(123, 84, 16)', '4px', false]);
  await page.evaluate(() => (globalThis.element.accent = 'url(https://elsewhere.invalid/)'));
  await page.waitForFunction(() => globalThis.heard.some(({ name }) => name === 'error'));
  const { code, message } = await page.evaluate(() => globalThis.heard.find(({ name }) => name === 'error').detail);
  assert.equal(code, 'GuestValue');
  assert.match(message, /accent/);
  assert.equal((await look()).own, false);
});

test('what runs can be asked before and after it is ready', { skip }, async () => {
  const { page, ready } = await usualElement();
  assert.deepEqual(await page.evaluate(() => globalThis.element.info()), ready);
  const early = await page.evaluate(async () => {
    const another = document.createElement('sillon-studio');
    another.style.marginTop = '3000px'; // out of sight: the question loads it, and no frame of it is ever drawn
    document.body.append(another);
    const info = await another.info();
    another.remove();
    return info;
  });
  assert.equal(early.version, ready.version);
});

test('a moving picture is made of what nobody sees; one that is given up ends', { skip }, async () => {
  const { page, frame } = await element();
  await page.evaluate(() => Object.assign(globalThis.element.style, { width: '760px', height: '420px' }));
  await load(page);
  await page.evaluate(() => globalThis.element.generate());
  const loop = (top) =>
    page.evaluate(async (top) => {
      const { element } = globalThis;
      const control = (globalThis.control = new AbortController());
      element.style.marginTop = top;
      element.scrollIntoView();
      scrollTo(0, 0);
      return element.capture({ type: 'loop', signal: control.signal }).then(
        ({ name }) => name,
        ({ name, code, message }) => (name === 'AbortError' ? name : `${code}: ${message}`),
      );
    }, top);
  assert.match(await loop('9000px'), /\.webp$/);
  const begun = loop('0');
  await stateIs(frame, (state) => state.recording);
  await page.evaluate(() => globalThis.control.abort());
  assert.equal(await begun, 'AbortError');
  await stateIs(frame, (state) => !state.recording);
  assert.match(await page.evaluate(async () => (await globalThis.element.capture({ width: 200 })).name), /\.png$/);
});

test('wrong attributes are told, with what is wrong', { skip }, async () => {
  const { page } = await element({ mode: 'everything' }); // with a link behind it
  const errors = () =>
    page.evaluate(() => globalThis.heard.filter(({ name }) => name === 'error').map(({ detail }) => detail));
  await page.waitForFunction(() => globalThis.heard.some(({ name }) => name === 'error'));
  assert.equal((await errors())[0].code, 'GuestValue');
  assert.match((await errors())[0].message, /mode.*everything/);
  await page.evaluate(() => (globalThis.element.src = 'missing.svg'));
  await page.waitForFunction(() => globalThis.heard.some(({ detail }) => detail.code === 'LoadFailed'));
  assert.match((await errors()).at(-1).message, /missing\.svg.*404/);
});

test(
  'what the engine refuses reaches the page around in the visitor’s language, with the figures',
  { skip },
  async () => {
    const { page } = await element({ lang: 'fr' });
    const project = { sillon: 1, shape: { builtin: 'disc', size: [24, 24] }, print: { place: [-5, 20] } };
    const { code, message, hint } = await page.evaluate(async (project) => {
      await globalThis.element.load(project);
      return globalThis.element.exportGcode().catch(({ code, message, hint }) => ({ code, message, hint }));
    }, project);
    assert.equal(code, 'DoesNotFit');
    assert.match(message, /^La plaque dépasse du plateau\s: 5\smm à gauche\.$/);
    assert.match(hint, /centrez/);
  },
);

test('work is kept for the page’s own site where it asks for that', { skip }, async () => {
  const first = await element({ autosave: 'shop', project: 'examples/stress_17.json' }, { site: 'localhost' });
  await stateIs(first.frame, (state) => state.plate.name === 'stress_17');
  await first.frame.evaluate(() =>
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, name: 'Mine' })),
  );
  const host = `${new URL(first.page.url()).origin} shop`;
  await until(async () => (await keptPlate(first.frame, host))?.name === 'Mine', 'the work in the storage');
  const again = async (attributes) => {
    await first.page.reload();
    await first.page.waitForFunction(() => globalThis.attempt !== undefined);
    await first.page.evaluate(
      async ({ studio, attributes }) => {
        await import(`${studio}embed/sillon-studio.js`);
        globalThis.element = document.createElement('sillon-studio');
        for (const [name, value] of Object.entries(attributes)) globalThis.element.setAttribute(name, value);
        document.body.append(globalThis.element);
      },
      { studio: hosts.studio, attributes },
    );
    return first.page.evaluate(async () => {
      await globalThis.element.generate();
      const { name } = await globalThis.element.exportSvg();
      return name;
    });
  };
  assert.equal(await again({ autosave: 'shop', project: 'examples/stress_17.json' }), 'Mine.svg');
  assert.equal(await again({ autosave: 'shop', project: 'gone.json' }), 'Mine.svg');
  const named = await first.page.evaluate(async () => {
    globalThis.element.project = 'examples/logo.json'; // another plate than the work is of
    return (await globalThis.element.exportSvg()).name;
  });
  assert.equal(named, 'logo.svg');
  assert.equal(await again({ autosave: 'other', project: 'examples/stress_17.json' }), 'stress_17.svg');
});

test('a plain frame opens the files of its address, without any script of the host', { skip }, async () => {
  const visit = await hosts.open();
  const { page } = visit;
  await page.evaluate((studio) => {
    const frame = document.createElement('iframe');
    frame.src = `${studio}embed.html?shape=examples/logo.svg&mode=view&lang=fr`;
    document.body.append(frame);
  }, hosts.studio);
  const frame = await until(() => page.frames().find((one) => one.url().includes('embed.html')));
  await stateIs(frame, (state) => state.plate.shape.file?.name === 'logo.svg' && state.mode === 'view');
  assert.equal(await frame.evaluate(() => document.documentElement.lang), 'fr');
});

test('a page whose own policy forbids the frame gets a link without a wait', { skip }, async () => {
  const visit = await hosts.open();
  const { page } = visit;
  const logged = [];
  page.on('console', (message) => logged.push(message.text()));
  const heard = await page.evaluate(async (studio) => {
    const { setTimeout } = globalThis;
    globalThis.setTimeout = (run, wait, ...more) => (wait > 5000 ? 0 : setTimeout(run, wait, ...more)); // no patience ends
    const policy = document.createElement('meta');
    Object.assign(policy, { httpEquiv: 'Content-Security-Policy', content: "frame-src 'none'" });
    document.head.append(policy);
    await import(`${studio}embed/sillon-studio.js`);
    const element = document.createElement('sillon-studio');
    const codes = [];
    element.addEventListener('error', ({ detail }) => codes.push(detail.code));
    document.body.append(element);
    const refused = await element.report().catch(({ code }) => code);
    return { codes, refused, link: element.shadowRoot?.querySelector('a')?.href };
  }, hosts.studio);
  assert.deepEqual([heard.codes, heard.refused], [['Blocked'], 'Blocked']);
  assert.deepEqual(
    logged.filter((text) => /Unrecognized feature/.test(text)),
    [],
  );
  await visit.context.close();
});

test(
  'without a host that takes files, downloads are the frame’s: not in a sandbox that forbids them',
  { skip: lacking('Chrome') }, // the headless shell does not say that it refuses
  async (context) => {
    const hosts = await startHosts('Chrome');
    context.after(() => hosts.close());
    for (const [sandbox, outcome] of [
      ['allow-scripts allow-same-origin allow-downloads', 'project.svg'],
      ['allow-scripts allow-same-origin', 'refused'],
    ]) {
      const visit = await hosts.open();
      const { page } = visit;
      const outcomes = [];
      page.on('download', (download) => outcomes.push(download.suggestedFilename()));
      page.on('console', (message) => /^Download is disallowed/.test(message.text()) && outcomes.push('refused'));
      await page.evaluate(
        async ({ studio, sandbox, project }) => {
          const { ask, ready } = globalThis.connect(await globalThis.frameOf({ studio, sandbox }));
          await ready;
          await ask('load', { project });
          await ask('generate');
        },
        { studio: hosts.studio, sandbox, project },
      );
      const frame = page.frames().find((one) => one.url().includes('embed.html'));
      await frame.evaluate(() => document.querySelector('sillon-app').studio.save('svg'));
      await until(() => outcomes.length > 0, 'a download, or word that there is none');
      assert.deepEqual(outcomes, [outcome], sandbox);
      await visit.context.close();
    }
  },
);
