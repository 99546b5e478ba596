// Icons of the panel of layers, on the grid of controls/icons.ts.
import type { SVGTemplateResult } from 'lit';
import { icon, lineIcon, type IconName } from '../controls/icons.js';
import { fillOf, type Fill } from '../model/fills.js';
import type { PlateLayer } from '../model/plate.js';

const paths = {
  eye: 'M2.5 10c2-3.5 4.5-5 7.5-5s5.5 1.5 7.5 5c-2 3.5-4.5 5-7.5 5s-5.5-1.5-7.5-5zM10 7.6a2.4 2.4 0 1 0 0 4.8 2.4 2.4 0 0 0 0-4.8',
  hidden:
    'M3 3.5l14 13M8 5.2c.6-.1 1.3-.2 2-.2 3 0 5.5 1.5 7.5 5-.7 1.2-1.5 2.2-2.3 3M13 14.5c-.9.3-1.9.5-3 .5-3 0-5.5-1.5-7.5-5 .8-1.4 1.7-2.5 2.7-3.3',
  up: 'M10 16V4.5M5.5 9 10 4.5 14.5 9',
  down: 'M10 4v11.5M5.5 11l4.5 4.5 4.5-4.5',
  grip: 'M7.5 5v.1M7.5 10v.1M7.5 15v.1M12.5 5v.1M12.5 10v.1M12.5 15v.1',
  crop: 'M6 2.5V14h11.5M2.5 6H14v11.5',
  drawing: 'M4 16l1-4L14 3l3 3-9 9zM12 5l3 3',
  border: 'M3.5 3.5h13v13h-13zM6.5 6.5h7v7h-7z',
} as const;

export type LayerIconName = keyof typeof paths;

export const layerIcon = (name: LayerIconName, size?: number): SVGTemplateResult => lineIcon(paths[name], size);

export const fillIcons: Readonly<Record<Fill, IconName>> = {
  picture: 'lamp',
  brightness: 'tone',
  edges: 'edges',
  levels: 'levels',
  colours: 'colours',
  map: 'map',
  direction: 'angle',
  radial: 'radial',
  spiral: 'spiral',
  waves: 'waves',
  noise: 'noise',
};

/** Icon of a layer in lists. */
export function kindIcon(layer: PlateLayer, size?: number): SVGTemplateResult {
  const fill = fillOf(layer);
  if (fill !== undefined) return icon(fillIcons[fill], size);
  switch (layer.kind) {
    case 'text':
      return icon('text', size);
    case 'code':
      return icon('qr', size);
    case 'strokes':
      return icon('comb', size);
    case 'pattern':
      return icon('edges', size);
    default:
      return layerIcon(layer.kind === 'border' ? 'border' : 'drawing', size);
  }
}
