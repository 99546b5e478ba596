// What this page is, and what its address asks for.
import { addressed } from '../embed/address.js';
import { recallText } from '../files/remember.js';

/** Whether this is the page for frames of others. */
export const framed = document.documentElement.dataset['page'] === 'frame';
export const asked = addressed(location.search);
export const threads = asked.given.threads ?? 'auto';
export const firstVisit =
  !framed && asked.files.length === 0 && location.hash === '' && recallText('welcomed') === undefined;
