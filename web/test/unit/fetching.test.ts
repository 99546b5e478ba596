// Files that attributes name: what is fetched, what is refused, and when reading stops.
import assert from 'node:assert/strict';
import { createServer, type RequestListener, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { test } from 'node:test';

import { fetchFiles } from '../../src/embed/fetching.js';
import { most } from '../../src/embed/protocol.js';

async function serving(answer: RequestListener, use: (base: string) => Promise<void>): Promise<void> {
  const server: Server = createServer(answer);
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  try {
    await use(`http://127.0.0.1:${(server.address() as AddressInfo).port}/page/`);
  } finally {
    server.closeAllConnections();
    server.close();
  }
}

test('a project brings the files it names, from its own site only', async () => {
  const projects: Record<string, object> = {
    '/page/near.json': { sillon: 1, shape: { file: 'a.svg' }, layers: [{ kind: 'map', file: 'maps/b.png' }] },
    '/page/far.json': { sillon: 1, shape: { file: 'https://elsewhere.invalid/a.svg' } },
  };
  await serving(
    (request, response) => {
      const project = projects[request.url ?? ''];
      response.end(project === undefined ? request.url : JSON.stringify(project));
    },
    async (base) => {
      const files = await fetchFiles([{ url: 'near.json', role: '' }], base);
      assert.deepEqual(
        files.map(({ name }) => name),
        ['near.json', 'a.svg', 'b.png'],
      );
      assert.equal(new TextDecoder().decode(files[2]?.bytes), '/page/maps/b.png');
      await assert.rejects(fetchFiles([{ url: 'far.json', role: '' }], base), /lies on another site than its project/);
    },
  );
});

test('files of a project lie in its folder or below, are asked for without query and cookies, pictures among them', async () => {
  const asked: string[] = [];
  const shapes = [
    '../a.svg',
    '/a.svg',
    'a.svg?next=1',
    'b/../../a.svg',
    '%2e%2e/a.svg',
    '..%2fa.svg',
    'b%5c..%5ca.svg',
  ];
  await serving(
    (request, response) => {
      asked.push(request.url ?? '');
      const k = /project(\d+)\.json/.exec(request.url ?? '')?.[1];
      if (k === undefined) response.end('<svg/>');
      else if (shapes[Number(k)] !== undefined)
        response.end(JSON.stringify({ sillon: 1, shape: { file: shapes[Number(k)] } }));
      else {
        const layers = [
          {
            kind: 'picture',
            pictures: [{ file: 'one.png', lamp: [60, 45] }, { file: 'two.png' }],
            modeFile: 'mode.png',
          },
          { kind: 'picture', pictures: [{ file: 'three.png' }], maskFile: 'mask.svg' },
          { kind: 'text', text: 'A', font: 'own.ttf' },
          { kind: 'text', text: 'B', font: 'Nunito' },
        ];
        const studio = { files: { 'two.png': 'Two.png', 'inputs/tone.png': 'tone.png' } };
        response.end(JSON.stringify({ sillon: 1, layers, studio }));
      }
    },
    async (base) => {
      for (const k of shapes.keys()) {
        asked.length = 0;
        await assert.rejects(
          fetchFiles([{ url: `project${k}.json`, role: '' }], base),
          /does not lie in the folder of its project or below it/,
          shapes[k],
        );
        assert.deepEqual(asked, [`/page/project${k}.json`]);
      }
      const files = await fetchFiles([{ url: `project${shapes.length}.json`, role: '' }], base);
      assert.deepEqual(files.map(({ name }) => name).sort(), [
        ...['mask.svg', 'mode.png', 'one.png', 'own.ttf', `project${shapes.length}.json`],
        ...['three.png', 'tone.png', 'two.png'],
      ]);
    },
  );
});

test('an abort ends what is being fetched', async () => {
  const control = new AbortController();
  await serving(
    () => {
      control.abort(); // it has asked, and never gets an answer
    },
    (base) => assert.rejects(fetchFiles([{ url: 'slow.svg', role: '' }], base, control.signal), { name: 'AbortError' }),
  );
});

test('addresses that are none, that run script, or that are not there are told in a sentence', async () => {
  await serving(
    (_, response) => {
      response.writeHead(404).end();
    },
    async (base) => {
      const refused = (url: string, words: RegExp): Promise<void> =>
        assert.rejects(fetchFiles([{ url, role: 'shape' }], base), words);
      await refused('javascript:alert(1)', /javascript: addresses are not fetched/);
      await refused('data:image/svg+xml,<svg/>', /data: addresses are not fetched/);
      await refused('file:///etc/passwd', /file: addresses are not fetched/);
      await refused('http://', /is not an address/);
      await refused('gone.svg', /gone\.svg came with status 404/);
    },
  );
});

test('reading stops where a file is too long, whatever its server told', async () => {
  let sent = 0;
  await serving(
    (_, response) => {
      const piece = Buffer.alloc(1 << 20);
      const more = (): void => {
        while (!response.destroyed) {
          sent += piece.length;
          if (!response.write(piece)) {
            response.once('drain', more);
            return;
          }
        }
      };
      more();
    },
    async (base) => {
      await assert.rejects(
        fetchFiles([{ url: 'endless.png', role: '' }], base),
        /endless\.png has more than 64000000 bytes/,
      );
    },
  );
  assert.ok(sent >= most.file && sent < 2 * most.file, `${sent} bytes were sent`);
});
