import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Unfit } from '../../src/model/check.js';
import { layersFrom } from '../../src/model/check-layers.js';
import { plateFrom } from '../../src/model/check-plate.js';
import { newPlate } from '../../src/model/defaults.js';
import { builtInFonts } from '../../src/model/fonts.js';
import { engineInput, sameToolpath, sectionsOf } from '../../src/model/input.js';
import { homeLight } from '../../src/model/lamp.js';
import { layerSettings } from '../../src/model/layer-settings.js';
import {
  changeLayer,
  duplicated,
  layerDefaults,
  layerKeys,
  layerKinds,
  layerOf,
  mostLayers,
  newLayer,
  raised,
  withLayer,
  withoutLayer,
  toldLayer,
} from '../../src/model/layer-list.js';
import {
  completeLayers,
  drawnLayers,
  lackOf,
  layerInput,
  sameLayers,
  type LayerKind,
  type LayerValues,
} from '../../src/model/layers.js';
import type { Plate, PlateLayer, SourceFile } from '../../src/model/plate.js';
import { accepts } from '../../src/model/settings.js';
import { without } from '../../src/model/without.js';
import { filesOf, plateData } from '../../src/files/plate-data.js';
import { chances, fileOf } from './support/pictures.js';

const file = fileOf('cat.png');
const other = fileOf('dog.png');
const held = fileOf('modes.png');
const font = fileOf('own.ttf');
const text = (given: Partial<LayerValues> = {}): LayerValues => newLayer(newPlate(), 'text', { text: 'A', ...given });
const plateOf = (...layers: LayerValues[]): Plate => layers.reduce(withLayer, newPlate());
const ids = ({ layers }: Plate): number[] => layers.map(({ id }) => id);

/** A file that was told by its name. */
const fileFrom = (told: unknown, where: string): SourceFile => {
  const found = [file, other, font].find(({ name }) => name === told);
  if (found === undefined) throw new Unfit(where, told);
  return found;
};

test('layers have ids of their own, which stay through every change of the list', () => {
  const plate = plateOf(text({ text: 'a' }), text({ text: 'b' }), text({ text: 'c' }));
  assert.deepEqual(ids(plate), [1, 2, 3]);
  assert.deepEqual(ids(raised(plate, 1, 1)), [2, 1, 3]);
  assert.deepEqual(ids(raised(plate, 1, 9)), [2, 3, 1]);
  assert.equal(raised(plate, 3, 1), plate);
  assert.equal(raised(plate, 7, 1), plate);
  const copied = duplicated(plate, 2, text({ text: 'b', at: [38, 32] }));
  assert.deepEqual(ids(copied), [1, 2, 4, 3]);
  assert.deepEqual(layerOf(copied, 4)?.at, [38, 32]);
  assert.deepEqual(ids(withoutLayer(copied, 2)), [1, 4, 3]);
  const moved = changeLayer(plate, 2, () => ({ at: [1, 2] }));
  assert.deepEqual(layerOf(moved, 2)?.at, [1, 2]);
  assert.equal(moved.layers[0], plate.layers[0]);
});

test('a plate has room for as many layers as the core takes', () => {
  let plate = newPlate();
  for (let k = 0; k < mostLayers + 3; ++k) plate = withLayer(plate, text());
  assert.equal(plate.layers.length, mostLayers);
});

test('what a layer lacks is told, and neither the engine nor a project gets such a layer', () => {
  const lacking: [LayerValues, string][] = [
    [newLayer(newPlate(), 'picture'), 'file'],
    [newLayer(newPlate(), 'map'), 'file'],
    [newLayer(newPlate(), 'drawing'), 'file'],
    [newLayer(newPlate(), 'tones'), 'file'],
    [newLayer(newPlate(), 'pattern', { pattern: 'echo' }), 'file'],
    [text({ text: '' }), 'text'],
    [newLayer(newPlate(), 'code', { text: '' }), 'text'],
    [text({ mask: 'inside' }), 'mask'],
  ];
  const plate = plateOf(...lacking.map(([layer]) => layer), text());
  lacking.forEach(([, lack], k) => {
    assert.equal(lackOf(plate.layers[k] as PlateLayer), lack);
  });
  assert.deepEqual(
    completeLayers(plate).map(({ id }) => id),
    [lacking.length + 1],
  );
  // The lowest is that of the directions.
  assert.equal(sectionsOf(plate, ({ name }) => name).layers.length, 2);
  assert.equal(sectionsOf(plateOf(text({ text: '' })), ({ name }) => name).layers.length, 1);
  const echo = newLayer(newPlate(), 'pattern', { pattern: 'echo', text: 'A' });
  assert.equal(lackOf({ ...echo, id: 1 }), undefined, 'an echo follows its letters');
});

test('the core is told what differs from its defaults, and nothing else', () => {
  const values = text({ font, at: [3, 4], angle: 0, textSize: 10, maskFile: file, mask: 'outside' });
  assert.deepEqual(
    toldLayer({ ...values, id: 5 }, ({ name }) => name),
    { kind: 'text', at: [3, 4], mask: 'outside', maskFile: 'cat.png', text: 'A', font: 'own.ttf' },
  );
  // An angle without a fill would be one.
  assert.deepEqual(
    toldLayer({ ...text({ angle: 30, textSize: 10 }), id: 5 }, () => 0),
    { kind: 'text', angle: 30, fill: 'across', text: 'A' },
  );
  assert.deepEqual(
    toldLayer({ ...layerDefaults(), id: 1 }, () => 0),
    { kind: 'direction' },
  );
});

test('a layer hands over what its kind has, and nothing else', () => {
  const given: Partial<LayerValues> = { file, lamp: [1, 2], others: [{ file: other, lamp: null }], modeFile: held };
  const keys = (kind: LayerKind): string[] =>
    Object.keys(layerInput({ ...newLayer(newPlate(), kind, given), id: 1 }, ({ name }) => name)).sort();
  const all = ['at', 'kind', 'mask', 'mirror', 'mode', 'modeFile', 'rotation', 'size', 'soft', 'visible'];
  const crop = ['cropMax', 'cropMin'];
  const letters = ['align', 'circle', 'font', 'text', 'textSize'];
  const own: Record<LayerKind, string[]> = {
    direction: ['angle'],
    map: ['encoding', 'file', ...crop],
    picture: ['pictures', ...crop],
    text: ['angle', 'fill', 'ground', ...letters],
    code: ['angle', 'correction', 'ground', 'text'],
    pattern: ['amplitude', 'angle', 'file', 'pattern', 'seed', 'waveLength', ...letters],
    tones: ['angle', 'by', 'colours', 'contrast', 'file', 'from', 'smoothing', 'threshold', 'to', ...crop],
    drawing: ['angle', 'file', 'fill', 'ground'],
    border: ['angle', 'fill', 'width'],
    strokes: ['strokes'],
  };
  for (const kind of layerKinds) assert.deepEqual(keys(kind), [...all, ...own[kind]].sort(), kind);
  const { pictures } = layerInput({ ...newLayer(newPlate(), 'picture', given), id: 1 }, ({ name }) => name);
  assert.deepEqual(pictures, [
    { file: 'cat.png', lamp: [1, 2] },
    { file: 'dog.png', lamp: null },
  ]);
});

test('layers make another toolpath where they are seen', () => {
  const plate = plateOf(text(), text({ visible: false }));
  const same = (other: Plate): boolean =>
    sameToolpath({ plate, raster: undefined }, { plate: other, raster: undefined });
  assert.ok(same({ ...plate }));
  assert.ok(same(changeLayer(plate, 2, () => ({ angle: 12 }))), 'a hidden one');
  assert.ok(!same(changeLayer(plate, 1, () => ({ angle: 12 }))));
  assert.ok(!same(changeLayer(plate, 2, () => ({ visible: true }))));
  assert.ok(
    !same(
      raised(
        changeLayer(plate, 2, () => ({ visible: true })),
        1,
        1,
      ),
    ),
  );
  assert.ok(sameLayers(newPlate(), newPlate()));
  assert.equal(drawnLayers(plate).length, 1);
});

test('the engine gets layers beside directions of every kind, and what pictures among them are solved for', () => {
  const over = plateOf(text());
  for (const directions of [newPlate().directions, { kind: 'angle' as const, angle: 3 }]) {
    const { input } = engineInput({ plate: { ...over, directions }, raster: undefined });
    assert.deepEqual(
      input.layers?.map(({ kind }) => kind),
      ['direction', 'text'],
    );
    assert.equal(input.pictures, undefined);
  }
  const pictured = plateOf(newLayer(newPlate(), 'picture', { file }));
  const { input } = engineInput({ plate: pictured, raster: undefined });
  assert.deepEqual(input.layers?.at(-1)?.pictures, [{ file: file.bytes, lamp: null }]);
  assert.ok(Array.isArray(input.pictures?.slopes));
  assert.deepEqual(homeLight(pictured, undefined), { azimuth: 60, elevation: 45 });
  assert.deepEqual(
    homeLight(
      changeLayer(pictured, 1, () => ({ lamp: [-30, 50] })),
      undefined,
    ),
    {
      azimuth: 330,
      elevation: 50,
    },
  );
});

test('files of layers are the plate’s, each once', () => {
  const pictured = newLayer(newPlate(), 'picture', { file, others: [{ file: other, lamp: null }] });
  const plate = plateOf(
    text({ font, maskFile: file }),
    pictured,
    newLayer(newPlate(), 'direction', { modeFile: held }),
  );
  assert.deepEqual(filesOf(plate), [file, font, other, held]);
});

test('every layer comes back from its data as it went', () => {
  const plate = plateOf(
    ...layerKinds.map((kind) => newLayer(newPlate(), kind, { file, visible: false, at: [1.5, -2], soft: 3 })),
    text({ font, maskFile: file, mask: 'inside', text: 'two\nlines', lamp: [-360, 1], ground: 12 }),
    ...builtInFonts.map((name) => text({ font: name })),
    newLayer(newPlate(), 'picture', {
      file,
      lamp: [10, 40],
      others: [
        { file: other, lamp: [20, 30] },
        { file, lamp: null },
      ],
    }),
    newLayer(newPlate(), 'map', { file, modeFile: other, mode: 'parallel' }),
    newLayer(newPlate(), 'tones', { file, by: 'colours', colours: [{ colour: '#00ff7f', angle: -45 }] }),
    newLayer(newPlate(), 'strokes', {
      strokes: [{ tool: 'mode', radius: 2, soft: 0, mode: 'smoothest', points: [0, 1] }],
    }),
  );
  const told = JSON.parse(JSON.stringify(plateData(plate, ({ name }) => name))) as unknown;
  assert.deepEqual(plateFrom(told, fileFrom), plate);
});

test('plates from before layers have none', () => {
  const before = without(plateData(newPlate(), () => 0) as Plate, 'layers');
  assert.deepEqual(plateFrom(before, fileFrom), newPlate());
});

test('layers without ids get some, beside those that have theirs', () => {
  const found = layersFrom([{ kind: 'border' }, { kind: 'border', id: 1 }, { kind: 'border' }]);
  assert.deepEqual(
    found.map(({ id }) => id),
    [2, 1, 3],
  );
});

test('what no control could have set is refused, with its place', () => {
  const bad: [unknown, string][] = [
    [{}, 'layers'],
    [Array.from({ length: mostLayers + 1 }, () => ({ kind: 'border' })), 'layers'],
    [[7], 'layers[0]'],
    [[{}], 'layers[0].kind'],
    [[{ kind: 'up' }], 'layers[0].kind'],
    [[{ kind: 'border', sparkle: 1 }], 'layers[0].sparkle'],
    [[{ kind: 'border', id: 0 }], 'layers[0].id'],
    [[{ kind: 'border', id: 1.5 }], 'layers[0].id'],
    [[{ kind: 'border', id: '1' }], 'layers[0].id'],
    [
      [
        { kind: 'border', id: 3 },
        { kind: 'border', id: 3 },
      ],
      'layers[1].id',
    ],
    [[{ kind: 'border', at: [1] }], 'layers[0].at'],
    [[{ kind: 'border', at: [1, Infinity] }], 'layers[0].at'],
    [[{ kind: 'border', size: null }], 'layers[0].size'],
    [[{ kind: 'border', size: [-1, 0] }], 'layers[0].size'],
    [[{ kind: 'border', angle: null }], 'layers[0].angle'],
    [[{ kind: 'border', visible: 1 }], 'layers[0].visible'],
    [[{ kind: 'text', text: 'x'.repeat(4097) }], 'layers[0].text'],
    [[{ kind: 'text', text: '\u0007' }], 'layers[0].text'],
    [[{ kind: 'text', font: 'Comic' }], 'layers[0].font'],
    [[{ kind: 'text', font: '../secret.ttf' }], 'layers[0].font'],
    [[{ kind: 'picture', file: 'gone.png' }], 'layers[0].file'],
    [[{ kind: 'picture', file: { id: 'a', name: 'b' } }], 'layers[0].file'],
    [[{ kind: 'picture', cropMin: [0.5, 0], cropMax: [0.5, 1] }], 'layers[0].cropMax'],
    [[{ kind: 'picture', lamp: [0, 0] }], 'layers[0].lamp'],
    [[{ kind: 'picture', lamp: [0, 91] }], 'layers[0].lamp'],
    [[{ kind: 'picture', lamp: [0, 45, 1] }], 'layers[0].lamp'],
    [[{ kind: 'picture', lamp: [NaN, 45] }], 'layers[0].lamp'],
    [[{ kind: 'picture', others: {} }], 'layers[0].others'],
    [[{ kind: 'picture', others: Array(4).fill({ file: 'cat.png', lamp: null }) }], 'layers[0].others'],
    [[{ kind: 'picture', others: [{ file: 'gone.png', lamp: null }] }], 'layers[0].others[0].file'],
    [[{ kind: 'picture', others: [{ file: 'cat.png', lamp: [0, 0] }] }], 'layers[0].others[0].lamp'],
    [[{ kind: 'picture', others: [{ file: 'cat.png', lamp: null, more: 1 }] }], 'layers[0].others[0].more'],
    [[{ kind: 'map', modeFile: 'gone.png' }], 'layers[0].modeFile'],
    [[{ kind: 'map', mode: 'up' }], 'layers[0].mode'],
    [[{ kind: 'pattern', pattern: 'noise', seed: -1 }], 'layers[0].seed'],
    [[{ kind: 'pattern', pattern: 'noise', seed: 1.5 }], 'layers[0].seed'],
    [[{ kind: 'tones', by: 'taste' }], 'layers[0].by'],
    [[{ kind: 'tones', threshold: 2 }], 'layers[0].threshold'],
    [[{ kind: 'tones', colours: 'red' }], 'layers[0].colours'],
    [[{ kind: 'tones', colours: Array(33).fill({ colour: '#ff0000', angle: 1 }) }], 'layers[0].colours'],
    [[{ kind: 'tones', colours: [7] }], 'layers[0].colours[0]'],
    [[{ kind: 'tones', colours: [{ colour: 'red', angle: 1 }] }], 'layers[0].colours[0].colour'],
    [[{ kind: 'tones', colours: [{ colour: '#ff0000;url(x)' }] }], 'layers[0].colours[0].colour'],
    [[{ kind: 'tones', colours: [{ colour: '#ff0000', angle: 361 }] }], 'layers[0].colours[0].angle'],
    [[{ kind: 'tones', colours: [{ colour: '#ff0000', sparkle: 1 }] }], 'layers[0].colours[0].sparkle'],
    [[{ kind: 'strokes', strokes: {} }], 'layers[0].strokes'],
    [[{ kind: 'strokes', strokes: Array(10_001).fill({ points: [] }) }], 'layers[0].strokes'],
    [[{ kind: 'strokes', strokes: [null] }], 'layers[0].strokes[0]'],
    [[{ kind: 'strokes', strokes: [{}] }], 'layers[0].strokes[0].points'],
    [[{ kind: 'strokes', strokes: [{ points: [1, 2, 3] }] }], 'layers[0].strokes[0].points'],
    [[{ kind: 'strokes', strokes: [{ points: [1, '2'] }] }], 'layers[0].strokes[0].points'],
    [[{ kind: 'strokes', strokes: [{ points: [1, Infinity] }] }], 'layers[0].strokes[0].points'],
    [[{ kind: 'strokes', strokes: [{ points: [1, 10_001] }] }], 'layers[0].strokes[0].points'],
    [[{ kind: 'strokes', strokes: [{ tool: 'axe', points: [] }] }], 'layers[0].strokes[0].tool'],
    [[{ kind: 'strokes', strokes: [{ radius: 0, points: [] }] }], 'layers[0].strokes[0].radius'],
    [[{ kind: 'strokes', strokes: [{ soft: 1.1, points: [] }] }], 'layers[0].strokes[0].soft'],
    [[{ kind: 'strokes', strokes: [{ mode: 'up', points: [] }] }], 'layers[0].strokes[0].mode'],
    [[{ kind: 'strokes', strokes: [{ softness: 1, points: [] }] }], 'layers[0].strokes[0].softness'],
    // Each stroke may be long, all together may not.
    [[{ kind: 'strokes', strokes: Array(3).fill({ points: Array(200_000).fill(1) }) }], 'layers[0].strokes[2].points'],
    [[{ kind: 'text', textSize: 0 }], 'layers[0].textSize'],
    [[JSON.parse('{"kind":"border","__proto__":{"width":3}}')], 'layers[0].__proto__'],
  ];
  for (const [layers, where] of bad) {
    assert.throws(
      () => layersFrom(layers, fileFrom),
      (error) => error instanceof Unfit && error.where === where,
      `${where}: ${JSON.stringify(layers).slice(0, 80)}`,
    );
  }
  assert.throws(() => layersFrom([{ kind: 'picture', file: 'cat.png' }]), Unfit); // no files are allowed
});

test('whatever comes becomes layers that every control could have set, or is refused', () => {
  const chance = chances(7);
  const values = [null, 0, -1, 1e9, 'x', '', true, [], [0, 0], [1, 1], {}, 'cat.png', 'own.ttf', 'text', 'page', NaN];
  let [taken, refused] = [0, 0];
  for (let k = 0; k < 3000; ++k) {
    const layer: Record<string, unknown> = { kind: layerKinds[Math.floor(chance() * layerKinds.length)] };
    for (const key of layerKeys) {
      if (chance() < 0.05) layer[key] = values[Math.floor(chance() * values.length)];
    }
    try {
      const [found] = layersFrom([layer], fileFrom);
      assert.ok(found !== undefined);
      for (const setting of layerSettings) {
        if (['file', 'maskFile', 'modeFile', 'font'].includes(setting.key)) continue;
        assert.ok(accepts(setting, found[setting.key as 'angle']), `${setting.key} of ${JSON.stringify(layer)}`);
      }
      ++taken;
    } catch (error) {
      if (!(error instanceof Unfit)) throw error;
      ++refused;
    }
  }
  assert.ok(taken > 300 && refused > 300, `${taken} taken, ${refused} refused`);
});
