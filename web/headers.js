// Headers that the studio's server sends, and that its page asks for itself where a host sends none.

/** With all four, threads can share memory at top level and in frames of any site. Every response needs them: a page with an
 * embedder policy refuses workers without one. */
export const isolation = {
  'Document-Isolation-Policy': 'isolate-and-credentialless',
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
  'Cross-Origin-Resource-Policy': 'cross-origin',
};

/** Where the engine's files lie if not beside the studio: SILLON_ENGINE, of the build and of our own server. Never of an
 * address that visitors follow: whoever names the engine runs as the studio. */
export const engineBase = checkedBase(process.env.SILLON_ENGINE);

function checkedBase(text) {
  if (text === undefined || text === '') return undefined;
  // As a policy and an attribute hold it: a folder, and no word more.
  if (!/^https?:\/\/[\w.:-]+\/([\w.@~%+-]+\/)*$/.test(text))
    throw new Error(
      `SILLON_ENGINE is "${text}"; it must be the http or https address of a folder, with a slash at its end`,
    );
  return text;
}

const elsewhere = engineBase === undefined ? '' : ` ${engineBase}`;

/** Nothing comes from elsewhere but the engine that the builder named, nothing goes elsewhere. Blobs are pictures and files of the visitor's own. */
export const contentSecurityPolicy = [
  "default-src 'self'",
  `script-src 'self' 'wasm-unsafe-eval'${elsewhere}`,
  "worker-src 'self' blob:",
  "style-src 'self'",
  "img-src 'self' blob: data:",
  `connect-src 'self' blob:${elsewhere}`,
  "object-src 'none'",
  "base-uri 'none'",
  "form-action 'none'",
].join('; ');

/** Of every response of our own server. Other sites' pages may import the elements and the engine: the files are public. */
export const headers = {
  ...isolation,
  'Access-Control-Allow-Origin': '*',
  'Content-Security-Policy': contentSecurityPolicy,
  'X-Content-Type-Options': 'nosniff',
  'Referrer-Policy': 'no-referrer',
};
