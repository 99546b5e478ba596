#include "gcode/layers.hpp"

#include <algorithm>
#include <string>

#include "base/numbers.hpp"
#include "gcode/base_layers.hpp"
#include "printer/dialect.hpp"
#include "sillon/settings/presets.hpp"

namespace sillon {
namespace {

constexpr double kFastest = 1.5;     // [speed], limit for narrow beads with constantFlow
constexpr double kSlowestPace = 5;   // [mm/s]; a slower nozzle drips more than it lays
constexpr double kSeamStep = 0.382;  // golden section, which keeps the seams of neighbouring layers far apart

// Number of seams from the one of a layer to that of the next.
std::size_t toSeam(std::size_t count) { return toSize(kSeamStep * static_cast<double>(count)); }

}  // namespace

void LayerWriter::write(const FileLayer& layer) {
  announce(layer);
  nozzle_.restartAxis();
  const bool begins = layer.index == 0;
  if (begins) {
    rimEnd_ = nullptr;
    if (layer.copy > 0) endObject(nozzle_.out(), job_, printer_.flavor, layer.copy - 1);
    nozzle_.standAt(job_.copies[layer.copy]);
    if (layer.copy > 0) nozzle_.clearNextApproach(layerTop(params_, layerCount(params_) - 1));
  }
  setMachine(layer);
  if (begins) {
    // The skirt surrounds all copies, so it is printed whichever of them a host leaves out.
    if (layer.copy == 0) paths(job_.skirt, kSkirtRole, params_.baseFlow, layer);
    beginObject(nozzle_.out(), job_, printer_.flavor, layer.copy);
    paths(job_.brim, kBrimRole, params_.baseFlow, layer);
  }
  if (layer.rim) {
    rim(layer);
  } else if (layer.oriented && !job_.patches.empty()) {
    patches(layer);
  } else if (layer.oriented) {
    paths(layer.onBed ? job_.bedCycles : job_.cycles, kOrientedRole,
          layer.first && params_.showSide != ShowSide::Up ? params_.bedFlow : params_.flow, layer);
  } else if (params_.basePattern == BasePattern::Same) {
    paths(job_.cycles, kBaseRole, params_.baseFlow, layer);
  } else if (layer.across != NextTo::Base) {
    paths(layer.across == NextTo::Oriented ? job_.across : job_.bedAcross, kBaseRole, params_.baseFlow, layer);
  } else if (layer.index == 0 && !job_.firstBase.empty()) {
    paths(job_.firstBase, kBaseRole, params_.baseFlow, layer);
  } else {
    paths(job_.bases[layer.turn % 2], kBaseRole, params_.baseFlow, layer);
  }
}

// Writes the marks by which viewers, hosts and screens follow the layers.
void LayerWriter::announce(const FileLayer& layer) {
  const std::string top = decimal(layer.top, 3);
  nozzle_.out() << ";BEFORE_LAYER_CHANGE\n;" << top << "\n;LAYER_CHANGE\n;Z:" << top
                << "\n;HEIGHT:" << decimal(layer.height, 3) << "\n";
  if (printer_.flavor == GcodeFlavor::Klipper) {
    nozzle_.out() << "SET_PRINT_STATS_INFO CURRENT_LAYER="
                  << std::to_string(layer.copy * layerCount(params_) + layer.index + 1) << "\n";
  }
  if (printer_.flavor == GcodeFlavor::Bambu) {
    nozzle_.out() << "; CHANGE_LAYER\n; Z_HEIGHT: " << top << "\n; LAYER_HEIGHT: " << decimal(layer.height, 3) << "\n";
    const int count = layer.copy * layerCount(params_) + layer.index;  // number on the printer's screen
    nozzle_.out() << "M73 L" << std::to_string(count + 1) << "\nM991 S0 P" << std::to_string(count) << "\n";
  }
}

// Sets fan, acceleration and temperature where they change: on the first layer and on the one above it.
void LayerWriter::setMachine(const FileLayer& layer) {
  if (layer.first) {
    nozzle_.fan(printer_.firstLayerFan);
    if (printer_.machineAcceleration > 0 && firstAcceleration() != printer_.acceleration) {
      nozzle_.out() << accelerationCommand(printer_.flavor, firstAcceleration());
    }
    if (layer.copy > 0) nozzle_.out() << "M104 S" << fixed(printer_.firstLayerNozzleTemperature, 0) << "\n";
  }
  if (!layer.first) {
    const double asked = layer.oriented ? printer_.showFan : printer_.baseFan;
    nozzle_.fan(asked < 0 ? usualFan(printer_.filamentType) : asked);
  }
  if (layer.index == (beginsOnBed(params_) ? 1 : 0)) {
    if (beginsOnBed(params_) && printer_.machineAcceleration > 0 && firstAcceleration() != printer_.acceleration) {
      nozzle_.out() << accelerationCommand(printer_.flavor, printer_.acceleration);
    }
    nozzle_.out() << "M104 S" << fixed(printer_.nozzleTemperature, 0) << "\n";
  }
}

// Lays the paths of one role; each closed path begins at a seam of this layer.
void LayerWriter::paths(const std::vector<BeadPath>& paths, const Role& role, double flow, const FileLayer& layer) {
  if (paths.empty()) return;
  MotionLimits limits = pacedLimits(layer, flow);
  if (params_.constantFlow && layer.oriented && !layer.first) evenFlow(limits, job_.spacing);
  const bool oriented = &role == &kOrientedRole;  // the skirt of an oriented first layer is not oriented
  limits.coast = oriented ? params_.coast : 0;
  limits.scarf = oriented ? params_.scarf : 0;

  writeRole(nozzle_.out(), role);
  for (const BeadPath& path : paths) {
    std::size_t start = 0;
    if (path.closed) {
      const std::size_t count = path.seams.empty() ? path.points.size() : path.seams.size();
      // A toolpath begins at the start of its sweep, so that neighbouring beads are laid soon after each other. The
      // visible layer keeps that start; the others begin elsewhere.
      const bool kept = oriented && path.beginsUnseen;
      const bool seen = layer.onBed || layer.index == layersBelowRim(params_) - 1;
      const std::size_t chosen = (layer.turn + (kept ? 1 : 0)) * toSeam(count) % count;
      start = kept && seen ? 0 : path.seams.empty() ? chosen : path.seams[chosen];
    }
    lay(path, start, limits, layer, oriented);
    if (nozzle_.out().failed()) return;
  }
}

// Lays the rim. Layers go through the borders forwards and backwards in turns, so that each begins where the one below
// it ended.
void LayerWriter::rim(const FileLayer& layer) {
  const MotionLimits limits = pacedLimits(layer, params_.baseFlow);
  writeRole(nozzle_.out(), kRimRole);
  const std::size_t count = job_.rim.size();
  for (std::size_t k = 0; k < count; ++k) {
    for (const BeadPath& path : job_.rim[layer.turn % 2 == 0 ? k : count - 1 - k]) {
      const std::size_t turn = layer.turn * toSeam(path.seams.size());
      lay(path, path.seams[turn % path.seams.size()], limits, layer, false);
      if (nozzle_.out().failed()) return;
      rimEnd_ = &path;
    }
  }
}

// Lays the patches of a layer, each with its own fan, flow and speed.
void LayerWriter::patches(const FileLayer& layer) {
  writeRole(nozzle_.out(), kBaseRole);
  const double layerFan = nozzle_.fanPercent();
  for (const PlacedPatch& patch : job_.patches) {
    if (patch.how.layer != layer.index) continue;
    nozzle_.fan(patch.how.fan < 0 ? layerFan : patch.how.fan);
    MotionLimits limits = layerLimits(layer, patch.how.flow);
    if (patch.how.speed > 0) limits.speed = patch.how.speed;
    if (patch.how.constantFlow) evenFlow(limits, patch.how.spacing);
    for (const BeadPath& path : patch.paths) {
      lay(path, 0, limits, layer, true);
      if (nozzle_.out().failed()) return;
    }
  }
}

// Travels to a path, lays it and leaves it. \param oriented  the path counts for the oriented length.
void LayerWriter::lay(const BeadPath& path, std::size_t start, const MotionLimits& limits, const FileLayer& layer,
                      bool oriented) {
  const Motion& motion = plans_.of(path, start, limits);
  std::vector<PointUm> way;
  if (layer.rim) {
    const PointUm at = nozzle_.at();
    const BeadPath* from = rimEnd_ != nullptr ? rimEnd_ : loopNearest(job_.rim, at);
    way = wayAlong(*from, at, job_.rim.front().back(), path, start);
  }
  way.push_back(motion.points.front());
  nozzle_.approach(way, layer.top);
  nozzle_.bead(motion, limits.flow, layer.height);
  if (nozzle_.out().failed()) return;
  nozzle_.leave(motion, limits.speed, layer.top, limits.scarf > 0 && path.closed);
  if (!oriented) return;
  for (const double piece : motion.lengths) oriented_.all += piece;
  oriented_.flowSlowed += motion.flowSlowedMm;
  oriented_.segmentSlowed += motion.segmentSlowedMm;
  oriented_.curveSlowed += motion.curveSlowedMm;
}

// Limits of a layer, slowed by its pace so that the plastic below can set.
MotionLimits LayerWriter::pacedLimits(const FileLayer& layer, double flow) const {
  MotionLimits limits = layerLimits(layer, flow);
  limits.speed = std::max(limits.speed * pace_[kindOf(layer)], std::min(limits.speed, kSlowestPace));
  return limits;
}

// Limits of a layer at full pace.
MotionLimits LayerWriter::layerLimits(const FileLayer& layer, double flow) const {
  MotionLimits limits = nozzle_.machineLimits();
  limits.layerHeight = layer.height;
  limits.flow = flow * printer_.filamentFlow;
  limits.filamentArea = filamentArea(printer_.filamentDiameter);
  limits.speed = layer.oriented ? job_.showSpeed : printer_.baseSpeed > 0 ? printer_.baseSpeed : printer_.speed;
  if (layer.first) limits.speed = std::min(printer_.firstLayerSpeed, limits.speed);
  if (layer.first) limits.acceleration = firstAcceleration();
  limits.maxFlow = printer_.maxFlow;
  limits.maxSegmentsPerSecond = printer_.maxSegmentsPerSecond;
  limits.pressureAdvance = printer_.pressureAdvance;
  limits.curveAcceleration = job_.knowsAdvance ? printer_.curveAcceleration : 0;
  limits.leastBead = kLeastBead * printer_.nozzle;
  return limits;
}

// Makes the volume per second constant: beads narrower than `spacing` are faster, wider ones slower.
void LayerWriter::evenFlow(MotionLimits& limits, double spacing) const {
  limits.evenFlow = limits.speed * spacing;
  limits.speed *= kFastest;
  if (printer_.machineSpeed > 0) limits.speed = std::min(limits.speed, printer_.machineSpeed);
}

double LayerWriter::firstAcceleration() const {
  const bool own = printer_.firstLayerAcceleration > 0 && printer_.firstLayerAcceleration < printer_.acceleration;
  return own ? printer_.firstLayerAcceleration : printer_.acceleration;
}

}  // namespace sillon
