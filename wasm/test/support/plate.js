// A project's plate and G-code by the engine, in short: the same module runs in Node, in pages and in their workers.

/** The input that a project describes. @param read  gives the Blob of a file that it names. */
export async function inputOf({ shape, layers, pictures }, read) {
  const withFiles = async (fields) => {
    const files = {};
    for (const key of ['file', 'maskFile', 'modeFile']) if (fields[key]) files[key] = await read(fields[key]);
    if (/\.(?:[to]tf|woff2?)$/i.test(fields.font ?? '')) files.font = await read(fields.font);
    if (fields.pictures) files.pictures = await Promise.all(fields.pictures.map(withFiles));
    return { ...fields, ...files };
  };
  const { builtin, size, radius, pageWidth, unitless, paint } = shape;
  const drawn = builtin === 'none' ? { size } : { builtin, size, radius };
  return {
    shape: shape.file === '' ? drawn : { file: await read(shape.file), pageWidth, unitless, paint },
    layers: await Promise.all(layers.map(withFiles)),
    pictures,
  };
}

/** Equal answers mean equal plates and equal bytes of G-code. */
export async function makePlate(engine, json, read) {
  const project = await engine.readProject(json);
  const input = await inputOf(project, read);
  const { toolpath, report } = await engine.generateToolpath(input, project.toolpath, { measure: false });
  const { blob } = await engine.writeGcode(toolpath, project.printer, { ...project.print, date: new Date(0) });
  return { digest: report.digest, gcode: await sumOf(blob), bytes: blob.size };
}

/** Equal answers mean equal plates, equal bytes of SVG, and layers that ask for equal directions. */
export async function drawPlate(engine, json, read) {
  const project = await engine.readProject(json);
  const input = await inputOf(project, read);
  const { width, height, angle, mode } = await engine.drawLayers(input, project.toolpath);
  const { toolpath, report } = await engine.generateToolpath(input, project.toolpath, { measure: false });
  return {
    digest: report.digest,
    svg: await sumOf(await engine.writeSvg(toolpath)),
    raster: await sumOf(new Blob([Uint32Array.of(width, height), angle, mode])),
  };
}

/** SHA-256 in hexadecimal digits. */
export async function sumOf(blob) {
  const sum = await crypto.subtle.digest('SHA-256', await blob.arrayBuffer());
  return Array.from(new Uint8Array(sum), (byte) => byte.toString(16).padStart(2, '0')).join('');
}
