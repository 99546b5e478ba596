// The loops of phase_rows.hpp for any number of cells at a time. Each source that includes this has its own.
#pragma once

#include "base/sin_cos.hpp"
#include "field/phase_rows.hpp"

namespace sillon {
namespace {

template <class Lanes>
void fillEdgesBy(const EdgeRow& row, int cells) {
  using F = typename Lanes::F;
  const auto all = [](float v) { return Lanes::all(v); };
  const float share = row.midpoint ? 0.5f * row.step : row.step;
  for (int k = 0; k < cells; k += Lanes::count) {
    F ox = all(row.offsetX);
    F oy = all(row.offsetY);
    if (row.moveX != nullptr) {
      ox = ox + Lanes::load(row.moveX + k);
      oy = oy + Lanes::load(row.moveY + k);
    }
    const F dix = Lanes::load(row.dix + k);
    const F diy = Lanes::load(row.diy + k);
    const F djx = Lanes::load(row.djx + k);
    const F djy = Lanes::load(row.djy + k);
    const F along = dix * djx + diy * djy;
    const F sign = Lanes::select(along > all(0), all(1), all(-1));
    const F fi = sign * Lanes::load(row.fi + k);
    const F fj = Lanes::load(row.fj + k);
    const F weight = all(row.weight) * (sign * along);
    const F kx = row.midpoint ? fj * djx + fi * dix : fj * djx;
    const F ky = row.midpoint ? fj * djy + fi * diy : fj * djy;
    const SinCosOf<Lanes> turn = sinCosOf<Lanes>(all(share) * (ox * kx + oy * ky));
    Lanes::store(row.re + k, weight * turn.cos);
    Lanes::store(row.im + k, weight * turn.sin);
    Lanes::store(row.sign + k, sign);
    if (row.midpoint) continue;
    const SinCosOf<Lanes> back = sinCosOf<Lanes>(all(row.step) * (ox * fi * dix + oy * fi * diy));
    Lanes::store(row.backRe + k, weight * back.cos);
    Lanes::store(row.backIm + k, weight * back.sin);
  }
}

template <class Lanes>
void sweepCellsBy(const ColourSweep& sweep, std::size_t first, int cells) {
  using F = typename Lanes::F;
  const auto all = [](float v) { return Lanes::all(v); };
  for (std::size_t i = first; i < first + static_cast<std::size_t>(cells); i += Lanes::count) {
    F sumRe = sweep.ar != nullptr ? Lanes::load(sweep.ar + i) : all(0);
    F sumIm = sweep.ai != nullptr ? Lanes::load(sweep.ai + i) : all(0);
    for (std::size_t e = 0; e < kEdges; ++e) {
      const SweepSource& s = sweep.ahead[e];
      const F re = Lanes::load(s.re + i);
      const F im = Lanes::load(s.im + i);
      const F jr = Lanes::load(s.qr + i);
      const F ji = Lanes::load(s.qi + i);
      sumRe = sumRe + Lanes::load(s.sign + i) * (re * jr - im * ji);
      sumIm = sumIm + (re * ji + im * jr);
    }
    for (std::size_t e = 0; e < kEdges; ++e) {
      const SweepSource& s = sweep.behind[e];
      const F sign = Lanes::load(s.sign + i);
      const F re = Lanes::load(s.re + i);
      const F im = Lanes::load(s.im + i);
      const F jr = Lanes::load(s.qr + i);
      const F ji = Lanes::load(s.qi + i);
      sumRe = sumRe + (sign * (re * jr) + im * ji);
      sumIm = sumIm + (re * ji - sign * (im * jr));
    }
    const F size2 = sumRe * sumRe + sumIm * sumIm;
    const auto change = (size2 > all(kNoPhase * kNoPhase)) & (Lanes::load(sweep.free + i) > all(0));
    const F scale = all(1) / Lanes::sqrt(Lanes::max(size2, all(kNoPhase * kNoPhase)));
    Lanes::store(sweep.qr + i, Lanes::select(change, sumRe * scale, Lanes::load(sweep.qr + i)));
    Lanes::store(sweep.qi + i, Lanes::select(change, sumIm * scale, Lanes::load(sweep.qi + i)));
  }
}

}  // namespace
}  // namespace sillon
