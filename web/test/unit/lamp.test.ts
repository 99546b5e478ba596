import assert from 'node:assert/strict';
import { test } from 'node:test';
import { withFile } from '../../src/files/open.js';
import { type Guessed, guessRoles } from '../../src/files/guess.js';
import { newPlate } from '../../src/model/new-plate.js';
import { withFilament } from '../../src/model/filaments.js';
import { changeGround, filledWith, groundPictures } from '../../src/model/fills.js';
import { engineInput } from '../../src/model/input.js';
import {
  greySteps,
  homeLight,
  hourOf,
  isOwnPicture,
  judgedFile,
  lampFor,
  lampsOf,
  leastSeen,
  pictureOf,
  platesFor,
  samePictures,
  shownPictures,
  standingLamps,
  weaknessesOf,
} from '../../src/model/lamp.js';
import { newLayer, withLayer } from '../../src/model/layer-list.js';
import type { Plate } from '../../src/model/plate.js';
import { sameToolpath } from '../../src/model/result.js';
import { Aim, between, near, swayed, turned } from '../../src/views/light.js';
import { fileOf } from './support/pictures.js';

const [cat, dog] = [fileOf('cat.jpg'), fileOf('dog.jpg')];
const plateOf = (...lamps: ([number, number] | null)[]): Plate =>
  filledWith(newPlate(), 'picture', { pictures: lamps.map((lamp, k) => ({ file: k === 0 ? cat : dog, lamp })) });
/** With pictures of the dog above everything, each under its lamp. */
const above = (plate: Plate, ...lamps: ([number, number] | null)[]): Plate =>
  withLayer(plate, newLayer(plate, 'picture', { pictures: lamps.map((lamp) => ({ file: dog, lamp })) }));
const facts = {
  width: 40,
  height: 30,
  deep: false,
  coloured: true,
  modeGreys: false,
  unitVectors: false,
  twoTones: false,
  oneTone: false,
  whiteOnClear: false,
};

test('a photograph is solved for the light on the screen, a second one for a lamp beside it', () => {
  const one = withFile(newPlate(), cat, 'lamp', [400, 300], { azimuth: 222.4, elevation: 41 });
  assert.deepEqual(groundPictures(one), [{ file: cat, lamp: [222, 41] }]);
  assert.deepEqual([one.shape.kind, one.width, one.height], ['rectangle', 70, 52.5]);
  const photo = [{ name: 'dog.jpg', facts }];
  assert.deepEqual(guessRoles(photo, newPlate()), ['lamp']);
  // Another picture takes the place of the first; it is added where that is asked for, or where both come together.
  assert.deepEqual(guessRoles(photo, one), ['lamp']);
  assert.deepEqual(guessRoles([{ name: 'x.png', facts: { ...facts, twoTones: true } }], one), ['levels']);
  assert.deepEqual(guessRoles([...photo, ...photo], one), ['lamp', 'more']);
  assert.deepEqual(
    guessRoles(
      Array.from({ length: 5 }, () => photo[0] as Guessed),
      one,
    ).slice(3),
    ['more', 'none'],
  );

  const two = withFile(one, dog, 'more', [100, 100]);
  assert.deepEqual(groundPictures(two), [
    { file: cat, lamp: [222, 41] },
    { file: dog, lamp: [277, 41] },
  ]);
  assert.deepEqual([two.width, two.height], [one.width, one.height]);
  // Instead of the first: its lamp stays.
  const other = withFile(one, dog, 'lamp', [300, 400]);
  assert.deepEqual(groundPictures(other), [{ file: dog, lamp: [222, 41] }]);
  assert.deepEqual(lampFor([{ file: cat, lamp: [340, 30] }], { azimuth: 0, elevation: 0 }), [35, 30]);
});

test('the engine is asked for the pictures under the spool of the plate', () => {
  const plate = withFilament(plateOf([60, 45], null), 'bluePla');
  const { input } = engineInput(plate);
  const pictures = [
    { file: cat.bytes, lamp: [60, 45] },
    { file: dog.bytes, lamp: null },
  ];
  assert.deepEqual(
    input.layers?.map(({ kind, pictures, mode }) => ({ kind, pictures, mode })),
    [{ kind: 'picture', pictures, mode: 'constrained' }],
  );
  assert.deepEqual(input.pictures, {
    proportions: 'keep',
    spool: 'bluePla',
    slopes: [2.36, 17.32],
    lampSize: 0.1,
    smoothness: 0.02,
    localContrast: 0,
    corrections: 3,
  });
  assert.equal(engineInput(plate, { factor: 1 }).input.pictures?.corrections, 0);
  assert.ok(sameToolpath(plate, { ...plate, name: 'other' }));
  assert.ok(!sameToolpath(plate, withFilament(plate, 'goldPla')));
  assert.ok(!sameToolpath(plate, { ...plate, printer: { ...plate.printer, nozzle: 0.8 } }));
  const waves = newPlate();
  assert.ok(sameToolpath(waves, withFilament(waves, 'bluePla')));
  const pictured = above(waves, null);
  assert.ok(!samePictures(pictured, withFilament(pictured, 'bluePla')));
  // Each correction is one more plate, whether the pictures fill it or lie in a layer that is seen.
  const hidden = { ...pictured, layers: pictured.layers.map((layer) => ({ ...layer, visible: layer.id === 1 })) };
  assert.deepEqual([plate, waves, pictured, hidden].map(platesFor), [4, 1, 4, 1]);
  assert.equal(platesFor({ ...plate, pictures: { ...plate.pictures, localContrast: 0.5 } }), 1);
});

test('the light belongs where the plate looks as it is meant to', () => {
  assert.deepEqual(homeLight(newPlate(), undefined), { azimuth: 60, elevation: 35 });
  assert.deepEqual(homeLight(plateOf([-90, 50]), undefined), { azimuth: 270, elevation: 50 });
  const look = {
    colour: [0, 0, 0],
    slopes: [2, 17],
    lampSize: 0.1,
    lamps: [
      [10, 40],
      [70, 40],
    ],
  } as const;
  const solved = {
    ...look,
    colour: [...look.colour],
    slopes: [...look.slopes],
    lamps: look.lamps.map((one) => [...one]),
  } as Parameters<typeof lampsOf>[1];
  assert.deepEqual(lampsOf(plateOf(null, [20, 30]), solved), [
    { azimuth: 10, elevation: 40 },
    { azimuth: 20, elevation: 30 },
  ]);
  assert.deepEqual(lampsOf(plateOf(null), undefined), []); // it is not known before they are solved for
  const under = (fill: Parameters<typeof filledWith>[1], given = {}): number =>
    homeLight(filledWith(newPlate(), fill, { file: cat, ...given }), undefined).azimuth;
  // Beads across the light are bright: 150° under 60°, 90° under 0°.
  assert.equal(under('brightness'), 60);
  assert.equal(under('brightness', { from: 150, to: 60 }), 150);
  assert.equal(under('levels'), 0);
  assert.equal(under('edges'), 60); // it has no bright end
  assert.equal(under('colours'), 60);
  const colours = [
    { colour: '#000000', angle: 30 },
    { colour: '#ffffff', angle: 100 },
  ];
  assert.equal(under('colours', { colours }), 10); // the lightest is the last
});

test('the light turns to the pictures of the ground, and where it has none to the lowest above it', () => {
  const one = { azimuth: 10, elevation: 40 };
  const two = { azimuth: 70, elevation: 50 };
  const ground = above(plateOf([10, 40]), [70, 50]);
  assert.deepEqual(shownPictures(ground), [{ file: cat, lamp: [10, 40] }]);
  assert.deepEqual([lampsOf(ground, undefined), homeLight(ground, undefined)], [[one], one]);

  const waves = above(above(newPlate(), [70, 50], null), [200, 30]);
  assert.deepEqual(shownPictures(waves), [
    { file: dog, lamp: [70, 50] },
    { file: dog, lamp: null },
  ]);
  // One that names no lamp is shown under the usual one of layers, whatever the engine has solved for.
  assert.deepEqual(lampsOf(waves, { lamps: [[1, 2]] } as unknown as Parameters<typeof lampsOf>[1]), [
    two,
    { azimuth: 60, elevation: 45 },
  ]);
  assert.deepEqual(homeLight(waves, undefined), two);

  // What is hidden, or lacks its picture, is not shown.
  const hidden = changeGround(ground, { visible: false });
  assert.deepEqual(shownPictures(hidden), [{ file: dog, lamp: [70, 50] }]);
  assert.deepEqual(homeLight(hidden, undefined), two);
  const lacking = changeGround(ground, { pictures: [] });
  assert.deepEqual(shownPictures(lacking), [{ file: dog, lamp: [70, 50] }]);
  assert.deepEqual(shownPictures(newPlate()), []);
});

test('a lamp stands at an hour of the clock, by the plate’s upper edge', () => {
  const hours = [90, 60, 45.1, 0, -30, 180, 270, 359, 106, 104].map(hourOf);
  assert.deepEqual(hours, [12, 1, 1, 3, 4, 9, 6, 3, 11, 12]);
});

test('every lamp of the plate is told once, with the pictures that it lights', () => {
  const waves = newPlate();
  assert.deepEqual(standingLamps(waves, undefined), [{ light: homeLight(waves, undefined), files: [] }]);
  const two = above(plateOf([70, 45], null), [70, 45]);
  const look = {
    lamps: [
      [70, 45],
      [110, 40],
    ],
  } as unknown as Parameters<typeof standingLamps>[1];
  assert.deepEqual(standingLamps(two, look), [
    { light: { azimuth: 70, elevation: 45 }, files: [cat, dog] },
    { light: { azimuth: 110, elevation: 40 }, files: [dog] },
  ]);
});

test('what is to be seen is the ground’s picture under the lamp that shines, or that of its tones', () => {
  const two = plateOf([10, 40], [70, 40]);
  assert.deepEqual([pictureOf(two, 0), pictureOf(two, 1), pictureOf(two, 2)], [cat, dog, undefined]);
  for (const fill of ['brightness', 'edges', 'levels', 'colours'] as const) {
    assert.equal(pictureOf(filledWith(newPlate(), fill, { file: cat }), 0), cat, fill);
  }
  assert.equal(pictureOf(filledWith(newPlate(), 'map', { file: cat }), 0), undefined); // nobody recognises a map
  assert.equal(pictureOf(above(newPlate(), null), 0), undefined);
});

test('what is judged of a picture names its file, of those over the directions, too', () => {
  const pictures = [cat, dog, cat].map((file) => ({ file, lamp: null }));
  const lacking = newLayer(newPlate(), 'picture');
  const shown = newLayer(newPlate(), 'picture', { pictures });
  const plate = [lacking, newLayer(newPlate(), 'text'), shown].reduce(withLayer, plateOf([60, 45], null));
  const report = { file: '', lamp: [0, 45] as [number, number], r: 1, ssim: 1, contrast: 9, others: [] };
  const all = [1, 1, 3, 3, 3].map((layer) => ({ ...report, layer, from: 'toolpath' as const }));
  assert.deepEqual(
    all.map((_, k) => judgedFile(plate, all, k)),
    [cat, dog, cat, dog, cat],
  );
  assert.equal(judgedFile(newPlate(), all, 2), undefined);
});

test('a spool or a lamp that shows little is told', () => {
  const seen = (contrast: number, r = 0.95) => [
    {
      ...{ layer: 1, file: 'a', lamp: [60, 45] as [number, number] },
      ...{ r, ssim: 0.8, contrast, others: [], from: 'toolpath' as const },
    },
  ];
  const blue = withFilament(plateOf([60, 45]), 'bluePla');
  assert.deepEqual(weaknessesOf(blue, undefined), []);
  assert.deepEqual(weaknessesOf(blue, seen(15)), []);
  assert.deepEqual(weaknessesOf(blue, seen(3)), ['spool']);
  assert.deepEqual(weaknessesOf(blue, seen(15, 0.3)), ['unlike']);
  const three = [...seen(15), ...seen(15, 0.57), ...seen(15, 0.8)];
  assert.deepEqual(weaknessesOf(blue, three), ['crowded']);
  assert.deepEqual(leastSeen(three), { n: 3, r: 0.57 });
  // Pictures of layers over them are others.
  const others = seen(1, 0.1).map((one) => ({ ...one, layer: 2 }));
  assert.deepEqual(weaknessesOf(blue, [...seen(15), ...others, ...others]), []);
  assert.deepEqual(leastSeen([...seen(15), ...others]), { n: 1, r: 0.95 });
  assert.deepEqual(weaknessesOf(withFilament(above(newPlate(), null), 'bluePla'), others), []);
  assert.deepEqual(weaknessesOf(withFilament(blue, 'goldPla'), undefined), ['spool']);
  const window = { ...blue, pictures: { ...blue.pictures, lampSize: 0.4 } };
  assert.deepEqual(weaknessesOf(window, seen(1.5)), ['window']);
  assert.deepEqual(weaknessesOf(newPlate(), undefined), []); // gold waves are fine
  assert.equal(greySteps(1), 1);
  assert.equal(greySteps(1.1 ** 24 + 1e-9), 24);
});

test('the light springs back the shorter way, and sways no further than 25° to both sides', () => {
  const home = { azimuth: 350, elevation: 45 };
  let light = { azimuth: 20, elevation: 80 };
  for (let n = 0; n < 200; ++n) {
    const next = turned(light, home, 16);
    assert.ok(next.azimuth <= 20 || next.azimuth >= 350, 'it went the long way round');
    light = next;
  }
  assert.ok(near(light, home, 0.01));
  for (let now = 0; now < 20_000; now += 50) assert.ok(near(swayed(home, now), home, 25.0001));
  assert.deepEqual(between({ azimuth: 10, elevation: 40 }, { azimuth: 70, elevation: 60 }, 0.5), {
    azimuth: 40,
    elevation: 50,
  });
});

test('a pointer aims where it came to rest, and not where it passes', () => {
  const aim = new Aim();
  const light = (azimuth: number) => ({ azimuth, elevation: 40 });
  assert.equal(aim.leave(0), undefined);
  aim.move(light(10), 1000);
  aim.move(light(20), 1100);
  assert.equal(aim.leave(1200), undefined); // it has only passed
  aim.move(light(30), 9000);
  aim.move(light(40), 9100);
  aim.move(light(50), 9500);
  aim.move(light(60), 9550);
  assert.deepEqual(aim.leave(9600), light(40));
  assert.equal(aim.leave(9999), undefined);
  aim.move(light(70), 20000);
  assert.deepEqual(aim.leave(21000), light(70));
});

test('a picture is its visitor’s own unless it came with the page', () => {
  const own = plateOf([60, 35], [115, 35]);
  assert.ok(isOwnPicture(own, 0) && isOwnPicture(own, 1));
  assert.ok(!isOwnPicture(newPlate(), 0));
  const example = { ...cat, id: 'example/sun.png' };
  assert.ok(!isOwnPicture(filledWith(own, 'brightness', { file: example }), 0));
  assert.ok(isOwnPicture(filledWith(own, 'brightness', { file: cat }), 0));
});
