import type { Picture } from 'sillon';
import { StudioError } from '../model/problem.js';
import { storeDegrees } from './angle.js';
import { placeIn, type Room } from './room.js';
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

/** Width of a module, a share of the page's width, and the middle of the code, shares of the page.
 * @param count  modules of a side @param round, room  as of `qrAngles` */
function placeOf({ margin }: SourceOf<'qr'>, [width, height]: Page, count: number, round: boolean, room?: Room) {
  const tall = height / width;
  const module = Math.min(1, tall) / (count + 2 * margin);
  // Half a module is left for the border, along which beads run as they must.
  const side = module * (count + 1);
  if (room !== undefined) {
    const { scale, x, y } = placeIn(side, side / tall, room);
    return { module: module * scale, x, y };
  }
  return { module: round ? Math.min(module, tall / Math.hypot(1, tall) / (count + 1)) : module, x: 0.5, y: 0.5 };
}

/** Width of a module, a share of the page's width. @throws StudioError TextTooLong */
export const moduleShare = async (source: SourceOf<'qr'>, page: Page, round: boolean, room?: Room): Promise<number> =>
  placeOf(source, page, (await qrPicture(source.text)).width, round, room).module;

/** The code in the middle of the page, as large as its margin lets it be; around it is light.
 * @param round  it must fit into the ellipse of the page, and so its corners: cut, no code can be read
 * @param room  it must fit in there */
export function qrAngles(
  source: SourceOf<'qr'>,
  size: Size,
  page: Page,
  modules: Picture,
  round = false,
  room?: Room,
): Uint16Array {
  const dark = storeDegrees(source.dark);
  const light = storeDegrees(source.light);
  const count = modules.width;
  const tall = page[1] / page[0];
  const { module, x: middle, y: below } = placeOf(source, page, count, round, room);
  return anglesOf(size, page, (x, y) => {
    const column = Math.floor((x - middle) / module + count / 2);
    const row = Math.floor(((1 - below) * tall - y) / module + count / 2);
    const inside = column >= 0 && column < count && row >= 0 && row < count;
    return inside && modules.samples[row * count + column] === 0 ? dark : light;
  });
}
