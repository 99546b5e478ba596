// A project's list of layers under the studio's names: its directions, and the layers over them.
import type { LampPicture, Project } from 'sillon';

export type ProjectLayer = NonNullable<Project['layers']>[number];

/** The lowest layer where it fills the page, as the core's groundOf: the studio's directions and modes. */
export function groundOf([lowest]: readonly ProjectLayer[]): ProjectLayer | undefined {
  if (lowest === undefined) return undefined;
  const {
    kind,
    visible = true,
    at = null,
    size = [0, 0],
    rotation = 0,
    mirror = false,
    mask = 'own',
    soft = 0,
  } = lowest;
  const fills = kind === 'direction' || kind === 'map' || kind === 'picture';
  const placed = at !== null || size[0] + size[1] > 0 || rotation !== 0 || mirror || mask !== 'own' || soft > 0;
  const cut = (lowest.cropMin ?? lowest.cropMax) !== undefined; // the studio's directions take whole pictures
  return fills && visible && !placed && !cut ? lowest : undefined;
}

/** Files that nobody has completed name no lamp. */
type GivenLayer = Omit<ProjectLayer, 'pictures'> & {
  pictures?: readonly { file: string; lamp?: LampPicture['lamp'] }[];
};

/** A layer over the directions; its files stand for themselves. */
export const studioLayer = ({ pictures = [], ...layer }: GivenLayer) => {
  const [first, ...others] = pictures.map(({ file, lamp = null }) => ({ file, lamp }));
  return {
    ...layer,
    file: (first?.file ?? layer.file) || null,
    lamp: first?.lamp ?? null,
    others,
    maskFile: layer.maskFile || null,
    modeFile: layer.modeFile || null,
  };
};
