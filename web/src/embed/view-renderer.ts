// Draws all views of a page with one WebGL2 context: each is drawn into the same hidden canvas and copied from there.
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

/** Mixes the light of the four nearest texels instead of their directions, so that edges of mosaics stay sharp. */
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
  /** Colour of the filament, sRGB 0..255. */
  colour: ViewFile['colour'];
  light: Light;
  /** The eye is straight above every point, as pictures are solved for; otherwise some page widths above the plate. */
  fromAfar?: boolean;
}

/** Converts an sRGB byte to linear 0..1. */
const linear = (byte: number): number => {
  const x = byte / 255;
  return x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
};

/** Renderer that all views of a page share. */
export class ViewRenderer {
  readonly canvas: HTMLCanvasElement;
  readonly #gl: WebGL2RenderingContext;
  #program: Program | undefined;
  readonly #textures = new Map<ViewFile, WebGLTexture>();

  /** Creates the context. @param onRestored  called when a lost context is back @throws Error if there is no WebGL2 */
  constructor(onRestored: () => void) {
    this.canvas = document.createElement('canvas');
    const gl = this.canvas.getContext('webgl2', { antialias: false, depth: false, preserveDrawingBuffer: true });
    if (gl === null) throw new Error('this browser has no WebGL2');
    this.#gl = gl;
    this.canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault(); // allows the browser to restore it
      this.#program = undefined;
      this.#textures.clear();
    });
    this.canvas.addEventListener('webglcontextrestored', onRestored);
  }

  /** Draws a view and copies it to its canvas.
   * @returns false while the context is lost or the texels are missing */
  draw({ file, colour, light, fromAfar = false }: Shown, target: HTMLCanvasElement): boolean {
    const gl = this.#gl;
    const texture = this.#textures.get(file);
    if (gl.isContextLost() || texture === undefined) return false;
    const { width, height } = target;
    // The hidden canvas never shrinks: resizing costs more than the unused area.
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

  /** Frees the texture of a view. */
  forget(file: ViewFile): void {
    const texture = this.#textures.get(file);
    if (texture !== undefined) this.#gl.deleteTexture(texture);
    this.#textures.delete(file);
  }

  holds(file: ViewFile): boolean {
    return this.#textures.has(file);
  }

  /** Uploads the texels of a view: direction and cover, two bytes per texel. */
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
