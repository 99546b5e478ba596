// A visit to the studio without remote control: what a hand does there is done by this page, of the same site, which shows it.

const patience = 170_000; // [ms] for each step

async function until(condition, what) {
  const end = Date.now() + patience;
  for (;;) {
    const found = await condition();
    if (found) return found;
    if (Date.now() > end) throw new Error(`never came: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

const all = (root) =>
  [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);

/** Drops a file on the studio, and presses the buttons of its download.
 * @param path  of the studio @param address  of the file, which is of that type
 * @returns the G-code, and how many threads have made it */
async function download({ path, address, type }) {
  localStorage.setItem('sillon.print', JSON.stringify({ profile: 'generic' })); // else a sheet asks for the printer
  const frame = document.createElement('iframe');
  frame.src = path;
  document.body.append(frame);
  const inside = frame.contentWindow;
  const studio = await until(() => inside.document.querySelector('sillon-app')?.studio, 'the studio');
  const { store } = studio;
  const isReady = ({ plate, result, summary, progress, reading }) =>
    result?.plate === plate && result.measured && !result.coarse && summary !== undefined && !progress && !reading;
  await until(() => isReady(store.state), 'the first plate');
  const before = store.state.plate;
  const bytes = await (await fetch(address)).arrayBuffer();
  const transfer = new inside.DataTransfer();
  transfer.items.add(new inside.File([bytes], address.replace(/^.*\//, ''), { type }));
  inside.document
    .querySelector('sillon-app')
    .dispatchEvent(new inside.DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
  await until(() => store.state.plate !== before && isReady(store.state), 'the plate of the file');
  /** The link that a file is saved by. */
  const saved = new Promise((resolve) => {
    inside.HTMLAnchorElement.prototype.click = function () {
      resolve({ name: this.download, address: this.href });
    };
  });
  const find = (selector) => all(inside.document).find((one) => one.matches(selector));
  find('[popovertarget=export]').click();
  await until(() => find('#export:popover-open'), 'the list of downloads');
  const first = () => find('sillon-downloads')?.shadowRoot.querySelector('.item');
  (await until(first, 'the G-code in it')).click();
  const { name, address: blob } = await saved;
  const gcode = await (await inside.fetch(blob)).text();
  const { threads } = store.state.engine;
  frame.remove();
  return { name, gcode, threads };
}

const tasks = { download };

globalThis.attempt = async (name, args) => {
  try {
    return { value: await tasks[name](args) };
  } catch ({ name, message, stack }) {
    return { error: { name, message, stack } };
  }
};

// A browser without remote control names the task in the page's address, and takes the outcome from that of the next page.
if (location.hash !== '') {
  const { task, args, relay } = JSON.parse(decodeURIComponent(location.hash.slice(1)));
  void globalThis.attempt(task, args).then((outcome) => {
    location.replace(`${relay}#${encodeURIComponent(JSON.stringify(outcome))}`);
  });
}
