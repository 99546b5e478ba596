// Reports what a single opened file has become, and offers its other roles.
import { words } from '../i18n/en/files.js';
import { say } from '../i18n/text.js';
import { hasUnits, isStrip } from '../files/open.js';
import type { Opened, Role } from '../model/file-role.js';
import { groundPictures } from '../model/fills.js';
import { mostPictures } from '../model/lamp.js';
import type { Studio } from '../studio/studio.js';

/** Roles of pictures that could also be shown under a lamp. */
const seen: readonly Role[] = ['lamp', 'levels'];

/** Shows a notice about an opened file: its role, its size, and actions that change the role. */
export async function tellOpened(studio: Studio, { source, role, notes }: Opened): Promise<void> {
  const { opened, plate } = studio.store.state;
  const { width, height } = plate;
  const drawn = role === 'shape' || (role === 'colours' && source.bytes.type === 'image/svg+xml');
  const unsaid = drawn && !(await hasUnits(source));
  const resized = opened !== undefined && (opened.before.width !== width || opened.before.height !== height);
  const strip = resized && isStrip([width, height || width]);
  const size = { width, height };
  const told = [
    say(words, 'files.opened', { name: source.name, role: say(words, `role.${role}`) }),
    ...notes.map((note) => say(words, `files.${note}`)),
    ...(strip ? [say(words, 'files.strip', size)] : unsaid ? [say(words, 'files.sized', size)] : []),
  ];
  const change = {
    label: say(words, 'files.change'),
    run: studio.opens('files'),
  };
  const both = {
    label: say(words, 'files.both'),
    run: () =>
      void studio.attempt(async () => {
        await studio.services.setRole(0, 'more');
        studio.showLamp(groundPictures(studio.store.state.plate).length - 1);
      }),
  };
  const replaced = opened === undefined ? 0 : groundPictures(opened.before).length;
  const pictures = replaced > 0 && seen.includes(role) ? replaced : mostPictures;
  const actions = pictures < mostPictures ? [both, change] : [change];
  studio.tell({
    text: told.join(' '),
    actions,
    ofFiles: true,
  });
}
