// Pictures of cards: none is drawn for a panel that is gone, and none of theirs stays in memory.
import assert from 'node:assert/strict';
import { beforeEach, mock, test } from 'node:test';
import type { ReactiveController, ReactiveControllerHost } from 'lit';

import { DrawnChoices } from '../../src/controls/drawn-choices.js';
import type { StudioElement } from '../../src/controls/element.js';
import { newPlate } from '../../src/model/new-plate.js';

const turn = (): Promise<void> => new Promise((resolve) => setImmediate(resolve));
type Name = 'disc' | 'heart';

/** A panel that updates as Lit's elements do: also where it has been taken away meanwhile. */
class Panel {
  isConnected = false;
  drawings = 0;
  state = { plate: newPlate(), live: false };
  updateComplete = Promise.resolve(true);
  #controller: ReactiveController | undefined;
  readonly choices = new DrawnChoices<Name>(this as unknown as ReactiveControllerHost & StudioElement, () => () => {
    ++this.drawings;
    return Promise.resolve(
      new Map<Name, Blob>([
        ['disc', new Blob()],
        ['heart', new Blob()],
      ]),
    );
  });
  addController(controller: ReactiveController): void {
    this.#controller = controller;
  }
  requestUpdate(): void {
    this.updateComplete = Promise.resolve().then(() => {
      this.#controller?.hostUpdated?.();
      return true;
    });
  }
  async attach(there: boolean): Promise<void> {
    this.isConnected = there;
    if (there) this.#controller?.hostConnected?.();
    else this.#controller?.hostDisconnected?.();
    await this.rest();
  }
  async rest(): Promise<void> {
    await turn();
    mock.timers.tick(1000);
    await turn();
    await turn();
  }
}

let addresses: Set<string>;
beforeEach(() => {
  mock.timers.reset();
  mock.timers.enable({ apis: ['setTimeout'] });
  addresses = new Set();
  let last = 0;
  mock.method(URL, 'createObjectURL', () => {
    const made = `blob:${++last}`;
    addresses.add(made);
    return made;
  });
  mock.method(URL, 'revokeObjectURL', (address: string) => addresses.delete(address));
});

void test('a panel that comes and goes leaves nothing, and draws nothing once it is gone', async () => {
  const panel = new Panel();
  for (let round = 1; round <= 3; ++round) {
    await panel.attach(true);
    assert.deepEqual([panel.drawings, addresses.size], [round, 2]);
    assert.ok(addresses.has(panel.choices.url('disc') ?? ''));
    await panel.attach(false);
    assert.deepEqual([panel.drawings, addresses.size], [round, 0]);
    assert.equal(panel.choices.url('disc'), undefined);
    panel.requestUpdate(); // one that was asked for before
    await panel.rest();
    assert.deepEqual([panel.drawings, addresses.size], [round, 0]);
  }
});

void test('pictures that come after their panel has gone are dropped', async () => {
  const panel = new Panel();
  panel.isConnected = true;
  panel.requestUpdate();
  await turn();
  mock.timers.tick(1000); // drawing begins
  await panel.attach(false);
  assert.equal(panel.drawings, 1);
  assert.equal(addresses.size, 0);
});
