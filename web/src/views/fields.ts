// Draws a plate's directions, as colours or the way beads along them would look.
import type { Shape } from 'sillon';
import type { DirectionRaster, Directions } from '../model/raster.js';
import { fieldFragment, fieldVertex, sheenFragment } from './field-shaders.js';
import { fillShape } from './outline.js';
import { compile, dataTexture, type Program } from './program.js';
import type { Camera, Scene } from './scene.js';

const coverSide = 1024; // texels along the longer side

/** Directions of a plain zigzag: 45° everywhere. */
export const slanted: DirectionRaster = {
  width: 1,
  height: 1,
  angle: Uint16Array.of(Math.round(0.75 * 65535)),
  mode: Uint8Array.of(3),
};

/** Draws a mask: white within a shape, black around it. */
function coverOf(shape: Shape): OffscreenCanvas {
  const [width, height] = shape.page;
  const scale = coverSide / Math.max(width, height);
  const canvas = new OffscreenCanvas(Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale)));
  const context = canvas.getContext('2d');
  if (context === null) throw new Error('this browser has no canvas to draw shapes on');
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.setTransform(canvas.width / width, 0, 0, -canvas.height / height, 0, canvas.height);
  context.fillStyle = 'white';
  fillShape(context, shape);
  return canvas;
}

/** Draws direction rasters with WebGL2; keeps the textures of the rasters of the last drawing. */
export class Fields {
  #colours: Program | undefined;
  #sheen: Program | undefined;
  readonly #rasters = new Map<DirectionRaster, { angle: WebGLTexture; mode: WebGLTexture }>();
  #cover: { texture: WebGLTexture; of: Shape } | undefined;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    /** Colours of directions, from `directionPalette`. */
    private readonly palette: WebGLTexture,
  ) {}

  /** Draws the directions as colours, with short strokes along them. */
  drawColours({ raster }: Directions, scene: Scene, camera: Camera): void {
    this.#keep([raster]);
    this.#colours ??= compile(this.gl, fieldVertex, fieldFragment);
    this.#draw(this.#colours, raster, scene, camera);
  }

  /** Draws the shape the way beads along its directions would look.
   * @param opacity  opacity of the whole drawing
   * @param told  sets the uniforms of the look of beads
   * @param plain  draws a plain zigzag instead of the plate's directions */
  drawSheen(
    { raster, shape }: Directions,
    scene: Scene,
    camera: Camera,
    { opacity, told, plain }: { opacity: number; told: (program: Program) => void; plain: boolean },
  ): void {
    const { gl } = this;
    this.#keep([raster, slanted]);
    this.#sheen ??= compile(gl, fieldVertex, sheenFragment);
    gl.useProgram(this.#sheen.program);
    told(this.#sheen);
    gl.uniform1f(this.#sheen.at('opacity'), opacity);
    this.#bind(this.#sheen, 'cover', 2, this.#coverOf(shape));
    this.#draw(this.#sheen, plain ? slanted : raster, scene, camera);
  }

  /** Draws a raster over the page with a program. */
  #draw(program: Program, raster: DirectionRaster, scene: Scene, camera: Camera): void {
    const { gl } = this;
    const { at } = program;
    gl.useProgram(program.program);
    gl.uniform4f(at('camera'), camera.x, camera.y, camera.scale, 1);
    gl.uniform2f(at('screen'), gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.uniform2f(at('page'), ...scene.page);
    const { angle, mode } = this.#texturesOf(raster);
    this.#bind(program, 'palette', 0, this.palette);
    this.#bind(program, 'angles', 1, angle);
    this.#bind(program, 'modes', 3, mode);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }

  #bind({ at }: Program, name: string, unit: number, texture: WebGLTexture): void {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.uniform1i(at(name), unit);
    gl.activeTexture(gl.TEXTURE0); // textures are made on unit 0
  }

  /** Returns the textures of a raster, which are uploaded once. */
  #texturesOf(raster: DirectionRaster): { angle: WebGLTexture; mode: WebGLTexture } {
    const { gl } = this;
    const known = this.#rasters.get(raster);
    if (known !== undefined) return known;
    const size = [raster.width, raster.height] as const;
    const made = {
      angle: dataTexture(gl, size, [gl.R16UI, gl.RED_INTEGER, gl.UNSIGNED_SHORT], raster.angle),
      mode: dataTexture(gl, size, [gl.R8UI, gl.RED_INTEGER, gl.UNSIGNED_BYTE], raster.mode),
    };
    this.#rasters.set(raster, made);
    return made;
  }

  /** Deletes the textures of all other rasters. */
  #keep(wanted: readonly DirectionRaster[]): void {
    for (const [raster, { angle, mode }] of this.#rasters) {
      if (wanted.includes(raster)) continue;
      this.gl.deleteTexture(angle);
      this.gl.deleteTexture(mode);
      this.#rasters.delete(raster);
    }
  }

  /** Returns the mask of a shape as a texture; the last one is kept. */
  #coverOf(shape: Shape): WebGLTexture {
    const { gl } = this;
    if (this.#cover?.of === shape) return this.#cover.texture;
    if (this.#cover !== undefined) gl.deleteTexture(this.#cover.texture);
    const texture = gl.createTexture();
    this.#cover = { texture, of: shape };
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, gl.RED, gl.UNSIGNED_BYTE, coverOf(shape));
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return texture;
  }
}
