// A page's own worker that uses the package.
const ready = import('./page.js');
onmessage = async ({ data }) => {
  await ready;
  postMessage(await globalThis.attempt('plate', data));
};
