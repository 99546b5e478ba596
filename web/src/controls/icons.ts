// Line icons on a grid of 20, drawn with the colour of the text around them.
import { svg, type SVGTemplateResult } from 'lit';

const paths = {
  undo: 'M7 4 3.5 7.5 7 11M4 7.5h7.5a4.5 4.5 0 0 1 0 9H8',
  redo: 'M13 4l3.5 3.5L13 11M16 7.5H8.5a4.5 4.5 0 0 0 0 9H12',
  open: 'M3 15.5V5a1 1 0 0 1 1-1h3.5l2 2H16a1 1 0 0 1 1 1v1.5M3 15.5h12.5L17.5 9h-12z',
  gallery: 'M3.5 3.5h5.5v5.5H3.5zM11 3.5h5.5v5.5H11zM3.5 11h5.5v5.5H3.5zM11 11h5.5v5.5H11z',
  share:
    'M8.2 11.8a3.2 3.2 0 0 0 4.6 0l2.8-2.8a3.2 3.2 0 0 0-4.6-4.6l-1 1M11.8 8.2a3.2 3.2 0 0 0-4.6 0L4.4 11a3.2 3.2 0 0 0 4.6 4.6l1-1',
  download: 'M10 3v9.5M6 9l4 4 4-4M3.5 16.5h13',
  help: 'M7.3 7.5a2.7 2.7 0 1 1 4 2.4c-.9.5-1.3 1-1.3 2M10 14.6v.1',
  sun: 'M10 6.5a3.5 3.5 0 1 0 0 7 3.5 3.5 0 0 0 0-7M10 2v1.5M10 16.5V18M2 10h1.5M16.5 10H18M4.3 4.3l1.1 1.1M14.6 14.6l1.1 1.1M15.7 4.3l-1.1 1.1M5.4 14.6l-1.1 1.1',
  moon: 'M16.5 11.5A6.8 6.8 0 0 1 8.5 3.5a6.8 6.8 0 1 0 8 8z',
  half: 'M10 3.5a6.5 6.5 0 1 0 0 13zM10 3.5a6.5 6.5 0 0 1 0 13',
  menu: 'M3.5 5.5h13M3.5 10h13M3.5 14.5h13',
  more: 'M4 10h1M9.5 10h1M15 10h1',
  close: 'M5 5l10 10M15 5 5 15',
  hand: 'M6.5 10.5V5.2a1.1 1.1 0 0 1 2.2 0V9V3.9a1.1 1.1 0 0 1 2.2 0V9V4.8a1.1 1.1 0 0 1 2.2 0V10V7a1.1 1.1 0 0 1 2.2 0v5.5a5 5 0 0 1-5 5c-2.4 0-3.5-1-4.6-3L3.7 11a1.1 1.1 0 0 1 1.9-1.1z',
  comb: 'M3.5 5.5h13M5 5.5v10M8.3 5.5v8M11.7 5.5v10M15 5.5v8',
  mode: 'M15.5 3.5 9 10M7.8 10.7a2.6 2.6 0 0 0-2.6 2.6c0 1.6-.8 2.5-1.7 3 2.7.7 6.6.2 6.9-2.8a2.6 2.6 0 0 0-2.6-2.8z',
  erase:
    'M8 16.5h8.5M3.7 12.2l7.3-7.3a1.4 1.4 0 0 1 2 0l2.6 2.6a1.4 1.4 0 0 1 0 2l-7 7H6.8l-3.1-3.1a.9.9 0 0 1 0-1.2zM7.5 8.5l4.6 4.6',
  play: 'M6.5 4.2v11.6l9-5.8z',
  pause: 'M7 4.5v11M13 4.5v11',
  camera: 'M3.5 6.5h3L8 4.5h4l1.5 2h3v9h-13zM10 8.3a2.6 2.6 0 1 0 0 5.2 2.6 2.6 0 0 0 0-5.2',
  video: 'M3 6h9.5v8H3zM12.5 9l4.5-2.5v7L12.5 11',
  stop: 'M6 6h8v8H6z',
  compare: 'M10 3v14M3.5 5h4v10h-4M16.5 5h-4v10h4',
  fit: 'M3.5 7V3.5H7M13 3.5h3.5V7M16.5 13v3.5H13M7 16.5H3.5V13',
  plus: 'M10 4v12M4 10h12',
  minus: 'M4 10h12',
  lock: 'M5.5 9h9v7h-9zM7.3 9V6.5a2.7 2.7 0 0 1 5.4 0V9',
  unlock: 'M5.5 9h9v7h-9zM7.3 9V6.5a2.7 2.7 0 0 1 5.2-1',
  turn: 'M15.5 10a5.5 5.5 0 1 1-2-4.2M13.8 2.8v3.2h-3.2',
  mirror: 'M10 3v14M7.5 6 3 14h4.5zM12.5 6l4.5 8h-4.5z',
  info: 'M10 9v4.5M10 6.4v.1M10 2.8a7.2 7.2 0 1 0 0 14.4 7.2 7.2 0 0 0 0-14.4',
  shape: 'M10 3.2 16.5 8l-2.5 8H6L3.5 8z',
  directions: 'M3 14.5c3.5 0 3.5-3 7-3s3.5-3 7-3M3 10c3.5 0 3.5-3 7-3s3.5-3 7-3M8 17.5c1 0 1.5-1.5 4.5-1.5',
  layers: 'M10 3.5 17 7l-7 3.5L3 7zM3 10.2l7 3.5 7-3.5M3 13.4l7 3.5 7-3.5',
  toolpath: 'M4 4.5h10a2 2 0 0 1 0 4H6.5a2 2 0 0 0 0 4H14a1.9 1.9 0 0 1 0 3.8H4',
  print: 'M3.5 16.5h13M5.5 13.5h9M10 12.5 8 9V4h4v5z',
  quality: 'M8.5 3.5a5 5 0 1 0 0 10 5 5 0 0 0 0-10M12.2 12.2l4.3 4.3M6.3 8.5l1.6 1.6 2.9-3.1',
  light: 'M10 7a3 3 0 1 0 0 6 3 3 0 0 0 0-6M10 2.5v1.8M10 15.7v1.8M2.5 10h1.8M15.7 10h1.8',
  warn: 'M10 3.5 17.5 16h-15zM10 8.5v3.5M10 14v.1',
  check: 'M4 10.5l4 4 8-9',
  previous: 'M12 5l-5 5 5 5',
  next: 'M8 5l5 5-5 5',
  fold: 'M5 8l5 5 5-5',
  body: 'M10 3.5 17 7v5.5L10 16l-7-3.5V7zM3 7l7 3.5L17 7M10 10.5V16',
  file: 'M5.5 3h6l3.5 3.5V17h-9.5zM11.5 3v3.5H15',
  copy: 'M7 7h9.5v9.5H7zM13 7V3.5H3.5V13H7',
  bin: 'M4 6h12M8 6V3.8h4V6M5.5 6l.8 10.5h7.4L14.5 6M8.5 9v4.5M11.5 9v4.5',
  tune: 'M4 6h7M15 6h1M13 4v4M4 14h1M9 14h7M7 12v4M4 10h4M12 10h4M10 8v4',
  shuffle:
    'M3 6h2.5c4 0 5 8 9 8H17M15 12l2 2-2 2M3 14h2.5c1.2 0 2.1-.7 2.8-1.7M11.2 7.7C12 6.7 13 6 14.5 6H17M15 4l2 2-2 2',
  // Icons of directions are drawn as small plates.
  lamp: 'M7 11.8a4.6 4.6 0 1 1 6 0c-.7.6-.9 1.2-.9 2.2H7.9c0-1-.2-1.6-.9-2.2zM8.2 16.8h3.6',
  angle: 'M4 13 13 4M4 16.5 16.5 4M7.5 16.5l9-9',
  tone: 'M3.5 3.5h13v13h-13zM3.5 16.5 16.5 3.5M3.5 12.5l9-9M3.5 8.5l5-5M7 16.5h9.5M11 13h5.5',
  edges: 'M4 15c2-8 10-8 12 0M6.8 16c1.4-5 5-5 6.4 0M3 11.5C6 2.5 14 2.5 17 11.5',
  levels: 'M3.5 3.5h13v13h-13zM10 3.5v13M3.5 7.7H10M3.5 12H10M13.2 3.5v13',
  colours:
    'M10 3a7 7 0 1 0 0 14c1.3 0 1.6-1 1.1-1.9-.6-1.2.1-2.3 1.4-2.3H14a3 3 0 0 0 3-3C17 6 13.9 3 10 3M6.6 9.6v.1M8.8 6.6v.1M12.4 6.8v.1',
  map: 'M3.5 5.5l4.3-2 4.4 2 4.3-2v11l-4.3 2-4.4-2-4.3 2zM7.8 3.5v11M12.2 5.5v11',
  text: 'M4.5 6V4h11v2M10 4v12M7.5 16h5',
  qr: 'M3.5 3.5h5v5h-5zM11.5 3.5h5v5h-5zM3.5 11.5h5v5h-5zM11.5 11.5h2v2h-2zM16.5 11.5v2M11.5 16.5h2M16.5 16.5h-1',
  radial: 'M10 3v4.5M10 12.5V17M3 10h4.5M12.5 10H17M5 5l3.2 3.2M11.8 11.8 15 15M15 5l-3.2 3.2M8.2 11.8 5 15',
  spiral:
    'M10 10a1.2 1.2 0 0 1 2.3.5c0 1.7-1.5 2.7-3 2.5-2-.3-3.1-2-2.8-4 .4-2.5 2.7-3.9 5-3.5 3 .5 4.7 3.2 4.2 6.1-.6 3.3-3.7 5.3-7 4.7',
  waves:
    'M3 7c3.5-3.5 3.5 3.5 7 0s3.5 3.5 7 0M3 11.5c3.5-3.5 3.5 3.5 7 0s3.5 3.5 7 0M3 16c3.5-3.5 3.5 3.5 7 0s3.5 3.5 7 0',
  noise: 'M3 6c3-2 4 2 7 1s3-4 7-2M3 10.5c2 2 4-2 6.5-.5S13 13 17 9.5M3 15c3-2.5 4 1.5 7 .5s4-2.5 7-1',
  rectangle: 'M3.5 5.5h13v9h-13z',
  rounded: 'M6.5 5h7a3 3 0 0 1 3 3v4a3 3 0 0 1-3 3h-7a3 3 0 0 1-3-3V8a3 3 0 0 1 3-3z',
  hexagon: 'M6.5 4h7l3.5 6-3.5 6h-7L3 10z',
  heart: 'M10 16.5 4 10.4a3.7 3.7 0 0 1 6-4.2 3.7 3.7 0 0 1 6 4.2z',
  shield: 'M4 4h12v4.5c0 3.7-2.6 6.4-6 8-3.4-1.6-6-4.3-6-8z',
  star: 'M10 3l2 4.9 5.2.4-4 3.4 1.3 5.1L10 14l-4.5 2.8 1.3-5.1-4-3.4L8 7.9z',
  ring: 'M10 3.5a6.5 6.5 0 1 0 0 13 6.5 6.5 0 0 0 0-13zM10 7a3 3 0 1 0 0 6 3 3 0 0 0 0-6z',
  tag: 'M7.5 6H17v8H7.5a4 4 0 0 1 0-8zM7 8.7a1.3 1.3 0 1 0 0 2.6 1.3 1.3 0 0 0 0-2.6z',
  disc: 'M10 3.5a6.5 6.5 0 1 0 0 13 6.5 6.5 0 0 0 0-13z',
} as const;

export type IconName = keyof typeof paths;

/** Returns an icon. @param path  outline on that grid */
export const lineIcon = (path: string, size = 18): SVGTemplateResult => svg`
  <svg class="icon" viewBox="0 0 20 20" width=${size} height=${size} fill="none" stroke="currentColor"
    stroke-width="1.4" stroke-linecap="round" stroke-linejoin="round" aria-hidden="true" focusable="false">
    <path d=${path} />
  </svg>`;

export const icon = (name: IconName, size?: number): SVGTemplateResult => lineIcon(paths[name], size);

/** Returns the logo: furrows on a disc. */
export const mark = (): SVGTemplateResult => svg`
  <svg class="mark" viewBox="0 0 24 24" width="24" height="24" aria-hidden="true" focusable="false" fill="none"
    stroke="currentColor" stroke-width="1.5" stroke-linecap="round">
    <path d="M6.3 5.2c2.6-1.6 4.4-1 6.7.4 1.6 1 3.1 1.2 4.8.6M3.7 9.2C7.6 6.5 10 7.5 13 9.3c2.6 1.5 4.8 1.5 7.4-.1
      M3 13.4c4.3-3.2 6.9-2.1 10 -.3 2.7 1.6 5.2 1.5 8-.4M4.3 17.3c3.6-2.5 6-1.5 8.7.1 2.3 1.3 4.2 1.3 6.5.2
      M8 20.4c2-.6 3.4-.1 5 .7" />
  </svg>`;
