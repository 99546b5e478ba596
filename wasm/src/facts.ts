// Made by tools/generate.mjs from the core's facts: ./dev generate.

/** Limits of core/include/sillon/text/text.hpp. */
export const letterLimits = { usualCapHeight: 0.7, mostPathBytes: 4194304, mostLackedTold: 8 } as const;

/** Default of texts and codes that name none. */
export const usualFont = 'Nunito';
export const usualCorrection = 'medium';

/** In the core's order. */
export const calibrationKinds = ['flow', 'speed', 'fan', 'width', 'directions', 'swatch', 'coupon'] as const;
