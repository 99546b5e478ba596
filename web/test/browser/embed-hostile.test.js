// Pages and frames that mean harm: neither side may run script in the other, command it without leave, or read what is not
// its own.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { lacking } from '../../../wasm/test/support/browsers.js';
import { serve as servePlain } from '../../../wasm/test/support/server.js';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { project, startHosts } from './support/hosts.js';
import { sharedBench } from './support/shared.js';
import { smallPlate } from './support/small.js';
import { keptPlate, until } from './support/waits.js';

const skip = lacking('Chromium');
const hosts = sharedBench(skip, startHosts);

/** A frame that has said hello in the page of a host; `talk` connects to it. */
async function greeted(options) {
  const visit = await hosts.open(options);
  const { page } = visit;
  await page.evaluate(async (studio) => {
    globalThis.greeted = await globalThis.frameOf({ studio });
  }, hosts.studio);
  return { ...visit, frame: page.frames().find((one) => one.url().includes('embed.html')) };
}
const connected = async (page) =>
  page.evaluate(async () => {
    globalThis.host = globalThis.connect(globalThis.greeted);
    await globalThis.host.ready;
  });
const ask = (page, method, params) =>
  page.evaluate(([method, params]) => globalThis.host.ask(method, params), [method, params]);

test('nothing is done before the handshake', { skip }, async () => {
  const { page } = await greeted();
  await page.evaluate(() => {
    const heard = [];
    globalThis.heard = heard;
    addEventListener('message', ({ data }) => heard.push(data));
    const { frame } = globalThis.greeted;
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = ({ data }) => heard.push(data);
    const request = { v: 1, id: 1, method: 'getProject' };
    frame.contentWindow.postMessage(request, '*');
    frame.contentWindow.postMessage(request, '*', [port2]);
    for (const greeting of [
      { sillon: 'connect' },
      { sillon: 'connect', v: '1' },
      { sillon: 'hello', v: 1 },
      'connect',
      null,
      [{ sillon: 'connect', v: 1 }],
    ]) {
      const channel = new MessageChannel();
      channel.port1.onmessage = ({ data }) => heard.push(data);
      channel.port1.postMessage(request);
      frame.contentWindow.postMessage(greeting, '*', [channel.port2]);
    }
    frame.contentWindow.postMessage({ sillon: 'connect', v: 1 }, '*'); // without a port
  });
  await connected(page); // none of it was taken for the host, and all of it has been read by now
  assert.equal((await ask(page, 'report')).error, undefined);
  assert.deepEqual(await page.evaluate(() => globalThis.heard), []);
});

test('only the page around it is taken for the host, and only once', { skip }, async () => {
  const { page } = await greeted();
  // A neighbour in the same page.
  await page.evaluate(async () => {
    const frame = document.createElement('iframe');
    frame.src = 'host.html';
    document.body.append(frame);
    await new Promise((resolve) => (frame.onload = resolve));
    const heard = [];
    globalThis.heard = heard;
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = ({ data }) => heard.push(data);
    globalThis.port2 = port2;
    // By the neighbour's own hand: it is the source.
    frame.contentWindow.eval(`parent.frames[0].postMessage({ sillon: 'connect', v: 1 }, '*', [parent.port2])`);
  });
  await connected(page); // what the neighbour said has been read by now
  assert.equal((await ask(page, 'report')).error, undefined);
  assert.deepEqual(await page.evaluate(() => globalThis.heard), []);
  const second = await page.evaluate(async () => {
    const other = globalThis.connect(globalThis.greeted);
    await globalThis.host.ask('generate'); // it has had time
    await new Promise((resolve) => setTimeout(resolve, 300));
    return other.messages;
  });
  assert.deepEqual(second, []);
});

test('a studio that lists its hosts obeys no other', { skip }, async () => {
  const listing = (origin) => async (page) => {
    await page.route(`${hosts.studio}embed.html`, async (route) => {
      const response = await route.fetch();
      const body = (await response.text()).replace(
        'name="sillon-hosts" content="*"',
        `name="sillon-hosts" content="${origin}"`,
      );
      await route.fulfill({ response, body });
    });
  };
  const origin = new URL(hosts.host).origin;
  for (const [list, obeys] of [
    ['https://shop.example', false],
    [`${origin}.evil.example`, false],
    [`https://shop.example ${origin}`, true],
  ]) {
    const { page, context } = await greeted({ prepare: listing(list) });
    const messages = await page.evaluate(async (obeys) => {
      const host = globalThis.connect(globalThis.greeted);
      await (obeys ? host.ready : new Promise((resolve) => setTimeout(resolve, 1500)));
      return host.messages.length;
    }, obeys);
    assert.equal(messages > 0, obeys, list);
    await context.close();
  }
});

test('requests of wrong forms are refused in words or dropped, and the studio goes on', { skip }, async () => {
  const { page, problems } = await greeted();
  await connected(page);
  const code = async (method, params) => (await ask(page, method, params)).error?.code;
  for (const method of ['constructor', '__proto__', 'toString', 'hasOwnProperty', '', 'close', 'exportGcode ']) {
    assert.equal(await code(method, {}), 'UnknownMethod', method);
  }
  assert.equal(await code('capture', { width: 1e9 }), 'BadRequest');
  assert.equal(await code('capture', { type: 'video' }), 'BadRequest');
  const wrong = [
    {},
    { files: 'all' },
    { files: [] },
    { files: [null] },
    { files: [{ name: 'a.svg' }] },
    { files: [{ name: 7, bytes: 'x' }] },
    { project: 7 },
    { project: [] },
    { project: 'javascript:alert(1)' },
  ];
  for (const params of wrong) assert.equal(await code('load', params), 'BadRequest', JSON.stringify(params));
  for (const params of [{ mode: 'admin' }, { controls: 'innerHTML' }, { lang: '__proto__' }, { printer: 7 }]) {
    assert.equal(await code('configure', params), 'GuestValue', JSON.stringify(params));
  }
  assert.equal(await code('load', { project: { sillon: 1, nothing: 2 } }), 'BrokenProject');
  const dropped = await page.evaluate(async () => {
    const { port, messages, ask } = globalThis.host;
    const before = messages.filter(({ id }) => id !== undefined).length;
    const circle = {};
    circle.circle = circle;
    for (const message of [
      null,
      'getProject',
      7n,
      [],
      new Map([['v', 1]]),
      { v: 1, method: 'report' },
      { v: 1, id: 'x', method: 'report' },
      { v: 1, id: 0.5, method: 'report' },
      { v: 1, id: 5, method: {} },
      { v: 1, id: 6, method: 'load', params: [] },
      { id: 7, method: 'report' },
      new ArrayBuffer(8),
    ]) {
      port.postMessage(message);
    }
    const loop = await ask('load', { project: circle });
    const polluted = await ask('configure', JSON.parse('{ "__proto__": { "mode": "view" }, "unknown": 1 }'));
    const count = messages.filter(({ id }) => id !== undefined).length - before;
    port.postMessage({ v: 2, id: 8, method: 'report' });
    await ask('report');
    const version = messages.find(({ id }) => id === 8);
    return { count, loop: loop.error.code, polluted: polluted.result, version: version.error.code };
  });
  assert.deepEqual(dropped, { count: 2, loop: 'BadRequest', polluted: null, version: 'Version' });
  assert.equal((await ask(page, 'load', { project })).error, undefined);
  assert.equal((await ask(page, 'generate', {})).result.report.toolpaths, 1);
  assert.deepEqual(problems, []);
});

test('too much is refused: files, bytes, text, and requests that wait', { skip }, async () => {
  const { page } = await greeted();
  await connected(page);
  const codes = await page.evaluate(async () => {
    const { ask } = globalThis.host;
    const file = (size) => ({ name: 'a.svg', bytes: new ArrayBuffer(size) });
    const found = {};
    found.files = (await ask('load', { files: Array.from({ length: 17 }, () => file(1)) })).error.code;
    found.bytes = (await ask('load', { files: [file(64e6 + 1)] })).error.code;
    found.text = (await ask('load', { project: { sillon: 1, name: 'x'.repeat(2 << 20) } })).error.code;
    const nested = (depth) => (depth === 0 ? {} : { deep: nested(depth - 1) });
    found.depth = (await ask('load', { project: { sillon: 1, deep: nested(100) } })).error.code;
    void ask('load', { project: { sillon: 1, deep: nested(5000) } }); // browsers may not even hand it over
    void ask('load', {
      project: { sillon: 1, shape: { builtin: 'disc', size: [400, 400] }, toolpath: { spacing: 0.2 } },
    });
    found.busy = 0;
    for (let k = 0; k < 40; ++k)
      void ask('generate').then(({ error }) => (found.busy += error?.code === 'Busy' ? 1 : 0));
    const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
    while (found.busy < 8) await pause(50); // a busy frame reads its messages late
    await pause(1000); // too many would come now
    return found;
  });
  const { busy, ...rest } = codes;
  assert.deepEqual(rest, { files: 'TooLarge', bytes: 'TooLarge', text: 'TooLarge', depth: 'BrokenProject' });
  assert.ok(busy >= 8 && busy <= 10, `${busy} are refused`); // of 40, and of what came before
});

test('script in names and drawings does not run in the studio', { skip }, async () => {
  const { page, frame } = await greeted();
  await connected(page);
  await page.evaluate(async () => {
    const drawing = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 20" onload="globalThis.ran = 1">
      <script>globalThis.ran = 2</script><image href="x" onerror="globalThis.ran = 3"/>
      <rect width="20" height="20" onclick="globalThis.ran = 4"/></svg>`;
    const bytes = new TextEncoder().encode(drawing).buffer;
    const name = `<img src=x onerror="globalThis.ran = 5">.svg`;
    await globalThis.host.ask('load', { files: [{ name, bytes }] });
    await globalThis.host.ask('generate');
  });
  assert.equal(await frame.evaluate(() => globalThis.ran), undefined);
  assert.equal(
    await frame.evaluate(() => document.querySelector('sillon-app').studio.store.state.plate.shape.kind),
    'file',
  );
  const { result } = await page.evaluate(() => globalThis.host.ask('exportSvg'));
  assert.doesNotMatch(result.name, /[<>"/\\]/);
});

test('a host reads nothing of what the visitor keeps in the studio itself', { skip }, async () => {
  // A host of the same site, whose frames share the studio's storage.
  const { page, context } = await hosts.open({ site: 'localhost' });
  const studio = await context.newPage();
  await studio.goto(`${hosts.studio}${smallPlate}`);
  await studio.waitForFunction(() => document.querySelector('sillon-app')?.studio.store.state.result !== undefined);
  await studio.evaluate(() =>
    document
      .querySelector('sillon-app')
      .studio.change((plate) => ({ ...plate, name: 'Secret', width: 33, height: 33 })),
  );
  await until(async () => (await keptPlate(studio))?.name === 'Secret', 'the work in the storage');
  for (const query of ['', '?autosave=', '?autosave=plate']) {
    const told = await page.evaluate(
      async ({ studio, query }) => {
        const { ask, ready } = globalThis.connect(await globalThis.frameOf({ studio, path: `embed.html${query}` }));
        await ready;
        return JSON.stringify([await ask('getProject'), (await ask('exportSvg')).result.name]);
      },
      { studio: hosts.studio, query },
    );
    assert.doesNotMatch(told, /Secret|\b33\b/, query);
  }
});

// --- Hostile frames --------------------------------------------------------------------------------------------------------

/** A site that says it is the studio. @param script  of its embed.html */
async function impostor(script, run) {
  const folder = mkdtempSync(join(tmpdir(), 'sillon-impostor-'));
  writeFileSync(join(folder, 'embed.html'), `<!doctype html><script>${script}</script>`);
  const site = await servePlain({ '/': `${folder}/` }, { 'Access-Control-Allow-Origin': '*' });
  try {
    return await run(`${site.origin}/`);
  } finally {
    site.close();
    rmSync(folder, { recursive: true });
  }
}

/** The element, with another base, and all that it tells.
 * @param last  an event that it tells at the end; none: what it tells at once */
const heardFrom = (page, base, last) =>
  page.evaluate(
    async ({ studio, base, last }) => {
      await import(`${studio}embed/sillon-studio.js`);
      const element = document.createElement('sillon-studio');
      const heard = [];
      const names = ['ready', 'progress', 'result', 'change', 'error', 'click', 'load', 'x'];
      for (const name of names) element.addEventListener(name, ({ detail }) => heard.push([name, detail]));
      element.addEventListener('export', (event) => {
        event.preventDefault();
        heard.push(['export', event.detail.name, event.detail.type, event.detail.blob.type]);
      });
      element.setAttribute('base', base);
      document.body.append(element);
      while (last !== undefined && !heard.some(([name]) => name === last))
        await new Promise((resolve) => setTimeout(resolve, 20));
      await new Promise((resolve) => setTimeout(resolve, 300)); // for what must not come
      return { heard, src: element.shadowRoot.querySelector('iframe').src, ran: globalThis.ran };
    },
    { studio: hosts.studio, base, last },
  );

test('what a hostile frame says is dropped or made harmless', { skip }, async () => {
  const visit = await hosts.open();
  const script = `
    addEventListener('message', ({ ports: [port] }) => {
      const tell = (event, detail) => port.postMessage({ v: 1, event, detail });
      tell('click', {}); tell('x', {}); tell('__proto__', {}); tell('ready', 'now'); tell('ready', [1]);
      port.postMessage({ v: 2, event: 'change', detail: {} });
      port.postMessage({ v: 1, id: 1, result: 1 });
      port.postMessage(null); port.postMessage('<script>');
      tell('export', { name: '../../<img onerror=ran=1>.html', type: 'text/html', bytes: new ArrayBuffer(3) });
      tell('export', { name: 'a.html', type: 'text/html', bytes: 'no bytes' });
      tell('change', {});
    });
    parent.postMessage({ sillon: 'hello', v: 1 }, '*');`;
  const { heard, ran } = await impostor(script, (base) => heardFrom(visit.page, base, 'change'));
  assert.equal(ran, undefined);
  assert.deepEqual(heard, [
    ['export', '_.._img onerror=ran=1_.html', 'application/octet-stream', 'application/octet-stream'],
    ['change', {}],
  ]);
});

test(
  'a frame downloads nothing in the page’s name that no visitor asked for, or that no studio writes',
  { skip },
  async () => {
    const { context } = await hosts.open();
    // Whatever a test evaluates in a page counts as a visitor's gesture there: this page speaks by itself.
    const page = await context.newPage();
    const told = [];
    page.on('console', (message) => {
      if (message.text().startsWith('NoDownload')) told.push(message.text());
    });
    page.on('download', (download) => told.push(`downloaded ${download.suggestedFilename()}`));
    const script = `
    addEventListener('message', ({ ports: [port] }) => {
      for (const name of ['plate.gcode', 'plate.exe'])
        port.postMessage({ v: 1, event: 'export', detail: { name, type: 'text/x-gcode', bytes: new ArrayBuffer(3) } });
    });
    parent.postMessage({ sillon: 'hello', v: 1 }, '*');`;
    await impostor(script, async (base) => {
      await page.addInitScript(
        ({ studio, base }) => {
          if (globalThis !== globalThis.top) return;
          addEventListener('load', async () => {
            await import(`${studio}embed/sillon-studio.js`);
            const element = document.createElement('sillon-studio');
            element.setAttribute('base', base);
            element.addEventListener('error', ({ detail }) => console.log(detail.code, detail.message));
            document.body.append(element);
          });
        },
        { studio: hosts.studio, base },
      );
      await page.goto(`${hosts.host}host.html`);
      await until(() => told.length >= 2, 'both are told');
    });
    assert.deepEqual(told, [
      'NoDownload plate.gcode was not asked for by the visitor.',
      'NoDownload plate.exe was not asked for by the visitor.',
    ]);
  },
);

test('a frame that goes to another site gets no port', { skip }, async () => {
  const visit = await hosts.open();
  const gone = `
    addEventListener('message', () => parent.postMessage({ got: 'a port' }, '*'));
    parent.postMessage({ sillon: 'hello', v: 1 }, '*');`;
  const got = await impostor(gone, (elsewhere) =>
    impostor(`location.replace('${elsewhere}embed.html')`, async (base) => {
      await visit.page.evaluate(() => {
        globalThis.hello = new Promise((resolve) => {
          addEventListener('message', ({ data }) => {
            if (data.got) globalThis.got = data.got;
            if (data.sillon === 'hello') resolve();
          });
        });
      });
      await heardFrom(visit.page, base);
      await visit.page.evaluate(async () => {
        await globalThis.hello; // from the other site
        await new Promise((resolve) => setTimeout(resolve, 300));
      });
      return visit.page.evaluate(() => globalThis.got);
    }),
  );
  assert.equal(got, undefined);
});

test('addresses of script and data are neither framed nor fetched', { skip }, async () => {
  const visit = await hosts.open();
  for (const base of [
    'javascript:globalThis.ran=1//',
    'data:text/html,<script>parent.ran=1</script>',
    'blob:x',
    'file:///',
  ]) {
    const { heard, src, ran } = await heardFrom(visit.page, base, 'error');
    assert.equal(ran, undefined);
    assert.equal(src, '');
    assert.equal(heard[0][0], 'error', base);
  }
  const refused = await visit.page.evaluate(async (studio) => {
    const { customElements, document } = globalThis;
    await customElements.whenDefined('sillon-studio');
    const found = [];
    for (const src of ['javascript:globalThis.ran=1', 'data:image/svg+xml,<svg/>', 'file:///etc/passwd', 'http://[']) {
      const element = document.createElement('sillon-studio');
      element.setAttribute('base', studio);
      element.setAttribute('src', src);
      const error = new Promise((resolve) => element.addEventListener('error', ({ detail }) => resolve(detail.code)));
      document.body.append(element);
      found.push(await error);
      element.remove();
    }
    return { found, ran: globalThis.ran };
  }, hosts.studio);
  assert.deepEqual(refused, { found: Array(4).fill('LoadFailed'), ran: undefined });
});

test('the studio’s address fetches nothing from other sites', { skip }, async () => {
  const visit = await hosts.open();
  const { page } = visit;
  const asked = [];
  page.on('request', (request) => asked.push(request.url()));
  for (const src of [
    `${hosts.host}examples/inputs/logo.svg`,
    'javascript:globalThis.ran=1',
    'data:image/svg+xml,<svg/>',
  ]) {
    asked.length = 0;
    const errors = await page.evaluate(
      async ({ studio, src }) => {
        document.body.replaceChildren();
        const path = `embed.html?src=${encodeURIComponent(src)}`;
        const { messages, ready } = globalThis.connect(await globalThis.frameOf({ studio, path }));
        await ready;
        return messages.filter(({ event }) => event === 'error').map(({ detail }) => detail.code);
      },
      { studio: hosts.studio, src },
    );
    assert.deepEqual(errors, ['GuestFile'], src);
    assert.deepEqual(
      asked.filter((url) => !url.startsWith(hosts.studio) && !url.startsWith('blob:')),
      [],
      src,
    );
  }
});
