// Which tab has which plate, where browsers lend no locks.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { askedLocks, type Channel, type Locks } from '../../src/files/locks.js';

type Word = Parameters<Channel['postMessage']>[0];

/** Tabs that hear each other. A tab that is `busy` hears only when it is let go. */
class Air {
  readonly #channels: { channel: Channel; late: Word[] | undefined }[] = [];

  tab(): { locks: Locks; lost: string[]; busy: () => void; free: () => void; close: () => void } {
    const entry: { channel: Channel; late: Word[] | undefined } = {
      late: undefined,
      channel: {
        onmessage: null,
        postMessage: (data) => {
          for (const other of this.#channels.filter((one) => one !== entry)) {
            if (other.late !== undefined) other.late.push(data);
            else queueMicrotask(() => other.channel.onmessage?.({ data }));
          }
        },
      },
    };
    const locks = askedLocks(
      'test',
      () => {
        this.#channels.push(entry);
        return entry.channel;
      },
      () => ++this.#time,
      5,
    );
    return {
      locks,
      lost: [],
      busy: () => {
        entry.late = [];
      },
      free: () => {
        const late = entry.late ?? [];
        entry.late = undefined;
        for (const data of late) entry.channel.onmessage?.({ data });
      },
      close: () => {
        this.#channels.splice(this.#channels.indexOf(entry), 1);
      },
    };
  }
  #time = 0;
}

const onLost = (lost: string[]) => (id: string) => void lost.push(id);

test('a plate has one tab, until that is closed', async () => {
  const air = new Air();
  const [one, two] = [air.tab(), air.tab()];
  assert.ok(await one.locks.take('a', { onLost: onLost(one.lost) }));
  assert.equal(await two.locks.take('a', { wait: true, onLost: onLost(two.lost) }), false);
  assert.ok(await two.locks.take('b', { onLost: onLost(two.lost) }));
  assert.deepEqual([...(await one.locks.held())].sort(), ['a', 'b']);
  assert.deepEqual([one.locks.mine('a'), one.locks.mine('b')], [true, false]);
  one.close(); // or reloaded
  const again = air.tab();
  assert.ok(await again.locks.take('a', { wait: true, onLost: onLost(again.lost) }));
  assert.deepEqual([...(await two.locks.held())].sort(), ['a', 'b']);
  assert.deepEqual([one.lost, two.lost, again.lost], [[], [], []]);
});

test('a plate that is stolen is lost to the other tab', async () => {
  const air = new Air();
  const [one, two] = [air.tab(), air.tab()];
  assert.ok(await one.locks.take('a', { onLost: onLost(one.lost) }));
  assert.ok(await two.locks.take('a', { steal: true, onLost: onLost(two.lost) }));
  await two.locks.held(); // all has been heard
  assert.deepEqual([one.lost, two.lost], [['a'], []]);
  assert.deepEqual([one.locks.mine('a'), two.locks.mine('a')], [false, true]);
});

test('a tab that was too busy to answer keeps its plate; the other hears that it has lost it', async () => {
  const air = new Air();
  const [one, two] = [air.tab(), air.tab()];
  assert.ok(await one.locks.take('a', { onLost: onLost(one.lost) }));
  one.busy();
  assert.ok(await two.locks.take('a', { onLost: onLost(two.lost) }));
  one.free();
  await two.locks.held();
  assert.deepEqual([one.lost, two.lost], [[], ['a']]);
  assert.deepEqual([one.locks.mine('a'), two.locks.mine('a')], [true, false]);
});

test('of two tabs that ask at the same time one gets the plate', async () => {
  const air = new Air();
  const [one, two] = [air.tab(), air.tab()];
  const got = await Promise.all([one, two].map((tab) => tab.locks.take('a', { onLost: onLost(tab.lost) })));
  await one.locks.held();
  assert.equal([one, two].filter(({ locks }) => locks.mine('a')).length, 1);
  const refused = got.filter((has) => !has).length;
  assert.equal(refused + one.lost.length + two.lost.length, 1); // the other one knows
});
