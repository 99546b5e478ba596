// A small plate in a link: what is not about the plate that a first visit shows need not wait for that to be made and drawn
// in software, which takes 6 s of CPU time, and this one 3.
import { deflateRawSync } from 'node:zlib';

/** A studio's address for the small plate. @param changes  of the plate in the link */
export const linkOf = (changes = {}) => {
  const plate = {
    name: '',
    shape: { kind: 'disc' },
    width: 24,
    height: 24,
    directions: { kind: 'waves', angle: 0, amplitude: 40, length: 0.35 },
    mode: 'constrained',
    settings: { 'pictures.spool': 'goldPla' },
    ...changes,
  };
  return `#plate=1.${deflateRawSync(JSON.stringify(plate)).toString('base64url')}`;
};

/** Of an address of the studio, or of its frame. */
export const smallPlate = linkOf();
