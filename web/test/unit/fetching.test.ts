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
    '/page/near.json': { sillon: 1, shape: { file: 'a.svg' }, directions: { file: 'maps/b.png' } },
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
      await refused('http://', /is no address/);
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
