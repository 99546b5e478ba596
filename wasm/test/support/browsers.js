// The machine's browsers, which do the tasks of browser/pages/page.js. A missing browser is named, so that its tests show
// as skipped.
import { spawn } from 'node:child_process';
import { accessSync, constants, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { delimiter, join } from 'node:path';

const patience = 180; // [s] for one task: far more than a slow machine that is busy with other things takes

function firstProgram(candidates) {
  const folders = (process.env.PATH ?? '').split(delimiter);
  return candidates
    .filter((candidate) => candidate !== undefined)
    .flatMap((candidate) => (candidate.includes('/') ? [candidate] : folders.map((folder) => join(folder, candidate))))
    .find((path) => {
      try {
        accessSync(path, constants.X_OK);
        return true;
      } catch {
        return false;
      }
    });
}

const chrome = firstProgram([process.env.CHROME, '/usr/bin/chromium', 'chromium', 'chromium-browser', 'google-chrome']);
const programs = {
  /** Its headless shell first: without the parts of a browser around its pages, a visit takes a fifth less CPU time. */
  Chromium: firstProgram([process.env.CHROMIUM, 'chromium-headless-shell']) ?? chrome,
  /** The whole browser. */
  Chrome: chrome,
  Firefox: firstProgram([process.env.FIREFOX, '/usr/bin/firefox-esr', 'firefox-esr', 'firefox']),
  /** Debian's webkit2gtk-driver: the engine of Safari, in GTK's clothes. */
  WebKit:
    (process.env.DISPLAY ?? firstProgram(['xvfb-run'])) &&
    firstProgram([process.env.WEBKIT, '/usr/bin/WebKitWebDriver', 'WebKitWebDriver']),
};

/** For the option `skip` of a test: why it cannot run, or false. */
export const lacking = (name) =>
  programs[name] === undefined && `no ${name} here; install it, or set ${name.toUpperCase()} to its program`;

function inTime(promise, what) {
  let timer;
  const late = new Promise((_, reject) => {
    timer = setTimeout(() => reject(new Error(`${what} gave no answer within ${patience} s`)), 1000 * patience);
  });
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

/** For `startChromium`. */
export const withoutGraphics = ['--disable-3d-apis'];

/**
 * Starts a browser with a fresh profile. Its `attempt` opens a page, has it do a task by the page's function of the same name
 * and gives what came of it: { value } or { error }.
 * @param {{ graphics?: boolean }} [options]  without graphics there is no WebGL
 * @returns {Promise<{attempt(url: string, task: string, args: object): Promise<object>, close(): Promise<void>}>}
 */
export const launch = (name, options = {}) =>
  ({ Chromium: launchChromium, Firefox: launchFirefox, WebKit: launchWebKit })[name](options);

/** Playwright's Chromium, for tests that look at pages of other kinds. With SLOW=4 its pages run four times slower, as on a
 * weak machine: a test that reads too early fails there. @param more  arguments of the program
 * @param name  Chromium or Chrome */
export async function startChromium(more = [], name = 'Chromium') {
  const { chromium } = await import('playwright-core');
  const browser = await chromium.launch({
    executablePath: programs[name],
    chromiumSandbox: false, // containers and root have none
    args: [
      '--disable-gpu',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
      ...more,
    ],
  });
  const newContext = browser.newContext.bind(browser);
  browser.newContext = async (options) => {
    const context = await newContext(options);
    context.setDefaultTimeout(1000 * patience);
    if (process.env.SLOW !== undefined) slowDown(context, Number(process.env.SLOW));
    return context;
  };
  return browser;
}

function slowDown(context, rate) {
  context.on('page', async (page) => {
    const session = await context.newCDPSession(page);
    await session.send('Emulation.setCPUThrottlingRate', { rate });
  });
}

/** Has `cpuSeconds` and `playwright`, its browser, besides. */
async function launchChromium({ graphics = true }) {
  const browser = await startChromium(graphics ? [] : withoutGraphics);
  const session = await browser.newBrowserCDPSession();
  return {
    playwright: browser,
    /** @param whileOpen  asked when the task is done, while its page is there */
    async attempt(url, task, args, whileOpen) {
      const context = await browser.newContext({ reducedMotion: 'reduce' }); // pictures are drawn in software
      try {
        const page = await context.newPage();
        await page.goto(url); // until its modules have run
        const doTask = page.evaluate(([task, args]) => globalThis.attempt(task, args), [task, args]);
        const outcome = await inTime(doTask, `task ${task}`);
        await whileOpen?.();
        return outcome;
      } finally {
        await context.close();
      }
    },
    /** That all pages and their workers have used so far. */
    async cpuSeconds() {
      const { processInfo } = await session.send('SystemInfo.getProcessInfo');
      return processInfo.filter(({ type }) => type === 'renderer').reduce((sum, { cpuTime }) => sum + cpuTime, 0);
    },
    close: () => browser.close(),
  };
}

const quietFirefox = `
user_pref("app.normandy.enabled", false);
user_pref("app.update.disabledForTesting", true);
user_pref("browser.aboutwelcome.enabled", false);
user_pref("browser.shell.checkDefaultBrowser", false);
user_pref("datareporting.policy.dataSubmissionEnabled", false);
user_pref("network.captive-portal-service.enabled", false);
user_pref("network.connectivity-service.enabled", false);
user_pref("toolkit.telemetry.server", "");
user_pref("ui.prefersReducedMotion", 1);
`;

const relayPage = `<!doctype html><meta charset="utf-8" /><title>relay</title><script type="module">
  const { task } = await (await fetch('/', { method: 'POST', body: location.hash })).json();
  location.replace(task);
</script>`;

/**
 * Not remote-controlled: where Firefox 153 is, by WebDriver BiDi, one in thirty workers that a worker starts hangs (none in
 * a thousand otherwise). Instead the test page finds its task in its address, and goes on with the outcome in the address of
 * a page that fetches the next.
 */
async function launchFirefox({ graphics = true }) {
  let finishTask = () => {};
  let cameBack = () => {};
  let asking; // the relay page's request for a task, to be answered
  const server = createServer((request, response) => {
    if (request.method === 'GET') {
      response.writeHead(200, { 'Content-Type': 'text/html' }).end(relayPage);
      return;
    }
    let outcome = '';
    request.setEncoding('utf8');
    request.on('data', (text) => (outcome += text));
    request.on('end', () => {
      asking = response;
      if (outcome !== '') finishTask(JSON.parse(decodeURIComponent(outcome.slice(1))));
      cameBack();
    });
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const relay = `http://localhost:${server.address().port}/`;

  const profile = mkdtempSync(join(tmpdir(), 'sillon-firefox-'));
  writeFileSync(join(profile, 'user.js'), `${quietFirefox}user_pref("webgl.disabled", ${!graphics});\n`);
  const firefox = spawn(programs.Firefox, ['--headless', '--no-remote', '--profile', profile, relay], {
    stdio: 'ignore',
    env: { ...process.env, HOME: profile }, // it refuses to run as root in a home of somebody else, such as a container's
    detached: true, // its processes are a group, to be ended together
  });
  const ended = new Promise((resolve) => {
    firefox.once('exit', resolve);
    firefox.once('error', resolve);
  });
  const ask = (promise, what) =>
    inTime(
      Promise.race([promise, ended.then((status) => Promise.reject(new Error(`Firefox ended: ${status}`)))]),
      what,
    );
  const end = () => {
    try {
      process.kill(-firefox.pid, 'SIGKILL');
    } catch {
      // it has ended by itself
    }
  };
  process.once('exit', end);
  const close = async () => {
    end();
    await ended;
    process.off('exit', end);
    server.close();
    server.closeAllConnections();
    rmSync(profile, { recursive: true, force: true, maxRetries: 10 });
  };

  try {
    await ask(new Promise((resolve) => (cameBack = resolve)), programs.Firefox);
  } catch (problem) {
    await close();
    throw problem;
  }
  return {
    async attempt(url, task, args) {
      if (asking === undefined) throw new Error('Firefox has not come back from its last task');
      const outcome = new Promise((resolve) => (finishTask = resolve));
      const address = `${url}#${encodeURIComponent(JSON.stringify({ task, args, relay }))}`;
      asking.writeHead(200, { 'Content-Type': 'application/json' }).end(JSON.stringify({ task: address }));
      asking = undefined;
      return ask(outcome, `task ${task}`);
    },
    close,
  };
}

const miniBrowser = firstProgram(
  ['4.1', '4.0'].map(
    (version) =>
      `/usr/lib/${process.arch === 'arm64' ? 'aarch64' : 'x86_64'}-linux-gnu/webkit2gtk-${version}/MiniBrowser`,
  ),
);
/** WebKit's capabilities; where its browser lies elsewhere, it has graphics. */
const withoutWebGl =
  miniBrowser === undefined
    ? {}
    : { 'webkitgtk:browserOptions': { binary: miniBrowser, args: ['--automation', '--enable-webgl=false'] } };

/** By WebDriver, whose commands are a few requests. */
async function launchWebKit({ graphics = true }) {
  const port = await freePort();
  const screen = process.env.DISPLAY === undefined ? ['xvfb-run', '-a'] : []; // it has no headless mode
  const [program, ...list] = [...screen, programs.WebKit, `--port=${port}`, '--host=127.0.0.1'];
  const driver = spawn(program, list, {
    stdio: 'ignore',
    detached: true, // its browser is of its group
    // A container has no namespaces to lend, nor a graphics card.
    env: { ...process.env, WEBKIT_DISABLE_SANDBOX_THIS_IS_DANGEROUS: '1', WEBKIT_DISABLE_DMABUF_RENDERER: '1' },
  });
  const end = () => {
    try {
      process.kill(-driver.pid, 'SIGKILL');
    } catch {
      // it has ended by itself
    }
  };
  process.once('exit', end);
  const close = () => {
    end();
    process.off('exit', end);
  };
  const ask = async (method, path, body) => {
    const response = await fetch(`http://127.0.0.1:${port}${path}`, { method, body: body && JSON.stringify(body) });
    const { value } = await response.json();
    if (!response.ok) throw new Error(`WebKit: ${value.message ?? value.error}`);
    return value;
  };
  const begin = async () => {
    for (const end = Date.now() + 1000 * patience; ;) {
      try {
        return await ask('POST', '/session', { capabilities: { alwaysMatch: graphics ? {} : withoutWebGl } });
      } catch (problem) {
        if (Date.now() > end || !(problem instanceof TypeError)) throw problem; // TypeError: it does not listen yet
        await new Promise((resolve) => setTimeout(resolve, 100));
      }
    }
  };
  try {
    const { sessionId } = await inTime(begin(), programs.WebKit);
    const session = `/session/${sessionId}`;
    await ask('POST', `${session}/timeouts`, { script: 1000 * patience, pageLoad: 1000 * patience });
    return {
      async attempt(url, task, args) {
        await ask('POST', `${session}/url`, { url });
        const script = 'const [task, args, done] = arguments; void globalThis.attempt(task, args).then(done);';
        return inTime(ask('POST', `${session}/execute/async`, { script, args: [task, args] }), `task ${task}`);
      },
      async close() {
        await ask('DELETE', session).catch(() => undefined);
        close();
      },
    };
  } catch (problem) {
    close();
    throw problem;
  }
}

async function freePort() {
  const server = createServer();
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const { port } = server.address();
  await new Promise((resolve) => server.close(resolve));
  return port;
}
