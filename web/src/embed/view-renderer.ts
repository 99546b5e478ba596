// Draws views with one WebGL2 context for the whole page: each into the same hidden canvas, from where it is copied.
import { appearance } from '../model/appearance.js';
import { setLook } from '../views/look.js';
import { compile, type Program } from '../views/program.js';
import type { Light } from '../model/view.js';
import { lookOfBead } from '../views/shaders.js';
import type { ViewFile } from './view-file.js';

const vertex = `#version 300 es
out vec2 unit;
void main() {
  unit = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(unit * 2.0 - 1.0, 0.0, 1.0);
}
`;

/** The light of the four nearest texels, not that of their mean direction: edges of mosaics stay what they are. */
const fragment = `#version 300 es
precision highp float;
in vec2 unit;
uniform sampler2D texels;
out vec4 colour;
${lookOfBead}
// Half a step of direction, this way or that: else steps would show as contours.
float grain(ivec2 at) {
  uvec2 h = uvec2(at) * uvec2(1597334673u, 3812015801u);
  uint n = (h.x ^ h.y) * 1597334673u;
  return float(n >> 8) / 16777216.0 - 0.5;
}

void main() {
  ivec2 size = textureSize(texels, 0);
  vec2 place = vec2(unit.x, 1.0 - unit.y) * vec2(size) - 0.5;
  vec2 share = fract(place);
  vec3 light = vec3(0.0);
  float cover = 0.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 corner = ivec2(k & 1, k >> 1);
    ivec2 at = clamp(ivec2(floor(place)) + corner, ivec2(0), size - 1);
    vec3 texel = texelFetch(texels, at, 0).rgb;
    vec2 near = mix(1.0 - share, share, vec2(corner));
    float weight = near.x * near.y * texel.g;
    if (weight == 0.0) continue;
    float angle = (texel.r * 255.0 + grain(at)) / 256.0 * 3.14159265;
    light += weight * look(unit * page, vec2(cos(angle), sin(angle)), 0.0, 0.0);
    cover += weight;
  }
  vec3 mean = toned(light / max(cover, 1e-4));
  colour = vec4(mean * cover, cover);
}
`;

export interface Shown {
  file: ViewFile;
  /** sRGB 0..255. */
  colour: ViewFile['colour'];
  light: Light;
  /** Seen from straight above all over, as pictures are solved for; else from some page widths above. */
  fromAfar?: boolean;
}

const linear = (byte: number): number => {
  const x = byte / 255;
  return x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
};

export class ViewRenderer {
  readonly canvas: HTMLCanvasElement;
  readonly #gl: WebGL2RenderingContext;
  #program: Program | undefined;
  readonly #textures = new Map<ViewFile, WebGLTexture>();

  /** @throws Error where there is no WebGL2. @param onRestored  the context was lost and is back */
  constructor(onRestored: () => void) {
    this.canvas = document.createElement('canvas');
    const gl = this.canvas.getContext('webgl2', { antialias: false, depth: false, preserveDrawingBuffer: true });
    if (gl === null) throw new Error('this browser has no WebGL2');
    this.#gl = gl;
    this.canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault(); // it shall come back
      this.#program = undefined;
      this.#textures.clear();
    });
    this.canvas.addEventListener('webglcontextrestored', onRestored);
  }

  /** @returns whether it was drawn: not while the context is lost, and not before its texels are there */
  draw({ file, colour, light, fromAfar = false }: Shown, target: HTMLCanvasElement): boolean {
    const gl = this.#gl;
    const texture = this.#textures.get(file);
    if (gl.isContextLost() || texture === undefined) return false;
    const { width, height } = target;
    // Never smaller again: another size costs more than what is not used.
    if (this.canvas.width < width) this.canvas.width = width;
    if (this.canvas.height < height) this.canvas.height = height;
    this.#program ??= compile(gl, vertex, fragment);
    const { program, at } = this.#program;
    gl.useProgram(program);
    gl.viewport(0, 0, width, height);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.uniform1i(at('texels'), 0);
    setLook(gl, this.#program, {
      light,
      lampSlope: appearance.softbox,
      fromAfar,
      body: [linear(colour[0]), linear(colour[1]), linear(colour[2])],
      slopes: file.slopes,
      page: file.page,
    });
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    const context = target.getContext('2d');
    if (context === null) return false;
    context.clearRect(0, 0, width, height);
    context.drawImage(this.canvas, 0, this.canvas.height - height, width, height, 0, 0, width, height);
    return true;
  }

  forget(file: ViewFile): void {
    const texture = this.#textures.get(file);
    if (texture !== undefined) this.#gl.deleteTexture(texture);
    this.#textures.delete(file);
  }

  holds(file: ViewFile): boolean {
    return this.#textures.has(file);
  }

  /** What is drawn of them: direction and cover, two bytes a texel. */
  hold(file: ViewFile, texels: ImageBitmap): void {
    const gl = this.#gl;
    this.forget(file);
    if (gl.isContextLost()) return;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RG8, gl.RG, gl.UNSIGNED_BYTE, texels);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    this.#textures.set(file, texture);
  }
}
