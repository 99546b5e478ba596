import type { Picture } from 'sillon';
import { StudioError } from '../model/problem.js';
import { storeDegrees } from './angle.js';
import type { SourceOf } from './source.js';
import { anglesOf, type Page, type Size } from './texels.js';

const mostBytes = 2331; // in a code with correction level M

/** The modules of a QR code, one pixel each: 0 dark, 255 light.
 * @throws StudioError TextTooLong */
export async function qrPicture(text: string): Promise<Picture> {
  const { default: qrcode } = await import('qrcode-generator');
  const bytes = new TextEncoder().encode(text);
  if (bytes.length > mostBytes) throw new StudioError('TextTooLong', { length: bytes.length, most: mostBytes });
  qrcode.stringToBytes = () => Array.from(bytes);
  const code = qrcode(0, 'M');
  code.addData(text);
  code.make();
  const side = code.getModuleCount();
  const samples = Uint8Array.from({ length: side * side }, (_, k) =>
    code.isDark(Math.floor(k / side), k % side) ? 0 : 255,
  );
  return { width: side, height: side, channels: 1, samples };
}

/** The code in the middle of the page, as large as its margin lets it be; around it is light.
 * @param round  it must fit into the ellipse of the page, and so its corners: cut, no code can be read */
export function qrAngles(source: SourceOf<'qr'>, size: Size, page: Page, modules: Picture, round = false): Uint16Array {
  const dark = storeDegrees(source.dark);
  const light = storeDegrees(source.light);
  const count = modules.width;
  const tall = page[1] / page[0];
  const room = Math.min(1, tall) / (count + 2 * source.margin);
  // Half a module is left for the border, along which beads run as they must.
  const module = round ? Math.min(room, tall / Math.hypot(1, tall) / (count + 1)) : room;
  return anglesOf(size, page, (x, y) => {
    const column = Math.floor((x - 0.5) / module + count / 2);
    const row = Math.floor((tall / 2 - y) / module + count / 2);
    const inside = column >= 0 && column < count && row >= 0 && row < count;
    return inside && modules.samples[row * count + column] === 0 ? dark : light;
  });
}
