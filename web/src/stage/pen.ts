// A pen over a page, in millimetres, moved by a pointer or by keys; it draws while it is down.
import type { Cursor } from './overlay.js';

export class Pen {
  /** Place of the pen; undefined: it is not over the page. */
  cursor: Cursor | undefined;
  /** Line being drawn, x and y alternately; undefined: the pen is up. */
  points: number[] | undefined;

  constructor(
    /** Sides of the page [mm]. */
    private readonly page: () => readonly [number, number],
    private readonly drawn: (points: readonly number[]) => void,
    private readonly lifted: (points: readonly number[]) => void,
  ) {}

  begin(at: Cursor): void {
    this.points = [];
    this.draw(at);
  }

  draw({ x, y }: Cursor): void {
    if (this.points === undefined) return;
    this.points.push(x, y);
    this.drawn(this.points);
  }

  lift(): void {
    const { points } = this;
    this.points = undefined;
    if (points !== undefined) this.lifted(points);
  }

  #middle = (): Cursor => ({ x: this.page()[0] / 2, y: this.page()[1] / 2 });

  /** Moves the pen by keys [mm]. */
  move(dx: number, dy: number): void {
    const { x, y } = this.cursor ?? this.#middle();
    const [width, height] = this.page();
    this.cursor = { x: Math.min(width, Math.max(0, x + dx)), y: Math.min(height, Math.max(0, y + dy)) };
    this.draw(this.cursor);
  }

  /** Puts the pen down or up, for the space bar. */
  toggle(): void {
    if (this.points !== undefined) this.lift();
    else this.begin((this.cursor ??= this.#middle()));
  }
}
