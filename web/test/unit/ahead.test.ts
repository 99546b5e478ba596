import assert from 'node:assert/strict';
import { test } from 'node:test';

import type { Stroke } from 'sillon';
import { newShape } from '../../src/model/defaults.js';
import { changeLayer, newLayer, withLayer } from '../../src/model/layer-list.js';
import { newPlate } from '../../src/model/new-plate.js';
import type { Plate } from '../../src/model/plate.js';
import { strokesAhead } from '../../src/views/ahead.js';

const stroke = (x: number): Stroke => ({ tool: 'comb', points: [x, 20, x, 10], radius: 4, soft: 0 });
const brushed = (plate: Plate, ...strokes: Stroke[]): Plate =>
  withLayer(plate, newLayer(plate, 'strokes', { strokes }));

/** Widths and points that are drawn [mm]. */
function drawn(plate: Plate, made: Plate): { wide: number; points: number[] }[] | undefined {
  const draw = strokesAhead(plate, made);
  if (draw === undefined) return undefined;
  class Path {
    points: number[] = [];
    moveTo(x: number, y: number): void {
      this.points.push(x, y);
    }
    lineTo(x: number, y: number): void {
      this.points.push(x, y);
    }
  }
  Object.assign(globalThis, { Path2D: Path });
  const lines: { wide: number; points: number[] }[] = [];
  const context = {
    lineWidth: 0,
    stroke({ points }: Path) {
      lines.push({ wide: this.lineWidth, points });
    },
  };
  const styles = { getPropertyValue: () => 'red' };
  draw(context as unknown as CanvasRenderingContext2D, styles as unknown as CSSStyleDeclaration);
  return lines;
}

test('strokes that the beads do not follow yet are drawn, in millimetres', () => {
  const [first, second] = [stroke(20), stroke(30)];
  const made = brushed(newPlate(), first);
  const plate = changeLayer(made, 2, () => ({ strokes: [first, second] }));
  assert.deepEqual(drawn(plate, made), [{ wide: 8, points: [30, 20, 30, 10] }]);
  // One that goes on is another each time.
  assert.equal(
    drawn(
      changeLayer(made, 2, () => ({ strokes: [stroke(20), second] })),
      made,
    )?.length,
    2,
  );
  // Where a stroke tells no radius, it is that of the core.
  const usual = changeLayer(made, 2, () => ({ strokes: [first, { points: [1, 2, 3, 4] }] }));
  assert.deepEqual(drawn(usual, made), [{ wide: 8, points: [1, 2, 3, 4] }]);
  // All of a new layer are ahead.
  assert.equal(drawn(brushed(made, first, second), made)?.length, 2);
});

test('nothing is ahead where the beads follow all strokes, on another shape, or under other layers', () => {
  const made = brushed(newPlate(), stroke(20));
  assert.equal(drawn({ ...made, name: 'other' }, made), undefined);
  assert.equal(
    drawn(
      changeLayer(made, 2, () => ({ strokes: [] })),
      made,
    ),
    undefined,
  );
  const more = changeLayer(made, 2, ({ strokes }) => ({ strokes: [...strokes, stroke(30)] }));
  assert.equal(drawn({ ...more, shape: newShape('rectangle') }, made), undefined);
  assert.equal(drawn(withLayer(more, newLayer(more, 'border')), made), undefined);
  assert.equal(drawn(newPlate(), made), undefined);
});
