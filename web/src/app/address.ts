// The kind of this page, and the settings in its address.
import { addressed } from '../embed/address.js';
import { recallText } from '../files/remember.js';

/** This page is the one for frames in other pages. */
export const framed = document.documentElement.dataset['page'] === 'frame';
export const asked = addressed(location.search);
export const threads = asked.given.threads ?? 'auto';
export const firstVisit =
  !framed && asked.files.length === 0 && location.hash === '' && recallText('welcomed') === undefined;
