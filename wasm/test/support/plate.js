// A project's plate and G-code by the engine, in short: the same module runs in Node, in pages and in their workers.

/** The input that a project describes. @param read  gives the Blob of a file that it names. */
export async function inputOf({ shape, directions, modes, pictures, layers = [] }, read) {
  const composed = [];
  for (const layer of layers) {
    const files = {};
    for (const key of ['file', 'maskFile']) if (layer[key]) files[key] = await read(layer[key]);
    if (/\.[to]tf$/i.test(layer.font ?? '')) files.font = await read(layer.font);
    composed.push({ ...layer, ...files });
  }
  const { builtin, size, radius, pageWidth, unitless, paint } = shape;
  const { encoding, angle } = directions;
  const { mode } = modes;
  const drawn = builtin === 'none' ? { size } : { builtin, size, radius };
  const lit = [];
  for (const { file, lamp } of pictures.files) lit.push({ file: await read(file), lamp });
  return {
    ...(lit.length > 0 && { pictures: { ...pictures, files: lit } }),
    ...(composed.length > 0 && { layers: composed }),
    shape: shape.file === '' ? drawn : { file: await read(shape.file), pageWidth, unitless, paint },
    directions: directions.file === '' ? { angle } : { file: await read(directions.file), encoding },
    modes: modes.file === '' ? { mode } : { file: await read(modes.file) },
  };
}

/** Equal answers mean equal plates and equal bytes of G-code. */
export async function makePlate(engine, json, read) {
  const project = await engine.readProject(json);
  const input = await inputOf(project, read);
  const { toolpath, report } = await engine.generateToolpath(input, project.toolpath, { measure: false });
  const { blob } = await engine.writeGcode(toolpath, project.printer, { ...project.print, date: new Date(0) });
  const hash = await crypto.subtle.digest('SHA-256', await blob.arrayBuffer());
  const gcode = Array.from(new Uint8Array(hash), (byte) => byte.toString(16).padStart(2, '0')).join('');
  return { digest: report.digest, gcode, bytes: blob.size };
}
