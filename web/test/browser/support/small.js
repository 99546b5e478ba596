// A small plate in a link: what is not about the plate that a first visit shows need not wait for that to be made and drawn
// in software, which takes 6 s of CPU time, and this one 3.
import { deflateRawSync } from 'node:zlib';

/** A project's link. @param more  of the link beside its project */
export const projectLink = (project, more = {}) =>
  `#plate=2.${deflateRawSync(JSON.stringify({ project, ...more })).toString('base64url')}`;

/** A studio's address for the small plate. @param changes  of the project in the link @param more  as of projectLink */
export const linkOf = (changes = {}, more = {}) =>
  projectLink(
    {
      sillon: 1,
      shape: { builtin: 'disc', size: [24, 24] },
      layers: [{ kind: 'pattern', pattern: 'waves', amplitude: 40, waveLength: 8.4 }],
      pictures: { spool: 'goldPla' },
      ...changes,
    },
    more,
  );

/** The change that gives the project's plate a name. */
export const named = (name) => ({ studio: { version: 2, name } });
/** The change that gives it another size [mm]. */
export const sized = (side) => ({ shape: { builtin: 'disc', size: [side, side] } });

/** Of an address of the studio, or of its frame. */
export const smallPlate = linkOf();
