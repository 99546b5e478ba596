// Draws the plate with WebGL2: beads as capsules, their look by an anisotropic microfacet lobe (Beckmann).
import type { PrinterValues, Toolpath } from 'sillon';
import type { DirectionRaster } from '../model/raster.js';
import { mostDelay, type ColourBy } from '../model/view.js';
import type { Delayed } from './delays.js';
import { setLook } from './look.js';
import { directionPalette } from './palette.js';
import { compile, type Program } from './program.js';
import type { Camera, Renderer, Scene } from './scene.js';
import { beadFragment, beadVertex, fieldFragment, fieldVertex } from './shaders.js';
import { pointsToDraw } from './thinned.js';

/** Floats per point, which is a texel: x, y, width, share of the print. Segments read their neighbours' points too. */
const stride = 4;

/** Texels of a row of points; every WebGL2 has this many. */
const columns = 2048;

/** Segments that follow each other, and the box around them [mm]; what is off the screen is not drawn. */
interface Run {
  first: number;
  segments: number;
  box: [number, number, number, number];
}

interface Beads {
  tolerance: number;
  points: WebGLTexture;
  /** Delays of the neighbours of the same points; one texel where nobody asked. */
  delays: WebGLTexture;
  runs: Run[];
  spacing: number;
}

const segmentsPerRun = 4096;

/** Two triangles per segment, of four corners: shared corners are computed once. */
const cornersOfRun = Uint16Array.from(
  { length: 6 * segmentsPerRun },
  (_, k) => 4 * Math.floor(k / 6) + ([0, 1, 2, 1, 2, 3][k % 6] ?? 0),
);

const colourModes: Record<ColourBy, number> = { direction: 0, width: 1, speed: 2, order: 3, delay: 4 };

/** Values that shaders read one by one. @param kind  internal format, format and type */
function dataTexture(
  gl: WebGL2RenderingContext,
  [width, height]: readonly [number, number],
  [internalFormat, format, type]: readonly [GLenum, GLenum, GLenum],
  texels: Uint8Array | Uint16Array | Float32Array,
): WebGLTexture {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  gl.texImage2D(gl.TEXTURE_2D, 0, internalFormat, width, height, 0, format, type, texels);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return texture;
}

/** How far the screen's beads may lie from the toolpath's, for fewer of them [pixels]. */
const unseen = 0.05;

function upload(gl: WebGL2RenderingContext, toolpath: Toolpath, tolerance: number, delays?: Float32Array[]): Beads {
  const drawn = toolpath.cycles.map(({ points, widths }) => pointsToDraw(points, widths, tolerance));
  const total = drawn.reduce((sum, { length }) => sum + length + 3, 0);
  const rows = Math.ceil(total / columns);
  const data = new Float32Array(rows * columns * stride);
  const late = new Float32Array(delays === undefined ? 1 : rows * columns);
  const all = toolpath.cycles.reduce((sum, { widths }) => sum + widths.length, 0);
  const runs: Run[] = [];
  let at = 0;
  let done = 0;
  toolpath.cycles.forEach(({ points, widths }, cycle) => {
    const kept = drawn[cycle] ?? new Uint32Array();
    const count = kept.length;
    const start = at;
    // One point before the first, and two after the last: every segment has neighbours.
    for (let k = -1; k < count + 2; ++k, ++at) {
      const from = kept[(k + count) % count] ?? 0;
      data[at * stride] = points[2 * from] ?? 0;
      data[at * stride + 1] = points[2 * from + 1] ?? 0;
      data[at * stride + 2] = widths[from] ?? 0;
      data[at * stride + 3] = (done + (k < count ? from : widths.length)) / all;
      if (delays !== undefined) late[at] = (delays[cycle]?.[from] ?? 0) / mostDelay;
    }
    data[start * stride + 3] = done / all;
    for (let first = start; first < start + count; first += segmentsPerRun) {
      const segments = Math.min(segmentsPerRun, start + count - first);
      runs.push({ first, segments, box: boxOf(data, first + 1, segments + 1) });
    }
    done += widths.length;
  });
  const points = dataTexture(gl, [columns, rows], [gl.RGBA32F, gl.RGBA, gl.FLOAT], data);
  const size = delays === undefined ? ([1, 1] as const) : ([columns, rows] as const);
  const lateness = dataTexture(gl, size, [gl.R32F, gl.RED, gl.FLOAT], late);
  return { tolerance, points, delays: lateness, runs, spacing: toolpath.spacing };
}

/** @param data  of points as they are uploaded */
function boxOf(data: Float32Array, first: number, count: number): Run['box'] {
  const box: Run['box'] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let at = first * stride; at < (first + count) * stride; at += stride) {
    const [x, y, radius] = [data[at] ?? 0, data[at + 1] ?? 0, (data[at + 2] ?? 0) / 2];
    box[0] = Math.min(box[0], x - radius);
    box[1] = Math.min(box[1], y - radius);
    box[2] = Math.max(box[2], x + radius);
    box[3] = Math.max(box[3], y + radius);
  }
  return box;
}

const comparing = ({ compare, wipe }: Scene): boolean => compare || wipe !== undefined;

/** @param lazy  fetches a part when it is first asked for; without it nothing is compared, and no delays are shown
 * @throws Error where there is no WebGL2. */
export function createRenderer(canvas: HTMLCanvasElement, lazy?: (load: () => Promise<void>) => unknown): Renderer {
  const context = canvas.getContext('webgl2', { antialias: false, alpha: true, preserveDrawingBuffer: false });
  if (context === null) throw new Error('this browser has no WebGL2');
  const gl = context;
  let beadProgram: Program;
  let fieldProgram: Program;
  let palette: WebGLTexture;
  let fieldTextures: { angle: WebGLTexture; mode: WebGLTexture; of: DirectionRaster } | undefined;
  const uploaded = new Map<Toolpath, Beads>();
  const zigzags = new WeakMap<Toolpath, Toolpath>();
  const delayed = new WeakMap<Toolpath, { by: Delayed; speed: number }>();
  let last: { scene: Scene; camera: Camera } | undefined;

  function prepare(): void {
    beadProgram = compile(gl, beadVertex, beadFragment);
    fieldProgram = compile(gl, fieldVertex, fieldFragment);
    palette = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, palette);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, 256, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, directionPalette());
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.REPEAT);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, cornersOfRun, gl.STATIC_DRAW);
    uploaded.clear();
    fieldTextures = undefined;
  }
  prepare();

  const onLost = (event: Event): void => {
    event.preventDefault();
  };
  const onRestored = (): void => {
    prepare();
    redraw();
  };
  canvas.addEventListener('webglcontextlost', onLost);
  canvas.addEventListener('webglcontextrestored', onRestored);

  /** Keeps what the scene shows, frees the rest. */
  function beadsOf(wanted: Toolpath[], tolerance: number, late?: Delayed): Beads[] {
    for (const [toolpath, beads] of uploaded) {
      if (wanted.includes(toolpath) && beads.tolerance === tolerance) continue;
      gl.deleteTexture(beads.points);
      gl.deleteTexture(beads.delays);
      uploaded.delete(toolpath);
    }
    return wanted.map((toolpath) => {
      const beads =
        uploaded.get(toolpath) ??
        upload(gl, toolpath, tolerance, late?.toolpath === toolpath ? late.delays : undefined);
      uploaded.set(toolpath, beads);
      return beads;
    });
  }

  /** What makes zigzags, once somebody compares with one. */
  let zigzag: (typeof import('./zigzag.js'))['zigzag'] | undefined;
  async function loadZigzag(): Promise<void> {
    ({ zigzag } = await import('./zigzag.js'));
    redraw();
  }

  let delays: typeof import('./delays.js') | undefined;
  async function loadDelays(): Promise<void> {
    delays = await import('./delays.js');
    redraw();
  }

  function delayedOf(toolpath: Toolpath, printer: PrinterValues): Delayed | undefined {
    if (delays === undefined) return undefined;
    const known = delayed.get(toolpath);
    const speed = delays.shownSpeed(printer);
    if (known?.speed === speed) return known.by;
    const by = delays.delaysOf(toolpath, speed);
    delayed.set(toolpath, { by, speed });
    return by;
  }

  function zigzagOf(toolpath: Toolpath): Toolpath | undefined {
    const made = zigzags.get(toolpath) ?? zigzag?.(toolpath.shape, toolpath.spacing);
    if (made === undefined) return undefined;
    zigzags.set(toolpath, made);
    return made;
  }

  function drawBeads(beads: Beads, scene: Scene, camera: Camera, offset: number): void {
    gl.useProgram(beadProgram.program);
    const { at } = beadProgram;
    gl.uniform4f(at('camera'), camera.x - offset, camera.y, camera.scale, 1);
    gl.uniform2f(at('screen'), gl.drawingBufferWidth, gl.drawingBufferHeight);
    const { colour: body, along, across } = scene.filament;
    setLook(gl, beadProgram, { ...scene, body, slopes: [along, across] });
    const { printer, layerHeight } = scene.feed;
    gl.uniform3f(at('feed'), printer.speed, printer.maxFlow, layerHeight);
    gl.uniform1f(at('progress'), scene.progress);
    gl.uniform1f(at('blended'), scene.blended === true ? 1 : 0);
    gl.uniform1f(at('spacing'), beads.spacing);
    gl.uniform1i(at('view'), scene.view === 'appearance' ? 0 : scene.view === 'quality' ? 2 : 1);
    gl.uniform1i(at('colourBy'), colourModes[scene.colourBy]);
    gl.uniform1i(at('palette'), 0);
    gl.uniform1i(at('points'), 1);
    gl.uniform1i(at('delays'), 2);
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D, beads.delays);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, beads.points);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, palette);
    const [acrossHalf, tallHalf] = [
      gl.drawingBufferWidth / camera.scale / 2,
      gl.drawingBufferHeight / camera.scale / 2,
    ];
    const x = camera.x - offset;
    for (const { first, segments, box } of beads.runs) {
      if (box[0] > x + acrossHalf || box[2] < x - acrossHalf) continue;
      if (box[1] > camera.y + tallHalf || box[3] < camera.y - tallHalf) continue;
      gl.uniform1i(at('first'), first);
      gl.drawElements(gl.TRIANGLES, 6 * segments, gl.UNSIGNED_SHORT, 0);
    }
  }

  function drawField(raster: DirectionRaster, scene: Scene, camera: Camera): void {
    if (fieldTextures?.of !== raster) {
      if (fieldTextures !== undefined) {
        gl.deleteTexture(fieldTextures.angle);
        gl.deleteTexture(fieldTextures.mode);
      }
      const size = [raster.width, raster.height] as const;
      const angle = dataTexture(gl, size, [gl.R16UI, gl.RED_INTEGER, gl.UNSIGNED_SHORT], raster.angle);
      const mode = dataTexture(gl, size, [gl.R8UI, gl.RED_INTEGER, gl.UNSIGNED_BYTE], raster.mode);
      fieldTextures = { angle, mode, of: raster };
    }
    gl.useProgram(fieldProgram.program);
    const { at } = fieldProgram;
    gl.uniform4f(at('camera'), camera.x, camera.y, camera.scale, 1);
    gl.uniform2f(at('screen'), gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.uniform2f(at('page'), ...scene.page);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, fieldTextures.angle);
    gl.uniform1i(at('angles'), 1);
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D, fieldTextures.mode);
    gl.uniform1i(at('modes'), 2);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, palette);
    gl.uniform1i(at('palette'), 0);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }

  function draw(scene: Scene, camera: Camera): void {
    last = { scene, camera };
    if (gl.isContextLost()) return;
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    if (scene.view === 'directions') {
      if (scene.directions !== undefined) drawField(scene.directions, scene, camera);
      return;
    }
    if (scene.toolpath === undefined) return;
    const { compare, wipe, page } = scene;
    const other = comparing(scene) ? zigzagOf(scene.toolpath) : undefined;
    if (comparing(scene) && other === undefined) lazy?.(loadZigzag);
    // By powers of two, not to begin anew with every step of a zoom; what is played grows point by point.
    const byDelay = scene.view === 'toolpath' && scene.colourBy === 'delay';
    const late = byDelay ? delayedOf(scene.toolpath, scene.feed.printer) : undefined;
    if (byDelay && late === undefined) lazy?.(loadDelays);
    const tolerance = scene.progress < 1 || late !== undefined ? 0 : 2 ** Math.floor(Math.log2(unseen / camera.scale));
    const shown = late?.toolpath ?? scene.toolpath;
    const beads = beadsOf(other === undefined ? [shown] : [shown, other], tolerance, late);
    const { drawingBufferWidth: columns, drawingBufferHeight: rows } = gl;
    const edge = wipe === undefined ? 0 : Math.round(columns / 2 + (wipe * page[0] - camera.x) * camera.scale);
    beads.forEach((one, k) => {
      if (wipe !== undefined) {
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(k === 0 ? edge : 0, 0, Math.max(0, k === 0 ? columns - edge : edge), rows);
      }
      drawBeads(one, scene, camera, compare ? k * page[0] * 1.08 : 0);
    });
    gl.disable(gl.SCISSOR_TEST);
  }

  function redraw(): void {
    if (last !== undefined) draw(last.scene, last.camera);
  }

  return {
    draw,
    async finished() {
      const sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
      if (sync === null) return;
      gl.flush();
      while (gl.clientWaitSync(sync, 0, 0) === gl.TIMEOUT_EXPIRED) await new Promise((resolve) => setTimeout(resolve));
      gl.deleteSync(sync);
    },
    resize(width, height) {
      canvas.width = width;
      canvas.height = height;
      redraw();
    },
    async capture(scene, width) {
      if (comparing(scene)) await loadZigzag();
      const shown = scene.compare ? 2.08 : 1;
      const scale = width / (scene.page[0] * (shown + 0.1));
      const before = { width: canvas.width, height: canvas.height, last };
      canvas.width = width;
      canvas.height = Math.round(scale * scene.page[1] * 1.1);
      draw(scene, { x: (scene.page[0] * shown) / 2, y: scene.page[1] / 2, scale });
      const blob = await new Promise<Blob | null>((resolve) => {
        canvas.toBlob(resolve, 'image/png');
      });
      ({ last } = before);
      this.resize(before.width, before.height);
      if (blob === null) throw new Error('the picture could not be made');
      return blob;
    },
    dispose() {
      canvas.removeEventListener('webglcontextlost', onLost);
      canvas.removeEventListener('webglcontextrestored', onRestored);
      for (const beads of uploaded.values()) {
        gl.deleteTexture(beads.points);
        gl.deleteTexture(beads.delays);
      }
      gl.getExtension('WEBGL_lose_context')?.loseContext();
    },
  };
}
