// A file as a small picture, where the browser can draw it.
import { html, type TemplateResult } from 'lit';
import type { SourceFile } from '../model/plate.js';

const urls = new WeakMap<Blob, string>();

/** The same blob has one address, for as long as the page lives. */
export function urlOf(bytes: Blob): string {
  const known = urls.get(bytes);
  if (known !== undefined) return known;
  const made = URL.createObjectURL(bytes);
  urls.set(bytes, made);
  return made;
}

/** Empty for drawings: only drawn.ts hands those to the browser. */
export const thumbnail = ({ bytes }: SourceFile): TemplateResult =>
  bytes.type === 'image/svg+xml' ? html`<img alt="" />` : html`<img src=${urlOf(bytes)} alt="" />`;
