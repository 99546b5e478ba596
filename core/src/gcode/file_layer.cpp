#include "gcode/layers.hpp"

namespace sillon {

FileLayer layerAt(const PrintParams& params, int copy, int index) {
  FileLayer layer;
  layer.index = index;
  layer.copy = copy;
  layer.top = layerTop(params, index);
  layer.height = index == 0 ? firstLayerHeight(params) : params.layerHeight;
  layer.first = index == 0 && beginsOnBed(params);
  layer.oriented = isOriented(params, index);
  layer.onBed = params.showSide == ShowSide::Both && index < params.layers;
  layer.rim = index >= layersBelowRim(params);
  const int below = params.showSide == ShowSide::Up ? params.base : params.layers;  // the other kind begins here
  layer.turn = index < below ? index : index - below;
  if (!layer.oriented && !layer.rim && needsAcross(params)) layer.across = nextTo(params, layer.turn);
  return layer;
}

std::size_t kindOf(const FileLayer& layer) {
  if (layer.index == 0) return layer.copy == 0 ? 0 : 1;
  if (layer.rim) return 8;
  if (layer.across != NextTo::Base) return layer.across == NextTo::Oriented ? 6 : 7;
  return layer.onBed ? 5 : layer.oriented ? 4 : 2 + layer.turn % 2;
}

}  // namespace sillon
