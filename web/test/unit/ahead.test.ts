import assert from 'node:assert/strict';
import { test } from 'node:test';

import { newPlate } from '../../src/model/defaults.js';
import type { Plate, Stroke } from '../../src/model/plate.js';
import { strokesAhead } from '../../src/views/ahead.js';

const stroke = (x: number): Stroke => ({ tool: 'comb', points: [x, 0.5, x, 0.25], radius: 0.1, softness: 0 });

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
  const [first, second] = [stroke(0.5), stroke(0.75)];
  const made = { ...newPlate(), width: 40, height: 80, strokes: [first] };
  const plate = { ...made, strokes: [first, second] };
  assert.deepEqual(drawn(plate, made), [{ wide: 8, points: [30, 40, 30, 20] }]);
  // One that goes on is another each time.
  assert.equal(drawn({ ...made, strokes: [stroke(0.5), second] }, made)?.length, 2);
});

test('nothing is ahead where the beads follow all strokes, of another source, or under a lamp', () => {
  const made = { ...newPlate(), strokes: [stroke(0.5)] };
  assert.equal(drawn({ ...made, name: 'other' }, made), undefined);
  assert.equal(drawn({ ...made, strokes: [] }, made), undefined);
  const more = { ...made, strokes: [...made.strokes, stroke(0.75)] };
  assert.equal(drawn({ ...more, directions: { kind: 'angle', angle: 10 } }, made), undefined);
  const lamp: Plate['directions'] = { kind: 'lamp', pictures: [] };
  assert.equal(drawn({ ...more, directions: lamp }, { ...made, directions: lamp }), undefined);
});
