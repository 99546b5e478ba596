// An interface of one's own over the npm package, whose files come from another site (a CDN): it must send
// Access-Control-Allow-Origin for all of them. With a bundler: import { createEngine } from 'sillon', and assetBase alone.
const cdn = 'https://cdn.example/sillon@0.1.0/';
const { createEngine } = await import(`${cdn}dist/index.js`);

const engine = await createEngine({ assetBase: `${cdn}dist/engine/` });
const slider = document.querySelector('input');
const output = document.querySelector('output');
const image = document.querySelector('img');

let running = new AbortController();

/** Only the newest angle counts: what an older one began is stopped. */
async function make() {
  running.abort();
  running = new AbortController();
  const { signal } = running;
  try {
    const { toolpath, report } = await engine.generateToolpath(
      { shape: { builtin: 'disc', size: [30, 30] }, layers: [{ kind: 'direction', angle: Number(slider.value) }] },
      { spacing: 0.5 },
      { signal, onProgress: ({ fraction }) => (output.value = `${Math.floor(100 * fraction)} %`) },
    );
    const picture = await engine.renderPreview(toolpath, { width: 600 }, { signal });
    URL.revokeObjectURL(image.src);
    image.src = URL.createObjectURL(picture);
    output.value = `${report.points} points, coverage ${report.coverage} %, ${engine.info.threads} threads`;
  } catch (error) {
    if (error.name !== 'AbortError') output.value = `${error.message} ${error.hint ?? ''}`;
  }
}

slider.addEventListener('input', make);
await make();
