// Made by ./dev generate from core/data/loop.json.

/** Longer side [pixels] and most bytes of a loop of moving light; its frames and how long each is shown [ms]; the quality that is tried
 * first, 0..100, and by how much the next one is lower. */
export const loop = {
  side: 560,
  bytes: 1000000,
  turnFrames: 36,
  turnTime: 100,
  holdTime: 1200,
  crossFrames: 6,
  crossTime: 60,
  bestQuality: 70,
  qualityStep: 15,
} as const;
