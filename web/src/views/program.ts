// WebGL programs of two shaders, with the locations of their uniforms.

export interface Program {
  program: WebGLProgram;
  at: (uniform: string) => WebGLUniformLocation | null;
}

/** Builds a program. @throws Error if a shader does not compile or the WebGL context is lost */
export function compile(gl: WebGL2RenderingContext, vertex: string, fragment: string): Program {
  const program = gl.createProgram();
  for (const [type, text] of [
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ] as const) {
    const shader = gl.createShader(type);
    if (shader === null) throw new Error('WebGL was lost');
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (gl.getProgramParameter(program, gl.LINK_STATUS) !== true && !gl.isContextLost()) {
    throw new Error(`a shader could not be built: ${gl.getProgramInfoLog(program) ?? ''}`);
  }
  const places = new Map<string, WebGLUniformLocation | null>(); // asking again in every frame would stall some drivers
  const at = (uniform: string): WebGLUniformLocation | null => {
    const known = places.get(uniform);
    if (known !== undefined) return known;
    const place = gl.getUniformLocation(program, uniform);
    places.set(uniform, place);
    return place;
  };
  return { program, at };
}

/** Makes a texture of values that shaders read one by one.
 * @param kind  internal format, format and type
 * @param texels  null: they are uploaded later */
export function dataTexture(
  gl: WebGL2RenderingContext,
  [width, height]: readonly [number, number],
  [internalFormat, format, type]: readonly [GLenum, GLenum, GLenum],
  texels: Uint8Array | Uint16Array | Float32Array | null,
): WebGLTexture {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  gl.texImage2D(gl.TEXTURE_2D, 0, internalFormat, width, height, 0, format, type, texels);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return texture;
}
