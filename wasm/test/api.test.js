// What the calls give, and that it is the same with any number of threads.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, describe, test } from 'node:test';
import { Worker } from 'node:worker_threads';

import { createEngine } from 'sillon';

import { buffersIn, small, turning } from './support/jobs.js';
import { png } from './support/png.js';

const date = new Date('2026-11-21T07:30:00.999Z');
const svg =
  '<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="10mm" viewBox="0 0 20 10"><path d="M1 1h18v8h-18z"/></svg>';
const engines = [];
let st;

before(async () => {
  for (const threads of [1, 2, 4]) engines.push(await createEngine({ threads }));
  st = engines[0];
});
after(() => {
  for (const engine of engines) engine.dispose();
});

const bytesOf = async (blob) => Buffer.from(await blob.arrayBuffer());

describe('results', () => {
  test('info tells what was started', () => {
    assert.deepEqual(
      engines.map(({ info }) => info),
      [
        { version: st.info.version, variant: 'st', threads: 1, reason: '', reasonCode: '' },
        { version: st.info.version, variant: 'mt', threads: 2, reason: '', reasonCode: '' },
        { version: st.info.version, variant: 'mt', threads: 4, reason: '', reasonCode: '' },
      ],
    );
    assert.match(st.info.version, /^\d+\.\d+\.\d+/);
  });

  test('a warm engine makes the same plates, and gives nothing for being warmed', async () => {
    const input = { shape: { builtin: 'disc', size: [9, 9] }, layers: [{ kind: 'direction', angle: 20 }] };
    const engine = await createEngine({ threads: 'off' });
    assert.equal(await engine.warm(), undefined);
    const { toolpath } = await engine.generateToolpath(input, { spacing: 0.5 });
    assert.deepEqual(toolpath, (await st.generateToolpath(input, { spacing: 0.5 })).toolpath);
    await assert.rejects(engine.warm({ signal: AbortSignal.abort() }), { name: 'AbortError' });
    engine.dispose();
  });

  test('a plate is plain data with a report', async () => {
    const input = { shape: { file: svg }, layers: [{ kind: 'direction', angle: 20 }] };
    const { toolpath, report } = await st.generateToolpath(input, { spacing: 0.5 });
    assert.equal(toolpath.spacing, 0.5);
    assert.deepEqual(Object.keys(toolpath).sort(), ['cycles', 'notes', 'shape', 'spacing']);
    assert.equal(toolpath.cycles.length, report.toolpaths);
    let points = 0;
    for (const cycle of toolpath.cycles) {
      assert.ok(cycle.points instanceof Float32Array && cycle.widths instanceof Float32Array);
      assert.ok(cycle.points.buffer instanceof ArrayBuffer && cycle.widths.buffer instanceof ArrayBuffer);
      assert.equal(cycle.points.length, 2 * cycle.widths.length);
      assert.ok(cycle.widths.every((width) => width > 0 && width < 2));
      for (let k = 0; k < cycle.points.length; k += 2) {
        assert.ok(
          cycle.points[k] >= 1 && cycle.points[k] <= 19 && cycle.points[k + 1] >= 1 && cycle.points[k + 1] <= 9,
        );
      }
      points += cycle.widths.length;
    }
    assert.equal(points, report.points);
    assert.deepEqual(toolpath.shape.page, [20, 10]);
    assert.ok(toolpath.notes.length > 0 && toolpath.notes.every((note) => typeof note === 'string'));

    assert.match(report.digest, /^[0-9a-f]{16}$/);
    assert.equal(report.version, st.info.version);
    assert.equal(report.spacing, 0.5);
    assert.equal(report.parts, 1);
    assert.equal(report.threads, 1);
    assert.ok(report.peakBytes >= 2 ** 24 && report.peakBytes < 2 ** 31);
    assert.ok(report.time.total > 0);
    assert.ok(report.coverage > 90 && report.coverage <= 100);
    assert.ok(report.alignment < -0.8 && report.alignment >= -1);
    assert.ok(report.width.p01 <= report.width.median && report.width.median <= report.width.p99);
  });

  test('without measure the report has no measures', async () => {
    const { report } = await st.generateToolpath(...small);
    assert.equal(report.coverage, undefined);
    assert.equal(report.width, undefined);
    assert.match(report.digest, /^[0-9a-f]{16}$/);
  });

  test('every number of threads gives the same plate, G-code, drawing and preview', async () => {
    const input = {
      shape: { builtin: 'rounded', size: [24, 18], radius: 4 },
      layers: [{ kind: 'map', file: turning(64, 48) }],
    };
    const all = [];
    for (const engine of engines) {
      const { toolpath, report } = await engine.generateToolpath(input, { spacing: 0.5 });
      assert.equal(report.threads, engine.info.threads);
      const { blob, summary } = await engine.writeGcode(toolpath, {}, { date });
      const look = await engine.renderPreview(toolpath, { width: 300 });
      const drawing = await engine.writeSvg(toolpath);
      const view = await engine.writeView(toolpath);
      all.push({
        toolpath,
        digest: report.digest,
        summary,
        files: [await bytesOf(blob), await bytesOf(look), await bytesOf(drawing), await bytesOf(view)],
      });
    }
    assert.deepEqual(all[1], all[0]);
    assert.deepEqual(all[2], all[0]);
  });

  test('G-code in one blob is what comes in pieces, and both are what the summary says', async () => {
    const { toolpath } = await st.generateToolpath({ shape: { builtin: 'disc', size: [40, 40] } });
    const whole = await st.writeGcode(toolpath, {}, { date, layers: 3 });
    const pieces = [];
    const inPieces = await st.writeGcode(toolpath, {}, { date, layers: 3 }, { onChunk: (piece) => pieces.push(piece) });
    assert.equal(whole.blob.type, 'text/x-gcode');
    assert.equal(whole.blob.size, whole.summary.bytes);
    assert.equal(inPieces.blob.size, 0);
    assert.ok(pieces.length > 1 && pieces.every((piece) => piece instanceof Uint8Array));
    assert.ok(Buffer.concat(pieces).equals(await bytesOf(whole.blob)));
    assert.deepEqual(inPieces.summary, whole.summary);
    const text = await whole.blob.text();
    assert.ok(text.split('\n', 1)[0].includes('2026-11-21 at 07:30:00 UTC'), text.split('\n', 1)[0]);
    for (const note of toolpath.notes) assert.ok(text.includes(note), note);
    for (const key of ['filamentMm', 'filamentCm3', 'filamentGrams', 'seconds', 'moves'])
      assert.ok(whole.summary[key] > 0);
    for (const { code, values, message } of whole.summary.warnings) {
      assert.match(code, /^[A-Z][A-Za-z]+$/);
      assert.equal(typeof values, 'object');
      assert.doesNotMatch(message, /[{}]/, code);
    }
  });

  test('printer and print parameters reach the G-code', async () => {
    const { toolpath } = await st.generateToolpath(...small);
    const { blob } = await st.writeGcode(
      toolpath,
      { flavor: 'klipper', nozzleTemperature: 233, setPressureAdvance: true },
      { place: [7, 9] },
    );
    const text = await blob.text();
    assert.ok(/^M109 S220$/m.test(text) && /^M104 S233$/m.test(text));
    assert.ok(/^SET_PRESSURE_ADVANCE /m.test(text));
  });

  test('presets, imported printers and checked G-code are what the command line has', async () => {
    const { printers, filaments } = await st.profiles();
    assert.deepEqual(
      filaments.map(({ id }) => id),
      ['petg', 'pla', 'pla-silk'],
    );
    const mini = printers.find(({ id }) => id === 'prusa-mini').printer;
    assert.deepEqual([mini.bedMax, mini.flavor, mini.retractLength], [[180, 180], 'prusa', 2.5]);
    const { toolpath } = await st.generateToolpath(...small);
    const { blob } = await st.writeGcode(toolpath, { profile: 'prusa-mini', filament: 'petg' }, { copies: [2, 1] });
    assert.match(await blob.text(), /^M862\.3 P "MINI"$/m);
    const check = await st.checkGcode(blob, { profile: 'prusa-mini' });
    assert.deepEqual([check.errors, check.printer], [0, 'MINI']);
    assert.ok(check.layers > 0 && check.layers % 2 === 0 && check.filamentMm > 0);
    const bad = await st.checkGcode(Buffer.from('G1 X1e3\n'));
    assert.ok(bad.errors > 0 && bad.findings[0].error && bad.findings[0].line === 1);
    const examined = await st.examineBlock('G28\nM997\nMY_MACRO\n', 'klipper');
    assert.deepEqual(
      examined.map(({ code, rule, error, line, values }) => [code, rule, error, line, values.command]),
      [
        ['never', 'commands', true, 2, 'M997'],
        ['macro', 'commands', false, 3, 'MY_MACRO'],
      ],
    );
    const imported = await st.importPrinter(blob);
    assert.equal(imported.source, 'donor G-code');
    assert.ok(imported.printer.startGcode.includes('M862.3 P "MINI"'));
    assert.ok(imported.read.length > 5 && imported.notRead.length > 0);
    const ini = Buffer.from('[printer:A]\nnozzle_diameter = 0.6\n[printer:B]\nnozzle_diameter = 0.8\n');
    assert.equal((await st.importPrinter(ini, 'A')).printer.nozzle, 0.6);
  });

  test('lines that no block of a print may have are errors, whatever its dialect', async () => {
    const list = JSON.parse(readFileSync(new URL('../../tests/data/hostile_lines.json', import.meta.url), 'utf8'));
    const silent = [];
    for (const lines of list.kinds.flatMap((kind) => kind.lines)) {
      for (const flavor of ['marlin', 'bambu']) {
        const findings = await engines[1].examineBlock(`G28\nG1 Z10 F600\n${lines}\nG1 Z5\n`, flavor);
        if (!findings.some(({ error }) => error)) silent.push(lines);
      }
    }
    assert.deepEqual(silent, []);
  });

  test('drawing and preview are files of their kinds', async () => {
    const { toolpath } = await st.generateToolpath(...small);
    const drawing = await st.writeSvg(toolpath);
    assert.equal(drawing.type, 'image/svg+xml');
    assert.ok(/^<svg [^]*<\/svg>\n$/.test(await drawing.text()));
    const preview = await st.renderPreview(toolpath, { width: 100, lightElevation: 50 });
    assert.equal(preview.type, 'image/png');
    const picture = await st.decodePicture(preview);
    assert.equal(picture.channels, 3);
    assert.ok(picture.width === 100 || picture.width === 200, `${picture.width} pixels`);
  });

  test('a view tells the plate’s look', async () => {
    const { toolpath } = await st.generateToolpath(...small);
    const view = await st.writeView(toolpath, { colour: [24, 78, 168], slopes: [2.36, 17.32] });
    assert.equal(view.type, 'image/png');
    assert.match(Buffer.from(await view.arrayBuffer()).toString('latin1'), /colour 24 78 168 slopes 236 1732/);
    await assert.rejects(st.writeView(toolpath, { colour: [0, 0, 256] }), /colour is .*three whole numbers/);
    await assert.rejects(st.writeView(toolpath, { slopes: [0, 10] }), /0\.1 to 45/);
  });

  test('a base body is 3MF unless it is asked for as STL, and as high as the base layers', async () => {
    const shape = await st.readShape({ builtin: 'rectangle', size: [20, 10] });
    const print = { base: 3, layerHeight: 0.25, startHeight: 2, date: new Date(NaN) };
    const solid = await st.writeBaseBody(shape, {}, print);
    assert.equal(solid.type, 'model/3mf');
    assert.equal((await bytesOf(solid)).toString('latin1', 0, 4), 'PK\x03\x04');
    const stl = await bytesOf(await st.writeBaseBody(shape, {}, print, { format: 'stl' }));
    const count = stl.readUInt32LE(80);
    assert.equal(count, 12);
    assert.equal(stl.length, 84 + 50 * count);
    const heights = new Set();
    for (let k = 0; k < count; ++k) {
      for (let corner = 1; corner <= 3; ++corner) heights.add(stl.readFloatLE(84 + 50 * k + 12 * corner + 8));
    }
    assert.deepEqual([...heights].sort(), [2, 2.75]);
  });

  test('a shape is polygons', async () => {
    const shape = await st.readShape({ file: svg });
    assert.deepEqual(shape, {
      page: [20, 10],
      paths: [{ fillRule: 'nonzero', rings: [Float64Array.of(1, 9, 19, 9, 19, 1, 1, 1)] }],
      texts: 0,
      otherFont: false,
      images: 0,
      offPage: 0,
      unpainted: false,
    });
    const flowing = '<flowRoot>a</flowRoot>';
    const { texts, images } = await st.readShape({ file: svg.replace('</svg>', `${flowing}${flowing}<image/></svg>`) });
    assert.deepEqual([texts, images], [2, 1]);
    const lines = svg.replace(/<(path|rect|polygon)/, '<$1 fill="none"');
    assert.notEqual(lines, svg);
    assert.equal((await st.readShape({ file: lines })).unpainted, true);
    assert.deepEqual((await st.readShape({ file: svg, pageWidth: 40 })).page, [40, 20]);
    const like = await st.readShape({ builtin: 'rectangle', size: [30, 0] }, [{ kind: 'map', file: turning(40, 20) }]);
    assert.deepEqual(like.page, [30, 15]);
    const mask = await st.readShape({ file: png(4, 2, 1, new Uint8Array(8).fill(255)), pageWidth: 8 });
    assert.deepEqual(mask.page, [8, 4]);
  });

  test('a picture keeps its values', async () => {
    const samples = Uint8Array.of(0, 128, 255, 1, 2, 3, 4, 5, 6, 7, 8, 9);
    for (const [width, channels] of [
      [6, 1],
      [3, 2],
      [2, 3],
    ]) {
      const picture = await st.decodePicture(png(width, 2, channels, samples));
      assert.deepEqual(picture, { width, height: 2, channels, samples: Uint16Array.from(samples, (v) => v * 257) });
    }
  });

  test('a picture is solved for its lamp, and the plate is drawn under it', async () => {
    // Light on the left, dark on the right.
    const halves = { width: 2, height: 1, channels: 1, samples: Uint8Array.of(230, 40) };
    const shape = { builtin: 'rectangle', size: [24, 12] };
    const seen = async (pictures) => {
      const layers = [{ kind: 'picture', pictures }];
      const { toolpath, report } = await st.generateToolpath({ shape, layers, pictures: { spool: 'clearPetg' } });
      return { toolpath, look: toolpath.look, picture: report.pictures[0] };
    };
    const given = await seen([{ file: halves, lamp: [200, 50] }]);
    assert.deepEqual(given.look.lamps, [[200, 50]]);
    assert.deepEqual(given.look.slopes, [0.88, 11.63]);
    assert.deepEqual([given.picture.lamp, given.picture.from], [[200, 50], 'toolpath']);
    assert.ok(given.picture.r > 0.9, given.picture.r);
    const chosen = await seen([{ file: halves }]);
    assert.notDeepEqual(chosen.look.lamps, given.look.lamps);
    const plain = await st.generateToolpath({ shape });
    assert.equal(plain.toolpath.look, undefined);
    assert.equal(plain.report.pictures, undefined);
    assert.equal(plain.conflict, undefined);

    // The look decides what the pictures in the file show; the beads stay the same.
    const date = new Date(0);
    const text = async (toolpath) => (await st.writeGcode(toolpath, {}, { date })).blob.text();
    const [under, above] = [await text(given.toolpath), await text({ ...given.toolpath, look: undefined })];
    const beads = (file) => file.split('\n').filter((line) => line.startsWith('G1'));
    assert.notEqual(under, above);
    assert.deepEqual(beads(under), beads(above));
    await assert.rejects(
      st.writeGcode({ ...given.toolpath, look: { ...given.look, lamps: [] } }),
      /look\.lamps is empty/,
    );
  });

  test('the nozzle and the side that is seen give pictures their slopes', async () => {
    const picture = { width: 2, height: 1, channels: 1, samples: Uint8Array.of(230, 40) };
    const slopes = async (others) => {
      const shape = { builtin: 'rectangle', size: [24, 12] };
      const layers = [{ kind: 'picture', pictures: [{ file: picture, lamp: [60, 45] }] }];
      const pictures = { spool: 'redPetg', ...others.pictures };
      const { toolpath } = await st.generateToolpath({ shape, layers, ...others, pictures }, { spacing: 0.8 });
      return toolpath.look.slopes;
    };
    assert.deepEqual(await slopes({}), [6.2, 12.98]);
    assert.deepEqual(await slopes({ printer: { nozzle: 0.8 } }), [1.36, 4.6]);
    assert.deepEqual(
      await slopes({ printer: { nozzle: 0.8 }, print: { showSide: 'bed', date: new Date(0) } }),
      [2.23, 21.29],
    );
    assert.deepEqual(await slopes({ printer: { nozzle: 0.8 }, pictures: { slopes: [3, 12] } }), [3, 12]);
  });

  test('pictures that contradict each other under one lamp take half of their tones from each other', async () => {
    const one = (tone) => ({ width: 2, height: 1, channels: 1, samples: Uint8Array.of(tone, 255 - tone) });
    const shape = { builtin: 'rectangle', size: [12, 6] };
    const pictures = [0, 255].map((tone) => ({ file: one(tone), lamp: [60, 45] }));
    const { conflict } = await st.generateToolpath({ shape, layers: [{ kind: 'picture', pictures }] });
    assert.deepEqual([conflict.width, conflict.height], [60, 30]);
    const middle = 15 * 60 + 10; // black in the first picture, white in the second
    assert.ok(conflict.missing.every((cells) => cells instanceof Int8Array && cells.length === 60 * 30));
    const [first, second] = conflict.missing.map((cells) => cells[middle]);
    assert.ok(Math.abs(first + 50) < 8 && Math.abs(second - 50) < 8, `${first}, ${second}`);
  });

  test('projects are completed, written and read back', async () => {
    const project = await st.readProject(
      '{ "sillon": 1, "shape": { "file": "leaf.svg" }, "toolpath": { "spacing": 0.45 } }',
    );
    assert.equal(project.shape.file, 'leaf.svg');
    assert.equal(project.toolpath.spacing, 0.45);
    assert.equal(project.toolpath.bridge, null);
    assert.deepEqual(project.printer.bedMax, [220, 220]);
    const text = await st.writeProject({ ...project, print: { layers: 4 } });
    const again = await st.readProject(text);
    assert.deepEqual(again, { ...project, print: { ...project.print, layers: 4 } });
    assert.equal(await st.writeProject(again), text);
    const scene = await st.readProject('{ "nozzle_width": 0.6, "svg_path": "a.svg", "seed": 3 }');
    assert.equal(scene.toolpath.spacing, 0.6);
    assert.equal(scene.shape.unitless, 'mm');
  });

  test('results can be cloned and their buffers transferred', async () => {
    const plate = await st.generateToolpath({ shape: { file: svg } });
    const picture = await st.decodePicture(png(2, 2, 1, Uint8Array.of(1, 2, 3, 4)));
    const expected = structuredClone([plate, picture]);
    const transfer = buffersIn([plate, picture]);
    assert.ok(transfer.length > 3);
    assert.deepEqual(structuredClone([plate, picture], { transfer }), expected);
    assert.ok(transfer.every(({ byteLength }) => byteLength === 0));
  });
});

describe('inputs', () => {
  const picture = turning(32, 16);
  const file = png(32, 16, 1, picture.samples);
  const digestOf = async (input) => (await st.generateToolpath(input, {}, { measure: false })).report.digest;

  test('bytes are taken from every kind of holder, which stays as it was', async () => {
    const padded = new Uint8Array(file.length + 10);
    padded.set(file, 5);
    const shared = new SharedArrayBuffer(file.length);
    new Uint8Array(shared).set(file);
    const holders = {
      Buffer: file,
      ArrayBuffer: Uint8Array.from(file).buffer,
      'view with an offset': padded.subarray(5, 5 + file.length),
      DataView: new DataView(padded.buffer, 5, file.length),
      SharedArrayBuffer: shared,
      Blob: new Blob([file]),
      'Picture, 8 bits': picture,
      'Picture, clamped': { ...picture, samples: Uint8ClampedArray.from(picture.samples) },
      'Picture, 16 bits': turning(32, 16, Uint16Array, 257),
      'Picture in a Buffer': { ...picture, samples: Buffer.from(picture.samples) },
    };
    const before = structuredClone(holders);
    const digests = {};
    for (const [name, holder] of Object.entries(holders)) {
      digests[name] = await digestOf({ shape: { size: [8, 4] }, layers: [{ kind: 'map', file: holder }] });
    }
    assert.deepEqual([...new Set(Object.values(digests))].length, 1, JSON.stringify(digests));
    const { Blob: _, ...after } = structuredClone(holders);
    const { Blob: __, ...expected } = before;
    assert.deepEqual(after, expected);
  });

  test('SVG is taken as text and as bytes', async () => {
    const digests = [svg, `\uFEFF  ${svg}`, Buffer.from(svg), new Blob([svg])].map((file) =>
      digestOf({ shape: { file } }),
    );
    assert.equal(new Set(await Promise.all(digests)).size, 1);
  });

  test('what is changed after the call does not reach it', async () => {
    const samples = Uint8Array.from(picture.samples);
    const input = {
      shape: { builtin: 'disc', size: [9, 9] },
      layers: [{ kind: 'map', file: { ...picture, samples } }],
    };
    const expected = await digestOf(input);
    const params = { spacing: 0.4 };
    const pending = st.generateToolpath(input, params, { measure: false });
    samples.fill(200);
    input.shape.size[0] = 30;
    params.spacing = 3;
    assert.equal((await pending).report.digest, expected);

    const { toolpath } = await st.generateToolpath(input, {}, { measure: false });
    const drawing = await (await st.writeSvg(toolpath)).text();
    const drawn = st.writeSvg(toolpath);
    toolpath.cycles[0].points.fill(0);
    assert.equal(await (await drawn).text(), drawing);
  });

  test('without a shape the plate has the proportions of the direction picture', async () => {
    const { toolpath } = await st.generateToolpath({ layers: [{ kind: 'map', file: turning(32, 8) }] }, { spacing: 1 });
    assert.deepEqual(toolpath.shape.page, [80, 20]);
  });

  test('fields that are undefined are left out', async () => {
    const plain = await digestOf({ shape: { builtin: 'disc', size: [9, 9] } });
    const input = { shape: { builtin: 'disc', size: [9, 9], radius: undefined }, layers: undefined };
    const { report } = await st.generateToolpath(input, { seed: undefined }, { measure: false, signal: undefined });
    assert.equal(report.digest, plain);
  });
});

test('the package works in a thread of Node', { timeout: 300_000 }, async () => {
  const worker = new Worker(new URL('./support/thread.js', import.meta.url));
  const inThread = await new Promise((resolve, reject) => {
    worker.on('message', resolve);
    worker.on('error', reject);
  });
  const { report } = await st.generateToolpath(...small);
  assert.deepEqual(inThread, [
    { variant: 'st', digest: report.digest },
    { variant: 'mt', digest: report.digest },
  ]);
});
