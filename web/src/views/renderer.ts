// Draws the plate with WebGL2: beads as capsules, lit by an anisotropic microfacet lobe (Beckmann).
import type { PrinterValues, Toolpath } from 'sillon';
import type { ColourBy } from '../model/view.js';
import { beadData, columns, segmentsPerRun, type BeadData } from './bead-data.js';
import type { Delayed } from './delays.js';
import type { Fields } from './fields.js';
import { setLook } from './look.js';
import { directionPalette } from './palette.js';
import { compile, dataTexture, type Program } from './program.js';
import { captureCamera, captureHeight, type Camera, type Renderer, type Scene } from './scene.js';
import { beadFragment, beadVertex } from './shaders.js';
import { inSlices, type Sliced } from './slices.js';

interface Beads extends Pick<BeadData, 'runs'> {
  tolerance: number;
  points: WebGLTexture;
  /** Delays of the neighbours of the same points; a single texel if they are not shown. */
  delays: WebGLTexture;
  spacing: number;
}

/** Indices of two triangles per segment over four shared corners, which are computed once. */
const cornersOfRun = Uint16Array.from(
  { length: 6 * segmentsPerRun },
  (_, k) => 4 * Math.floor(k / 6) + ([0, 1, 2, 1, 2, 3][k % 6] ?? 0),
);

const colourModes: Record<ColourBy, number> = { direction: 0, width: 1, speed: 2, order: 3, delay: 4, lean: 5 };

/** Largest distance between a drawn bead and its toolpath [pixels]; larger: fewer points, but beads visibly move. */
const unseen = 0.05;

const fadeFor = 160; // [ms] time in which new beads fade in over their directions

/** Tells whether a zigzag is shown beside the plate or over it. */
const comparing = ({ compare, wipe }: Scene): boolean => compare || wipe !== undefined;

/** Creates a renderer on a canvas.
 * @param lazy  loads a part of the code on first use; without it, nothing is compared and no delays are shown
 * @throws Error if there is no WebGL2 */
export function createRenderer(canvas: HTMLCanvasElement, lazy?: (load: () => Promise<void>) => unknown): Renderer {
  const context = canvas.getContext('webgl2', { antialias: false, alpha: true, preserveDrawingBuffer: false });
  if (context === null) throw new Error('this browser has no WebGL2');
  const gl = context;
  let beadProgram: Program;
  let fields: Fields | undefined;
  let palette: WebGLTexture;
  const uploaded = new Map<Toolpath, Beads>();
  const preparing = new Map<Toolpath, { tolerance: number; work: Sliced<BeadData> }>();
  /** The plate's beads in the last drawing: they stay until new ones are prepared. */
  let before: { beads: Beads; page: string } | undefined;
  /** Directions stand in for beads, or lie above them while the beads fade in. */
  let veiled = false;
  let cameAt: number | undefined; // [ms] time at which the new beads came
  const zigzags = new WeakMap<Toolpath, Toolpath>();
  const delayed = new WeakMap<Toolpath, { by: Delayed; speed: number }>();
  let last: { scene: Scene; camera: Camera } | undefined;

  /** Makes the GPU resources; called again after a lost context. */
  function prepare(): void {
    beadProgram = compile(gl, beadVertex, beadFragment);
    palette = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, palette);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, 256, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, directionPalette());
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.REPEAT);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, cornersOfRun, gl.STATIC_DRAW);
    fields = undefined;
    uploaded.clear();
    before = undefined;
  }
  prepare();

  const onLost = (event: Event): void => event.preventDefault();
  const onRestored = (): void => {
    prepare();
    redraw();
  };
  canvas.addEventListener('webglcontextlost', onLost);
  canvas.addEventListener('webglcontextrestored', onRestored);

  /** Uploads the points of a toolpath as textures. */
  function upload({ rows, points, delays, runs }: BeadData, { spacing }: Toolpath, tolerance: number): Beads {
    const size = [columns, rows] as const;
    const late = delays.length === 2 ? ([1, 1] as const) : size;
    return {
      tolerance,
      points: dataTexture(gl, size, [gl.RGBA32F, gl.RGBA, gl.FLOAT], points),
      delays: dataTexture(gl, late, [gl.RG32F, gl.RG, gl.FLOAT], delays),
      runs,
      spacing,
    };
  }

  function free(beads: Beads): void {
    gl.deleteTexture(beads.points);
    gl.deleteTexture(beads.delays);
  }

  /** Keeps the buffers of the scene and of the beads that stand in for it; frees the rest. */
  function keepOnly(wanted: readonly Toolpath[]): void {
    for (const [toolpath, beads] of uploaded) {
      if (wanted.includes(toolpath) || beads === before?.beads) continue;
      free(beads);
      uploaded.delete(toolpath);
    }
    for (const [toolpath, { work }] of preparing) {
      if (wanted.includes(toolpath)) continue;
      work.stop();
      preparing.delete(toolpath);
    }
  }

  /** Returns the uploaded beads of a toolpath, and begins to prepare them if they are missing or too coarse.
   * @returns beads of another tolerance until the right ones are prepared; undefined: there are none yet */
  function beadsOf(toolpath: Toolpath, tolerance: number, late?: Delayed): Beads | undefined {
    const known = uploaded.get(toolpath);
    const begun = preparing.get(toolpath);
    if (known?.tolerance === tolerance || begun?.tolerance === tolerance) return known;
    begun?.work.stop();
    let early = true;
    const delays = late?.toolpath === toolpath ? late.delays : undefined;
    const work = inSlices(beadData(toolpath, tolerance, delays), (data) => {
      preparing.delete(toolpath);
      if (known !== undefined) free(known);
      uploaded.set(toolpath, upload(data, toolpath, tolerance));
      if (before?.beads === known) before = undefined;
      if (!early) redraw();
    });
    early = false;
    if (uploaded.get(toolpath)?.tolerance !== tolerance) preparing.set(toolpath, { tolerance, work });
    return uploaded.get(toolpath);
  }

  /** Function that makes zigzags; loaded with the first comparison. */
  let zigzag: (typeof import('./zigzag.js'))['zigzag'] | undefined;
  async function loadZigzag(): Promise<void> {
    ({ zigzag } = await import('./zigzag.js'));
    redraw();
  }

  /** Class that draws directions; loaded with the first scene that has some. */
  let fieldsOf: (typeof import('./fields.js'))['Fields'] | undefined;
  async function loadFields(): Promise<void> {
    ({ Fields: fieldsOf } = await import('./fields.js'));
    redraw();
  }

  let delays: typeof import('./delays.js') | undefined;
  async function loadDelays(): Promise<void> {
    delays = await import('./delays.js');
    redraw();
  }

  /** Returns the delays of a toolpath at the printer's speed; undefined until their code is loaded. */
  function delayedOf(toolpath: Toolpath, printer: PrinterValues): Delayed | undefined {
    if (delays === undefined) return undefined;
    const known = delayed.get(toolpath);
    const speed = delays.shownSpeed(printer);
    if (known?.speed === speed) return known.by;
    const by = delays.delaysOf(toolpath, speed);
    delayed.set(toolpath, { by, speed });
    return by;
  }

  /** Returns the zigzag of a toolpath's shape; undefined until its code is loaded. */
  function zigzagOf(toolpath: Toolpath): Toolpath | undefined {
    const made = zigzags.get(toolpath) ?? zigzag?.(toolpath.shape, toolpath.spacing);
    if (made === undefined) return undefined;
    zigzags.set(toolpath, made);
    return made;
  }

  /** Sets the uniforms of the look of beads in the program in use. */
  function setColours(program: Program, scene: Scene, spacing: number): void {
    const { at } = program;
    const { colour: body, along, across } = scene.filament;
    setLook(gl, program, { ...scene, body, slopes: [along, across] });
    const { printer, layerHeight } = scene.feed;
    gl.uniform3f(at('feed'), printer.speed, printer.maxFlow, layerHeight);
    gl.uniform1f(at('blended'), scene.blended === true ? 1 : 0);
    gl.uniform1f(at('spacing'), spacing);
    gl.uniform1i(at('view'), scene.view === 'appearance' ? 0 : scene.view === 'quality' ? 2 : 1);
    gl.uniform1i(at('colourBy'), colourModes[scene.colourBy]);
    gl.uniform1i(at('palette'), 0);
  }

  /** Draws the runs of beads whose boxes touch the screen. */
  function drawBeads(beads: Beads, scene: Scene, camera: Camera): void {
    gl.useProgram(beadProgram.program);
    const { at } = beadProgram;
    setColours(beadProgram, scene, beads.spacing);
    gl.uniform4f(at('camera'), camera.x, camera.y, camera.scale, 1);
    gl.uniform2f(at('screen'), gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.uniform1f(at('progress'), scene.progress);
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
    for (const { first, segments, box } of beads.runs) {
      if (box[0] > camera.x + acrossHalf || box[2] < camera.x - acrossHalf) continue;
      if (box[1] > camera.y + tallHalf || box[3] < camera.y - tallHalf) continue;
      gl.uniform1i(at('first'), first);
      gl.drawElements(gl.TRIANGLES, 6 * segments, gl.UNSIGNED_SHORT, 0);
    }
  }

  /** Returns the plate's beads and those of the zigzag beside it; undefined: they are still to come. */
  function beadsFor(scene: Scene, toolpath: Toolpath, camera: Camera): (Beads | undefined)[] | undefined {
    const other = comparing(scene) ? zigzagOf(toolpath) : undefined;
    if (comparing(scene) && other === undefined) lazy?.(loadZigzag);
    // Tolerances are powers of two, so that not every step of a zoom prepares the beads anew. While the print plays,
    // all points are drawn, so that it grows point by point.
    const byDelay = scene.view === 'toolpath' && (scene.colourBy === 'delay' || scene.colourBy === 'lean');
    const late = byDelay ? delayedOf(toolpath, scene.feed.printer) : undefined;
    if (byDelay && late === undefined) lazy?.(loadDelays);
    const whole = scene.progress < 1 || late !== undefined;
    const tolerance = whole ? 0 : 2 ** Math.floor(Math.log2((unseen * (scene.fineness ?? 1)) / camera.scale));
    const shown = late?.toolpath ?? toolpath;
    const beads = beadsOf(shown, tolerance, late);
    const others = other && beadsOf(other, tolerance);
    keepOnly(other === undefined ? [shown] : [shown, other]);
    const page = scene.page.join();
    if (beads === undefined) return before?.page === page ? [before.beads, others] : undefined;
    before = { beads, page };
    return [beads, others];
  }

  /** Returns the opacity of the directions, 0..1; it falls once there are beads. */
  function veilFor(there: boolean, { directions, fades }: Scene): number {
    if (directions === undefined) return 0;
    if (!there) {
      veiled = true;
      cameAt = undefined;
      return 1;
    }
    if (!veiled || fades !== true) {
      veiled = false;
      return 0;
    }
    cameAt ??= performance.now();
    const left = 1 - (performance.now() - cameAt) / fadeFor;
    veiled = left > 0;
    if (veiled) requestAnimationFrame(redraw);
    return Math.max(0, left);
  }

  /** Draws the plate, its directions, and the zigzag that it is compared with. */
  function draw(scene: Scene, camera: Camera): void {
    last = { scene, camera };
    if (gl.isContextLost()) return;
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const { compare, wipe, page, directions } = scene;
    if (directions !== undefined && fieldsOf === undefined) lazy?.(loadFields);
    if (fieldsOf !== undefined) fields ??= new fieldsOf(gl, palette);
    if (scene.view === 'directions') {
      if (directions !== undefined) fields?.drawColours(directions, scene, camera);
      return;
    }
    const quick = scene.quick === true && directions !== undefined && fields !== undefined;
    const beads = quick ? undefined : scene.toolpath && beadsFor(scene, scene.toolpath, camera);
    if (scene.toolpath === undefined) before = undefined;
    const opacity = veilFor(beads !== undefined, scene);
    const told = (program: Program): void => setColours(program, scene, scene.spacing ?? 1);
    const { drawingBufferWidth: columns, drawingBufferHeight: rows } = gl;
    const edge = wipe === undefined ? 0 : Math.round(columns / 2 + (wipe * page[0] - camera.x) * camera.scale);
    for (let k = 0; k < (comparing(scene) ? 2 : 1); ++k) {
      if (wipe !== undefined) {
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(k === 0 ? edge : 0, 0, Math.max(0, k === 0 ? columns - edge : edge), rows);
      }
      const seen = compare ? { ...camera, x: camera.x - k * page[0] * 1.08 } : camera;
      const one = beads?.[k];
      if (one !== undefined) drawBeads(one, scene, seen);
      if (opacity > 0 && directions !== undefined)
        fields?.drawSheen(directions, scene, seen, { opacity, told, plain: k === 1 });
    }
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
    },
    async capture(scene, width) {
      if (comparing(scene)) await loadZigzag();
      const kept = { width: canvas.width, height: canvas.height, last };
      canvas.width = width;
      canvas.height = captureHeight(scene, width);
      const above = captureCamera(scene, width);
      const whole = { ...scene, quick: false, fades: false };
      draw(whole, above);
      for (const { work } of preparing.values()) work.finish();
      draw(whole, above);
      const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, 'image/png'));
      ({ last } = kept);
      this.resize(kept.width, kept.height);
      redraw();
      if (blob === null) throw new Error('the picture could not be made');
      return blob;
    },
    dispose() {
      canvas.removeEventListener('webglcontextlost', onLost);
      canvas.removeEventListener('webglcontextrestored', onRestored);
      before = undefined;
      keepOnly([]);
      gl.getExtension('WEBGL_lose_context')?.loseContext();
    },
  };
}
