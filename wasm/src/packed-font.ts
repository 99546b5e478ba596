/** Whether bytes are a web font: wOFF or wOF2. dist/engine/unpack-font.js unpacks it. */
export const isPackedFont = ([w, o, f, version]: Uint8Array): boolean =>
  w === 0x77 && o === 0x4f && f === 0x46 && (version === 0x46 || version === 0x32);
