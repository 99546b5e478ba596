// Layers with contents of a kind.
#pragma once

#include <utility>

#include "sillon/settings/layers.hpp"

/// A layer that has no place of its own.
inline sillon::Layer layerOf(sillon::LayerContents contents) {
  sillon::Layer layer;
  layer.contents = std::move(contents);
  return layer;
}
