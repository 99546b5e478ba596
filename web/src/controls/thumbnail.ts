// Shows a file as a small picture, if the browser can draw it.
import { html, type TemplateResult } from 'lit';
import type { SourceFile } from '../model/plate.js';

const urls = new WeakMap<Blob, string>();

/** Returns the address of a blob; each blob has one, as long as the page lives. */
export function urlOf(bytes: Blob): string {
  const known = urls.get(bytes);
  if (known !== undefined) return known;
  const made = URL.createObjectURL(bytes);
  urls.set(bytes, made);
  return made;
}

/** Returns the picture; empty for SVG files: only drawn.ts may pass those to the browser. */
export const thumbnail = ({ bytes }: SourceFile): TemplateResult =>
  bytes.type === 'image/svg+xml' ? html`<img alt="" />` : html`<img src=${urlOf(bytes)} alt="" />`;
