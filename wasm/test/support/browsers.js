// The machine's browsers, each behind the same few functions. A missing browser is named, so that tests show it as skipped.
import { accessSync, constants } from 'node:fs';
import { delimiter, join } from 'node:path';

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

const programs = {
  Chromium: firstProgram([process.env.CHROMIUM, '/usr/bin/chromium', 'chromium', 'chromium-browser', 'google-chrome']),
  Firefox: firstProgram([process.env.FIREFOX, '/usr/bin/firefox-esr', 'firefox-esr', 'firefox']),
};

/** For the option `skip` of a test: why it cannot run, or false. */
export const lacking = (name) =>
  programs[name] === undefined && `no ${name} here; install it, or set ${name.toUpperCase()} to its program`;

/**
 * Starts a browser with a fresh profile.
 * @returns {Promise<{newPage(): Promise<object>, close(): Promise<void>, cpuSeconds?: () => Promise<number>}>} pages are
 *   of profiles of their own, and have `goto`, `evaluate`, `frames` and `close`
 */
export const launch = (name) => (name === 'Firefox' ? launchFirefox() : launchChromium());

async function launchChromium() {
  const { chromium } = await import('playwright-core');
  const browser = await chromium.launch({
    executablePath: programs.Chromium,
    chromiumSandbox: false, // containers and root have none
    args: [
      '--disable-gpu',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
    ],
  });
  const session = await browser.newBrowserCDPSession();
  return {
    async newPage() {
      const context = await browser.newContext();
      const page = await context.newPage();
      page.on('close', () => void context.close());
      return page;
    },
    /** That its pages and their workers have used so far. */
    async cpuSeconds() {
      const { processInfo } = await session.send('SystemInfo.getProcessInfo');
      return processInfo.filter(({ type }) => type === 'renderer').reduce((sum, { cpuTime }) => sum + cpuTime, 0);
    },
    close: () => browser.close(),
  };
}

async function launchFirefox() {
  const { default: puppeteer } = await import('puppeteer-core');
  const browser = await puppeteer.launch({
    browser: 'firefox',
    executablePath: programs.Firefox,
    headless: true,
  });
  return {
    async newPage() {
      const context = await browser.createBrowserContext();
      const page = await context.newPage();
      return page;
    },
    close: () => browser.close(),
  };
}
