// Shows a sliced print at an angle: its heights as a mesh, with the pictures of its faces draped over it. Heights tell
// nothing from below, so a flat bottom is drawn there.
import type { PrintRelief, Toolpath } from 'sillon';
import { appearance } from '../model/appearance.js';
import type { FilamentLook, Light } from '../model/view.js';
import { setLook } from './look.js';
import { isBelow, type Orbit } from './orbit.js';
import { compile } from './program.js';
import { lookOfBead } from './shaders.js';

const mostCells = 720; // mesh cells along the longer side
const mostTexels = 2048; // texels of a draped picture, along the longer side
const angles = 128; // steps of 180° in which the directions of beads are stored

export interface TiltedScene {
  relief: PrintRelief;
  /** Height of the print's layers [mm]. */
  layer: number;
  beads: Toolpath | undefined;
  /** Draws outlines on a canvas in millimetres: of the top faces, or of the bottom faces if the eye is below.
   * @param pixel  size of a texel [mm] */
  paint: (context: OffscreenCanvasRenderingContext2D, pixel: number) => void;
  /** Colour of the slicer's beads, sRGB. */
  body: readonly [number, number, number];
  filament: FilamentLook;
  light: Light;
}

export interface TiltedRenderer {
  /** Takes new heights, beads, outlines or colours; the next draw shows them. */
  set(scene: TiltedScene): void;
  /** Draws at once. @param orbit  in device pixels */
  draw(orbit: Orbit): void;
  resize(width: number, height: number): void;
  dispose(): void;
}

const vertex = `#version 300 es
precision highp float;
uniform sampler2D heights;
uniform ivec2 cells;
uniform int stride;
uniform vec2 size;     // of the page [mm]
uniform vec4 orbit;    // cosine and sine of the turn, of the tilt
uniform vec3 placed;   // scale, middle [pixels]
uniform vec2 screen;
uniform float highest;
uniform bool under;    // the bottom, rather than what stands on it
out vec3 place;
out float above;
out vec2 at;
void main() {
  ivec2 corner = ivec2(gl_VertexID / 2, gl_InstanceID + gl_VertexID % 2);
  ivec2 cell = min(corner * stride, cells - 1);
  above = texelFetch(heights, cell, 0).r;
  float z = under ? 0.0 : above;
  vec2 p = (vec2(cell) + 0.5) / vec2(cells);
  at = p;
  place = vec3((p.x - 0.5) * size.x, (0.5 - p.y) * size.y, z);
  float across = orbit.x * place.x - orbit.y * place.y;
  float away = orbit.y * place.x + orbit.x * place.y;
  vec2 pixel = placed.yz + placed.x * vec2(across, -(away * orbit.z + z * orbit.w));
  float reach = length(size) + highest;
  gl_Position = vec4(2.0 * pixel.x / screen.x - 1.0, 1.0 - 2.0 * pixel.y / screen.y, (away * orbit.w - z * orbit.z) / reach, 1.0);
}`;

const fragment = `#version 300 es
precision highp float;
in vec3 place;
in float above;
in vec2 at;
uniform sampler2D painted;
uniform sampler2D tangents;
uniform vec4 orbit;
uniform vec3 plastic;
uniform float layer;
uniform bool under;
out vec4 colour;
${lookOfBead}
void main() {
  if (above < 1e-3) discard;  // the bed
  vec3 flank = cross(dFdx(place), dFdy(place));
  vec3 normal = normalize(flank.z < 0.0 ? -flank : flank);
  vec4 face = texture(painted, at);
  // Walls: the slicer's layers, one above the other.
  float wall = under ? 0.0 : smoothstep(0.55, 0.25, normal.z);
  float ring = place.z / layer;
  float fine = clamp(0.6 - fwidth(ring), 0.0, 1.0);
  float lit = 0.6 + 0.38 * max(0.0, dot(normal, normalize(vec3(-0.53, 0.53, 0.66))));
  vec3 side = plastic * lit * (1.0 - 0.5 * fine * (0.5 + 0.5 * cos(6.2831853 * ring)));
  vec3 top = mix(plastic * lit, face.rgb, orbit.z < 0.0 && !under ? 0.0 : face.a);
  vec4 bead = texture(tangents, at);
  if (bead.a > 0.5 && under == (orbit.z < 0.0)) {
    vec2 twice = bead.rg * 2.0 - 1.0;
    float angle = 0.5 * atan(twice.y, twice.x);
    // The eye as look() takes it: above a place beside the middle of a page of 1 mm.
    vec2 eye = vec2(-orbit.y, -orbit.x) * orbit.w / max(abs(orbit.z), 0.05);
    vec2 along = vec2(cos(angle), sin(angle));
    // The print turned over, as it will lie under the lamp: left is right.
    vec2 over = vec2(under ? -1.0 : 1.0, 1.0);
    top = toned(look(vec2(0.5) - 2.4 * over * eye, over * along, 0.0, 0.0)) * (0.72 + 0.28 * bead.b);
  }
  colour = vec4(mix(top, side, wall), 1.0);
}`;

/** Draws beads as colours: red and green are cosine and sine of twice their angle, blue tells crests from furrows. */
function drawTangents(context: OffscreenCanvasRenderingContext2D, { cycles }: Toolpath): void {
  const lines = Array.from({ length: angles }, () => new Path2D());
  let width = 0.4;
  for (const { points, widths } of cycles) {
    const count = widths.length;
    width = widths[0] ?? width;
    for (let k = 0; k < count; ++k) {
      const [from, to] = [2 * k, 2 * ((k + 1) % count)];
      const [x0, y0] = [points[from] as number, points[from + 1] as number];
      const [x1, y1] = [points[to] as number, points[to + 1] as number];
      const share = Math.atan2(y1 - y0, x1 - x0) / Math.PI + 1; // 0..2; both ways along a line give the same step
      const line = lines[Math.round(share * angles) % angles];
      line?.moveTo(x0, y0);
      line?.lineTo(x1, y1);
    }
  }
  context.lineCap = 'round';
  // Furrows come first, then the crests over them.
  for (const [share, crest] of [
    [1.3, 0],
    [0.6, 255],
  ] as const) {
    context.lineWidth = share * width;
    lines.forEach((line, k) => {
      const turn = (2 * Math.PI * k) / angles;
      const byte = (value: number): number => Math.round(127.5 + 127.5 * value);
      context.strokeStyle = `rgb(${byte(Math.cos(turn))}, ${byte(Math.sin(turn))}, ${crest})`;
      context.stroke(line);
    });
  }
}

/** Creates a renderer on a canvas. @throws Error if there is no WebGL2 */
export function createTilted(canvas: HTMLCanvasElement): TiltedRenderer {
  const context = canvas.getContext('webgl2', { antialias: true, alpha: true });
  if (context === null) throw new Error('this browser has no WebGL2');
  const gl = context;
  let scene: TiltedScene | undefined;
  let last: Orbit | undefined;
  let heightsOf: PrintRelief | undefined;
  let highest = 1;
  let program = compile(gl, vertex, fragment);
  let textures = { heights: gl.createTexture(), painted: gl.createTexture(), tangents: gl.createTexture() };

  function uploadHeights(relief: PrintRelief): void {
    highest = 1;
    for (const height of relief.heights) highest = Math.max(highest, height);
    gl.bindTexture(gl.TEXTURE_2D, textures.heights);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, relief.columns, relief.rows, 0, gl.RED, gl.FLOAT, relief.heights);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    heightsOf = relief;
  }

  /** Draws on a canvas over the page, in millimetres with y up, and uploads it as a texture. */
  function drape(
    texture: WebGLTexture,
    relief: PrintRelief,
    draw: (on: OffscreenCanvasRenderingContext2D) => void,
  ): void {
    const wide = relief.columns * relief.cell;
    const tall = relief.rows * relief.cell;
    const scale = mostTexels / Math.max(wide, tall);
    const on = new OffscreenCanvas(Math.max(1, Math.round(wide * scale)), Math.max(1, Math.round(tall * scale)));
    const context = on.getContext('2d');
    if (context === null) return;
    context.setTransform(scale, 0, 0, -scale, 0, on.height);
    draw(context);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, on);
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  }

  /** Uploads what has changed in the scene. */
  function set(next: TiltedScene): void {
    const before = scene;
    scene = next;
    if (gl.isContextLost()) return;
    const { relief, beads } = next;
    if (relief !== heightsOf) uploadHeights(relief);
    const texel = (Math.max(relief.columns, relief.rows) * relief.cell) / mostTexels;
    drape(textures.painted, relief, (on) => next.paint(on, texel));
    if (before?.beads === beads && before?.relief === relief) return;
    drape(textures.tangents, relief, (on) => {
      if (beads !== undefined) drawTangents(on, beads);
    });
  }

  /** Draws the print and, from below, its bottom, as one triangle strip per row of cells. */
  function draw(orbit: Orbit): void {
    last = orbit;
    if (scene === undefined || gl.isContextLost()) return;
    const { relief, layer, body, filament, light } = scene;
    const stride = Math.max(
      1,
      Math.ceil(Math.max(relief.columns, relief.rows) / mostCells),
      Math.floor(1 / (relief.cell * orbit.scale)), // cells smaller than a pixel cannot be told apart
    );
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(program.program);
    const { at } = program;
    Object.values(textures).forEach((texture, k) => {
      gl.activeTexture(gl.TEXTURE0 + k);
      gl.bindTexture(gl.TEXTURE_2D, texture);
    });
    gl.uniform1i(at('heights'), 0);
    gl.uniform1i(at('painted'), 1);
    gl.uniform1i(at('tangents'), 2);
    gl.uniform2i(at('cells'), relief.columns, relief.rows);
    gl.uniform1i(at('stride'), stride);
    gl.uniform2f(at('size'), relief.columns * relief.cell, relief.rows * relief.cell);
    gl.uniform4f(at('orbit'), Math.cos(orbit.turn), Math.sin(orbit.turn), Math.cos(orbit.tilt), Math.sin(orbit.tilt));
    gl.uniform3f(at('placed'), orbit.scale, orbit.x, orbit.y);
    gl.uniform2f(at('screen'), gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.uniform1f(at('highest'), highest);
    gl.uniform3f(at('plastic'), body[0] / 255, body[1] / 255, body[2] / 255);
    gl.uniform1f(at('layer'), layer);
    const { colour, along, across } = filament;
    const seen = { light, lampSlope: appearance.softbox, fromAfar: false };
    setLook(gl, program, { ...seen, body: colour, slopes: [along, across], page: [1, 1] });
    const [columns, rows] = [Math.ceil(relief.columns / stride), Math.ceil(relief.rows / stride)];
    for (const under of isBelow(orbit) ? [0, 1] : [0]) {
      gl.uniform1i(at('under'), under);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 2 * columns, rows - 1);
    }
  }

  const onLost = (event: Event): void => event.preventDefault();
  const onRestored = (): void => {
    program = compile(gl, vertex, fragment);
    textures = { heights: gl.createTexture(), painted: gl.createTexture(), tangents: gl.createTexture() };
    heightsOf = undefined;
    const shown = scene;
    scene = undefined;
    if (shown !== undefined) set(shown);
    if (last !== undefined) draw(last);
  };
  canvas.addEventListener('webglcontextlost', onLost);
  canvas.addEventListener('webglcontextrestored', onRestored);

  return {
    set,
    draw,
    resize(width, height) {
      canvas.width = width;
      canvas.height = height;
    },
    dispose() {
      canvas.removeEventListener('webglcontextlost', onLost);
      canvas.removeEventListener('webglcontextrestored', onRestored);
      gl.getExtension('WEBGL_lose_context')?.loseContext();
    },
  };
}
