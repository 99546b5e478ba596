import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { createEngine, type Engine } from 'sillon';
import { builtInFonts } from '../../src/model/fonts.js';
import { engineInput, sectionsOf } from '../../src/model/input.js';
import { homeLight } from '../../src/model/lamp.js';
import { layerSettings } from '../../src/model/layer-settings.js';
import {
  changeLayer,
  duplicated,
  filesOfLayer,
  layerDefaults,
  layerKeys,
  layerKinds,
  layerOf,
  mostLayers,
  newLayer,
  projectLayer,
  raised,
  withLayer,
  withoutLayer,
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
import { newPlate } from '../../src/model/new-plate.js';
import type { Plate, PlateLayer } from '../../src/model/plate.js';
import { sameToolpath } from '../../src/model/result.js';
import { accepts } from '../../src/model/settings.js';
import { filesOf } from '../../src/files/plate-project.js';
import { chances, fileOf } from './support/pictures.js';

let engine: Engine;
before(async () => {
  engine = await createEngine({ threads: 'off' });
});
after(() => {
  engine.dispose();
});

const file = fileOf('cat.png');
const other = fileOf('dog.png');
const held = fileOf('modes.png');
const font = fileOf('own.ttf');
const text = (given: Partial<LayerValues> = {}): LayerValues => newLayer(newPlate(), 'text', { text: 'A', ...given });
/** With nothing but these layers. */
const plateOf = (...layers: LayerValues[]): Plate => layers.reduce(withLayer, { ...newPlate(), layers: [] });
const ids = ({ layers }: Plate): number[] => layers.map(({ id }) => id);

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
  assert.equal(sectionsOf(plate, ({ name }) => name).layers.length, 1);
  assert.deepEqual(sectionsOf(plateOf(text({ text: '' })), ({ name }) => name).layers, []);
  const whole: LayerValues[] = [
    newLayer(newPlate(), 'pattern', { pattern: 'echo', text: 'A' }), // it follows its letters
    newLayer(newPlate(), 'pattern', { pattern: 'waves' }),
    newLayer(newPlate(), 'picture', { pictures: [{ file, lamp: null }] }),
    newLayer(newPlate(), 'strokes'),
    text({ mask: 'outside', maskFile: file }),
  ];
  for (const layer of whole) assert.equal(lackOf({ ...layer, id: 1 }), undefined, layer.kind);
});

test('the core is told what differs from its defaults, and nothing else', () => {
  const values = text({ font, at: [3, 4], angle: 0, textSize: 10, maskFile: file, mask: 'outside' });
  assert.deepEqual(
    projectLayer({ ...values, id: 5 }, ({ name }) => name),
    { kind: 'text', at: [3, 4], mask: 'outside', maskFile: 'cat.png', text: 'A', font: 'own.ttf' },
  );
  // An angle without a fill would be one.
  assert.deepEqual(
    projectLayer({ ...text({ angle: 30, textSize: 10 }), id: 5 }, () => 0),
    { kind: 'text', angle: 30, fill: 'across', text: 'A' },
  );
  assert.deepEqual(
    projectLayer({ ...layerDefaults(), id: 1 }, () => 0),
    { kind: 'direction' },
  );
});

test('a layer hands over what its kind has, and nothing else', () => {
  const pictures = [
    { file, lamp: [1, 2] },
    { file: other, lamp: null },
  ] as const;
  const given: Partial<LayerValues> = { file, pictures, modeFile: held };
  const keys = (kind: LayerKind): string[] =>
    Object.keys(layerInput({ ...newLayer(newPlate(), kind, given), id: 1 }, ({ name }) => name)).sort();
  const all = ['at', 'kind', 'mask', 'mirror', 'mode', 'modeFile', 'rotation', 'size', 'soft', 'visible'];
  const crop = ['cropMax', 'cropMin'];
  const letters = ['align', 'circle', 'font', 'text', 'textSize', 'weight'];
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
  const told = layerInput({ ...newLayer(newPlate(), 'picture', given), id: 1 }, ({ name }) => name);
  assert.deepEqual(told.pictures, [
    { file: 'cat.png', lamp: [1, 2] },
    { file: 'dog.png', lamp: null },
  ]);
});

test('layers make another toolpath where they are seen', () => {
  const plate = plateOf(text(), text({ visible: false }), newLayer(newPlate(), 'picture'));
  const changed = (id: number, change: Partial<LayerValues>): Plate => changeLayer(plate, id, () => change);
  const same = (other: Plate): boolean => sameToolpath(plate, other);
  assert.ok(same({ ...plate }));
  assert.ok(same({ ...plate, layers: [...plate.layers] }));
  assert.ok(same(changed(2, { angle: 12 })), 'a hidden one');
  assert.ok(same(changed(3, { rotation: 12 })), 'one that lacks its picture');
  assert.ok(!same(changed(1, { angle: 12 })));
  assert.ok(!same(changed(2, { visible: true })));
  assert.ok(!same(changed(3, { pictures: [{ file, lamp: null }] })));
  const shown = changed(2, { visible: true });
  assert.ok(!sameToolpath(shown, raised(shown, 1, 1)), 'another order');
  assert.ok(sameLayers(plateOf(), plateOf()));
  assert.equal(drawnLayers(plate).length, 1);
});

test('the engine gets the layers from the lowest up, and what pictures among them are solved for', () => {
  const { input } = engineInput(plateOf(newLayer(newPlate(), 'pattern'), text(), newLayer(newPlate(), 'border')));
  assert.deepEqual(
    input.layers?.map(({ kind }) => kind),
    ['pattern', 'text', 'border'],
  );
  assert.equal(input.pictures, undefined);
  const picture = newLayer(newPlate(), 'picture', { pictures: [{ file, lamp: null }] });
  const pictured = plateOf(text(), picture);
  const lit = engineInput(pictured).input;
  assert.deepEqual(lit.layers?.[1]?.pictures, [{ file: file.bytes, lamp: null }]);
  assert.ok(Array.isArray(lit.pictures?.slopes));
  assert.equal(engineInput(plateOf(text(), { ...picture, visible: false })).input.pictures, undefined);
  assert.deepEqual(homeLight(pictured, undefined), { azimuth: 60, elevation: 45 });
  const turned = changeLayer(pictured, 2, () => ({ pictures: [{ file, lamp: [-30, 50] }] }));
  assert.deepEqual(homeLight(turned, undefined), { azimuth: 330, elevation: 50 });
});

test('files of layers are the plate’s, each once', () => {
  const pictures = [file, other, file].map((one) => ({ file: one, lamp: null }));
  const plate = plateOf(
    text({ font, maskFile: file }),
    newLayer(newPlate(), 'picture', { pictures }),
    newLayer(newPlate(), 'direction', { modeFile: held }),
  );
  assert.deepEqual(plate.layers.map(filesOfLayer), [[file, font], [file, other, file], [held]]);
  assert.deepEqual(filesOf(plate), [file, font, other, held]);
});

test('every font that the studio lists is the engine’s', async () => {
  for (const name of builtInFonts) {
    const layers = [{ kind: 'text' as const, text: 'A', font: name }];
    const [box] = await engine.placeLayers({ shape: { builtin: 'disc', size: [40, 40] }, layers });
    assert.equal(box?.problem, undefined, name);
  }
});

test('whatever comes becomes layers that every control could have set, or is refused', async () => {
  const chance = chances(7);
  const values = [null, 0, -1, 1e9, 'x', '', true, [], [0, 0], [1, 1], {}, 'cat.png', 'own.ttf', 'text', 'page'];
  let [taken, refused] = [0, 0];
  for (let k = 0; k < 1500; ++k) {
    const kind = layerKinds[Math.floor(chance() * layerKinds.length)] as LayerKind;
    const layer: Record<string, unknown> = {
      ...projectLayer(
        { ...newLayer(newPlate(), kind, { file, text: 'A', pictures: [{ file, lamp: null }] }), id: 1 },
        () => 'a',
      ),
    };
    for (const key of layerKeys) {
      if (chance() < 0.05) layer[key] = values[Math.floor(chance() * values.length)];
    }
    try {
      const [found] = (await engine.readProject(JSON.stringify({ sillon: 1, layers: [layer] }))).layers ?? [];
      assert.ok(found !== undefined);
      const whole = { ...layerDefaults(), ...found };
      for (const setting of layerSettings) {
        if (['file', 'maskFile', 'modeFile', 'font'].includes(setting.key)) continue;
        assert.ok(accepts(setting, whole[setting.key as 'angle']), `${setting.key} of ${JSON.stringify(layer)}`);
      }
      ++taken;
    } catch (error) {
      assert.ok(error instanceof Error && error.name === 'SillonError', String(error));
      ++refused;
    }
  }
  assert.ok(taken > 150 && refused > 150, `${taken} taken, ${refused} refused`);
});
