// Headers that the studio's server sends, and that its page asks for itself where a host sends none.

/** With all four, threads can share memory at top level and in frames of any site. Every response needs them: a page with an
 * embedder policy refuses workers without one. */
export const isolation = {
  'Document-Isolation-Policy': 'isolate-and-credentialless',
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
  'Cross-Origin-Resource-Policy': 'cross-origin',
};

/** Nothing comes from elsewhere, nothing goes elsewhere. Blobs are pictures, videos and files of the visitor's own. */
export const contentSecurityPolicy = [
  "default-src 'self'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "worker-src 'self' blob:",
  "style-src 'self'",
  "img-src 'self' blob: data:",
  "media-src 'self' blob:",
  "connect-src 'self' blob:",
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
