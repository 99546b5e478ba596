import type { Request } from './request.js';
import { createServer } from './serve.js';
import { drawText } from './text.js';

const serve = createServer(drawText);

self.addEventListener('message', (event: MessageEvent<Request>) => {
  void serve(event.data).then((reply) => {
    const transfer = 'raster' in reply ? [reply.raster.angle.buffer, reply.raster.mode.buffer] : [];
    self.postMessage(reply, { transfer });
  });
});
