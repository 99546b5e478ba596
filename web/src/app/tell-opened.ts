// What a file that was opened alone has become, and what else it can be.
import { words } from '../i18n/en/files.js';
import { say, t } from '../i18n/text.js';
import { hasUnits } from '../files/open.js';
import type { Opened } from '../model/file-role.js';
import type { Studio } from '../studio/studio.js';

export async function tellOpened(studio: Studio, { source, role }: Opened): Promise<void> {
  const { directions, width, height } = studio.store.state.plate;
  const drawn = role === 'shape' || (role === 'colours' && source.bytes.type === 'image/svg+xml');
  const unsaid = drawn && !(await hasUnits(source));
  const told = say(words, 'files.opened', { name: source.name, role: t(`role.${role}`) });
  const change = {
    label: say(words, 'files.change'),
    run: () => {
      studio.show('files');
    },
  };
  const instead = {
    label: say(words, 'files.instead'),
    run: () => {
      void studio.attempt(() => studio.services.setRole(0, 'lamp'));
    },
  };
  const actions = role === 'more' ? [change, instead] : [change];
  studio.tell({
    text: unsaid ? `${told} ${say(words, 'files.sized', { width, height })}` : told,
    actions,
    ofFiles: true,
  });
  if (role === 'more' && directions.kind === 'lamp') studio.showLamp(directions.pictures.length - 1);
}
