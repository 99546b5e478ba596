// Draws the plate with WebGL2: beads as capsules, their look by an anisotropic microfacet lobe (Beckmann).
import type { Toolpath } from 'sillon';
import type { DirectionRaster } from '../model/raster.js';
import type { ColourBy } from '../model/view.js';
import { setLook } from './look.js';
import { directionPalette } from './palette.js';
import { compile, type Program } from './program.js';
import type { Camera, Renderer, Scene } from './scene.js';
import { beadFragment, beadVertex, fieldFragment, fieldVertex } from './shaders.js';
import { zigzag } from './zigzag.js';

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
  points: WebGLTexture;
  runs: Run[];
  spacing: number;
}

const segmentsPerRun = 4096;

const colourModes: Record<ColourBy, number> = { direction: 0, width: 1, speed: 2, order: 3 };

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

function upload(gl: WebGL2RenderingContext, toolpath: Toolpath): Beads {
  const counts = toolpath.cycles.map((cycle) => cycle.widths.length);
  const total = counts.reduce((sum, count) => sum + count + 3, 0);
  const rows = Math.ceil(total / columns);
  const data = new Float32Array(rows * columns * stride);
  const all = counts.reduce((sum, count) => sum + count, 0);
  const runs: Run[] = [];
  let at = 0;
  let done = 0;
  for (const cycle of toolpath.cycles) {
    const { widths } = cycle;
    const count = widths.length;
    for (let from = 0; from < count; from += segmentsPerRun) {
      const segments = Math.min(segmentsPerRun, count - from);
      runs.push({ first: at + from, segments, box: boxOf(cycle.points, widths, from, segments) });
    }
    // One point before the first, and two after the last: every segment has neighbours.
    for (let k = -1; k < count + 2; ++k, ++at) {
      const from = (k + count) % count;
      data[at * stride] = cycle.points[2 * from] ?? 0;
      data[at * stride + 1] = cycle.points[2 * from + 1] ?? 0;
      data[at * stride + 2] = widths[from] ?? 0;
      data[at * stride + 3] = (done + Math.max(0, k)) / all;
    }
    done += count;
  }
  const points = dataTexture(gl, [columns, rows], [gl.RGBA32F, gl.RGBA, gl.FLOAT], data);
  return { points, runs, spacing: toolpath.spacing };
}

function boxOf(points: Float32Array, widths: Float32Array, first: number, segments: number): Run['box'] {
  const box: Run['box'] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let k = first; k <= first + segments; ++k) {
    const at = k % widths.length;
    const [x, y, radius] = [points[2 * at] ?? 0, points[2 * at + 1] ?? 0, (widths[at] ?? 0) / 2];
    box[0] = Math.min(box[0], x - radius);
    box[1] = Math.min(box[1], y - radius);
    box[2] = Math.max(box[2], x + radius);
    box[3] = Math.max(box[3], y + radius);
  }
  return box;
}

/** @throws Error where there is no WebGL2. */
export function createRenderer(canvas: HTMLCanvasElement): Renderer {
  const context = canvas.getContext('webgl2', { antialias: false, alpha: true, preserveDrawingBuffer: false });
  if (context === null) throw new Error('this browser has no WebGL2');
  const gl = context;
  let beadProgram: Program;
  let fieldProgram: Program;
  let palette: WebGLTexture;
  let fieldTextures: { angle: WebGLTexture; mode: WebGLTexture; of: DirectionRaster } | undefined;
  const uploaded = new Map<Toolpath, Beads>();
  const zigzags = new WeakMap<Toolpath, Toolpath>();
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
    uploaded.clear();
    fieldTextures = undefined;
  }
  prepare();

  const onLost = (event: Event): void => {
    event.preventDefault();
  };
  const onRestored = (): void => {
    prepare();
    if (last !== undefined) draw(last.scene, last.camera);
  };
  canvas.addEventListener('webglcontextlost', onLost);
  canvas.addEventListener('webglcontextrestored', onRestored);

  /** Keeps what the scene shows, frees the rest. */
  function beadsOf(wanted: Toolpath[]): Beads[] {
    for (const [toolpath, beads] of uploaded) {
      if (wanted.includes(toolpath)) continue;
      gl.deleteTexture(beads.points);
      uploaded.delete(toolpath);
    }
    return wanted.map((toolpath) => {
      const beads = uploaded.get(toolpath) ?? upload(gl, toolpath);
      uploaded.set(toolpath, beads);
      return beads;
    });
  }

  function zigzagOf(toolpath: Toolpath): Toolpath {
    const made = zigzags.get(toolpath) ?? zigzag(toolpath.shape, toolpath.spacing);
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
    gl.uniform3f(at('feed'), scene.feed.speed, scene.feed.maxFlow, scene.feed.layerHeight);
    gl.uniform1f(at('progress'), scene.progress);
    gl.uniform1f(at('blended'), scene.blended === true ? 1 : 0);
    gl.uniform1f(at('spacing'), beads.spacing);
    gl.uniform1i(at('view'), scene.view === 'appearance' ? 0 : scene.view === 'quality' ? 2 : 1);
    gl.uniform1i(at('colourBy'), colourModes[scene.colourBy]);
    gl.uniform1i(at('palette'), 0);
    gl.uniform1i(at('points'), 1);
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
      gl.drawArrays(gl.TRIANGLES, 0, 6 * segments);
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
    const both = compare || wipe !== undefined;
    const beads = beadsOf(both ? [scene.toolpath, zigzagOf(scene.toolpath)] : [scene.toolpath]);
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

  return {
    draw,
    resize(width, height) {
      canvas.width = width;
      canvas.height = height;
      if (last !== undefined) draw(last.scene, last.camera);
    },
    async capture(scene, width) {
      const shown = scene.compare ? 2.08 : 1;
      const scale = width / (scene.page[0] * (shown + 0.1));
      const before = { width: canvas.width, height: canvas.height, last };
      canvas.width = width;
      canvas.height = Math.round(scale * scene.page[1] * 1.1);
      draw(scene, { x: (scene.page[0] * shown) / 2, y: scene.page[1] / 2, scale });
      const blob = await new Promise<Blob | null>((resolve) => {
        canvas.toBlob(resolve, 'image/png');
      });
      canvas.width = before.width;
      canvas.height = before.height;
      if (before.last !== undefined) draw(before.last.scene, before.last.camera);
      if (blob === null) throw new Error('the picture could not be made');
      return blob;
    },
    dispose() {
      canvas.removeEventListener('webglcontextlost', onLost);
      canvas.removeEventListener('webglcontextrestored', onRestored);
      for (const beads of uploaded.values()) gl.deleteTexture(beads.points);
      gl.getExtension('WEBGL_lose_context')?.loseContext();
    },
  };
}
