// What pages of other sites do with the studio, as tasks of the tests. Every task gives plain data.

const tasks = { plate, raw, blocked };

globalThis.attempt = async (name, args) => {
  try {
    return { value: await tasks[name](args) };
  } catch ({ name, code, message, hint, stack }) {
    return { error: { name, code, message, hint, stack } };
  }
};

const inTime = (promise, what, patience = 170_000) =>
  Promise.race([
    promise,
    new Promise((_, reject) => setTimeout(() => reject(new Error(`${what} never came`)), patience)),
  ]);

async function digest(bytes) {
  // The date is all that two runs may differ in.
  const text = new TextDecoder().decode(bytes).replace(/\d{4}-\d\d-\d\d at \d\d:\d\d:\d\d UTC/, 'DATE');
  let hash = 0xcbf29ce484222325n; // FNV-1a: plain pages have no crypto.subtle
  for (const byte of new TextEncoder().encode(text))
    hash = ((hash ^ BigInt(byte)) * 0x100000001b3n) & 0xffffffffffffffffn;
  return { length: text.length, hash: hash.toString(16) };
}

/** By the element. */
async function plate({ studio, project, attributes = {}, zip = false }) {
  await import(`${studio}embed/sillon-studio.js`);
  const element = document.createElement('sillon-studio');
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  const ready = new Promise((resolve) => element.addEventListener('ready', ({ detail }) => resolve(detail)));
  document.body.append(element);
  const { threads, why } = await inTime(ready, 'ready');
  await element.load(project);
  const { name, blob } = await element.exportGcode();
  const made = { threads, why, name, ...(await digest(await blob.arrayBuffer())) };
  if (!zip) return made;
  const bytes = new Uint8Array(await (await element.exportProject()).blob.arrayBuffer());
  return {
    ...made,
    gcode: await blob.text(),
    zip: btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join('')),
  };
}

/** What a page sees of a frame that the browser does not show. */
async function blocked({ studio, lang = '' }) {
  await import(`${studio}embed/sillon-studio.js`);
  const element = document.createElement('sillon-studio');
  const error = new Promise((resolve) => element.addEventListener('error', ({ detail }) => resolve(detail)));
  if (lang !== '') element.lang = lang;
  document.body.append(element);
  const asked = element.generate().then(
    () => 'done',
    (refused) => refused.code,
  );
  const { code, message } = await inTime(error, 'error');
  const refused = await inTime(asked, 'an answer');
  const link = element.shadowRoot.querySelector('[role=alert]:not([hidden]) a');
  return { code, refused, message, href: link.href, target: link.target };
}

/** A plain frame that has said hello. */
globalThis.frameOf = async ({ studio, sandbox, allow, path = 'embed.html' }) => {
  const frame = document.createElement('iframe');
  if (sandbox !== undefined) frame.setAttribute('sandbox', sandbox);
  if (allow !== undefined) frame.allow = allow;
  frame.src = `${studio}${path}`;
  const origin = sandbox === undefined || sandbox.includes('allow-same-origin') ? new URL(studio).origin : 'null';
  const greeted = new Promise((resolve) => {
    addEventListener('message', (event) => {
      if (event.source === frame.contentWindow && event.origin === origin && event.data.sillon === 'hello') resolve();
    });
  });
  document.body.append(frame);
  await inTime(greeted, 'hello');
  return { frame, origin };
};

/** The protocol without the element. */
globalThis.connect = ({ frame, origin }, connect = {}) => {
  const { port1, port2 } = new MessageChannel();
  const waiters = new Map();
  const messages = [];
  const ready = new Promise((resolve) => {
    port1.onmessage = ({ data }) => {
      messages.push(data);
      if (data.event === 'ready') resolve(data.detail);
      waiters.get(data.id)?.(data);
    };
  });
  frame.contentWindow.postMessage({ sillon: 'connect', v: 1, ...connect }, origin === 'null' ? '*' : origin, [port2]);
  let id = 1000;
  const ask = (method, params = {}) =>
    new Promise((resolve) => {
      waiters.set(++id, resolve);
      port1.postMessage({ v: 1, id, method, params });
    });
  return { port: port1, ready, ask, messages };
};

/** By a plain frame and the protocol alone. */
async function raw({ project, ...asked }) {
  const { ready, ask } = globalThis.connect(await globalThis.frameOf(asked));
  const { threads, why } = await inTime(ready, 'ready');
  for (const method of ['load', 'exportGcode']) {
    const { result, error } = await ask(method, { project });
    if (error !== undefined) throw error;
    if (method === 'exportGcode') return { threads, why, name: result.name, ...(await digest(result.bytes)) };
  }
}

// A browser without remote control names the task in the page's address, and takes the outcome from that of the next page.
if (location.hash !== '') {
  const { task, args, relay } = JSON.parse(decodeURIComponent(location.hash.slice(1)));
  void globalThis.attempt(task, args).then((outcome) => {
    location.replace(`${relay}#${encodeURIComponent(JSON.stringify(outcome))}`);
  });
}
