#include "field/phase_rows.hpp"

#include "base/fast_math.hpp"
#include "base/simd.hpp"

namespace sillon {

void fillEdges(const EdgeRow& row, int cells) {
  const float share = row.midpoint ? 0.5f * row.step : row.step;
  for (int k = 0; k < cells; k += 4) {
    F4 ox = splat(row.offsetX);
    F4 oy = splat(row.offsetY);
    if (row.moveX != nullptr) {
      ox = ox + load4(row.moveX + k);
      oy = oy + load4(row.moveY + k);
    }
    const F4 dix = load4(row.dix + k);
    const F4 diy = load4(row.diy + k);
    const F4 djx = load4(row.djx + k);
    const F4 djy = load4(row.djy + k);
    const F4 along = dix * djx + diy * djy;
    const F4 sign = select4(along > splat(0), splat(1), splat(-1));
    const F4 fi = sign * load4(row.fi + k);
    const F4 fj = load4(row.fj + k);
    const F4 weight = splat(row.weight) * (sign * along);
    const F4 kx = row.midpoint ? fj * djx + fi * dix : fj * djx;
    const F4 ky = row.midpoint ? fj * djy + fi * diy : fj * djy;
    const SinCos4 turn = sinCos(splat(share) * (ox * kx + oy * ky));
    store4(row.re + k, weight * turn.cos);
    store4(row.im + k, weight * turn.sin);
    store4(row.sign + k, sign);
    if (row.midpoint) continue;
    const SinCos4 back = sinCos(splat(row.step) * (ox * fi * dix + oy * fi * diy));
    store4(row.backRe + k, weight * back.cos);
    store4(row.backIm + k, weight * back.sin);
  }
}

void sweepCells(const ColourSweep& sweep, std::size_t first, int cells) {
  for (std::size_t i = first; i < first + static_cast<std::size_t>(cells); i += 4) {
    F4 sumRe = sweep.ar != nullptr ? load4(sweep.ar + i) : splat(0);
    F4 sumIm = sweep.ai != nullptr ? load4(sweep.ai + i) : splat(0);
    for (std::size_t e = 0; e < kEdges; ++e) {
      const SweepSource& s = sweep.ahead[e];
      const F4 re = load4(s.re + i);
      const F4 im = load4(s.im + i);
      const F4 jr = load4(s.qr + i);
      const F4 ji = load4(s.qi + i);
      sumRe = sumRe + load4(s.sign + i) * (re * jr - im * ji);
      sumIm = sumIm + (re * ji + im * jr);
    }
    for (std::size_t e = 0; e < kEdges; ++e) {
      const SweepSource& s = sweep.behind[e];
      const F4 sign = load4(s.sign + i);
      const F4 re = load4(s.re + i);
      const F4 im = load4(s.im + i);
      const F4 jr = load4(s.qr + i);
      const F4 ji = load4(s.qi + i);
      sumRe = sumRe + (sign * (re * jr) + im * ji);
      sumIm = sumIm + (re * ji - sign * (im * jr));
    }
    const F4 size2 = sumRe * sumRe + sumIm * sumIm;
    const I4 change = (size2 > splat(kNoPhase * kNoPhase)) & (load4(sweep.free + i) > splat(0));
    const F4 scale = splat(1) / sqrt4(max4(size2, splat(kNoPhase * kNoPhase)));
    store4(sweep.qr + i, select4(change, sumRe * scale, load4(sweep.qr + i)));
    store4(sweep.qi + i, select4(change, sumIm * scale, load4(sweep.qi + i)));
  }
}

}  // namespace sillon
