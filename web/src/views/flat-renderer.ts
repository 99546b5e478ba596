// Draws the plate on a 2D canvas, for browsers without WebGL2: its beads as lines of a few tones; while the light
// moves, its directions, which are faster.
import type { DirectionRaster, Directions } from '../model/raster.js';
import { slanted } from './fields.js';
import { tonesOf, type Rgb, type Tones } from './lit.js';
import { fillShape } from './outline.js';
import { directionPalette } from './palette.js';
import type { Camera, Renderer, Scene } from './scene.js';
import { strokeBeads } from './strokes-of-beads.js';

type Context = CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D;

const grey: Rgb = [153, 153, 150];
const palette = directionPalette();

/** Returns the colour of a direction. @param turn  angle as a share of half a turn, 0..1 */
function hueOf(turn: number): Rgb {
  const at = 3 * (Math.floor(turn * 256) & 255);
  return [palette[at] as number, palette[at + 1] as number, palette[at + 2] as number];
}

/** Returns the tones of beads in the scene's view. */
function tonesFor(scene: Scene): Tones {
  const { colour, along, across } = scene.filament;
  if (scene.view === 'appearance') return tonesOf({ ...scene, body: colour, slopes: [along, across] });
  const hues = scene.view === 'directions' || (scene.view === 'toolpath' && scene.colourBy === 'direction');
  return { of: (x, y) => (Math.atan2(y, x) / Math.PI + 1) % 1, colour: hues ? hueOf : () => grey };
}

/** Draws a raster as a picture of its own size. */
function picture({ width, height, angle }: DirectionRaster, scene: Scene): OffscreenCanvas {
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d');
  if (context === null) throw new Error('this browser has no canvas to draw plates on');
  const image = context.createImageData(width, height);
  const [wide, tall] = scene.page;
  const { of, colour } = tonesFor(scene);
  const colours = Array.from({ length: 256 }, (_, k) => colour((k + 0.5) / 256));
  for (let row = 0, k = 0; row < height; ++row) {
    const y = tall * (1 - (row + 0.5) / height);
    for (let column = 0; column < width; ++column, ++k) {
      const turn = ((angle[k] as number) / 65535 - 0.5) * Math.PI;
      const seen = of(Math.cos(turn), Math.sin(turn), ((column + 0.5) * wide) / width, y);
      image.data.set(colours[Math.max(0, Math.min(255, Math.floor(256 * seen)))] as Rgb, 4 * k);
      image.data[4 * k + 3] = 255;
    }
  }
  context.putImageData(image, 0, 0);
  return canvas;
}

/** Draws directions; those of the previous plate are stretched to the page of the coming one. */
function drawDirections(context: Context, { raster, shape }: Directions, scene: Scene, plain: boolean): void {
  const one = picture(plain ? slanted : raster, scene);
  const [wide, tall] = shape.page;
  const pattern = context.createPattern(one, 'repeat');
  pattern?.setTransform(new DOMMatrix([wide / one.width, 0, 0, -tall / one.height, 0, tall]));
  context.save();
  context.scale(scene.page[0] / wide, scene.page[1] / tall);
  context.fillStyle = pattern ?? 'grey';
  if (scene.view === 'directions') context.fillRect(0, 0, wide, tall);
  else fillShape(context, shape);
  context.restore();
}

/** Draws the plate, or the plain zigzag compared with it; the zigzag is drawn as directions only. */
function drawPart(context: Context, scene: Scene, scale: number, plain: boolean): void {
  const { directions, toolpath } = scene;
  const quick = scene.quick === true || plain || toolpath === undefined || scene.view === 'directions';
  if (quick && directions !== undefined) drawDirections(context, directions, scene, plain);
  else if (toolpath !== undefined && !plain) strokeBeads(context, toolpath, scale, tonesFor(scene));
}

/** Draws the plate and, beside or over it, the zigzag that it is compared with. */
function drawScene(context: Context, scene: Scene, camera: Camera): void {
  const { width, height } = context.canvas;
  const { compare, wipe, page } = scene;
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, width, height);
  const [left, bottom] = [width / 2 - camera.x * camera.scale, height / 2 + camera.y * camera.scale];
  const edge = wipe === undefined ? 0 : left + wipe * page[0] * camera.scale;
  for (let k = 0; k < (compare || wipe !== undefined ? 2 : 1); ++k) {
    context.save();
    if (wipe !== undefined) {
      context.beginPath();
      context.rect(k === 0 ? edge : 0, 0, k === 0 ? width - edge : edge, height);
      context.clip();
    }
    const offset = compare ? k * page[0] * 1.08 * camera.scale : 0;
    context.setTransform(camera.scale, 0, 0, -camera.scale, left + offset, bottom);
    drawPart(context, scene, camera.scale, k === 1);
    context.restore();
  }
}

/** Creates a renderer on a canvas. @throws Error if the canvas already has another context */
export function createFlatRenderer(canvas: HTMLCanvasElement): Renderer {
  const context = canvas.getContext('2d');
  if (context === null) throw new Error('this browser has no canvas to draw plates on');
  return {
    stepwise: true,
    draw(scene, camera) {
      drawScene(context, scene, camera);
    },
    finished: () => Promise.resolve(),
    resize(width, height) {
      canvas.width = width;
      canvas.height = height;
    },
    async capture(scene, width) {
      const scale = width / (scene.page[0] * ((scene.compare ? 2.08 : 1) + 0.1));
      const on = new OffscreenCanvas(width, Math.round(scale * scene.page[1] * 1.1)).getContext('2d');
      if (on === null) throw new Error('the picture could not be made');
      const x = (scene.page[0] * (scene.compare ? 2.08 : 1)) / 2;
      drawScene(on, scene, { x, y: scene.page[1] / 2, scale });
      return on.canvas.convertToBlob({ type: 'image/png' });
    },
    dispose() {
      canvas.width = 0;
    },
  };
}
