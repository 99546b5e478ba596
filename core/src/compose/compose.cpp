#include "sillon/compose/compose.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "base/exact_math.hpp"
#include "compose/background.hpp"
#include "compose/content.hpp"
#include "compose/ink.hpp"
#include "compose/placement.hpp"
#include "compose/visible.hpp"
#include "input/stored_angle.hpp"

namespace sillon {
namespace {

constexpr double kTexelsPerBead = 4;
constexpr int kMostTexels = 4096;  // on a side

Error ofLayer(std::size_t number, const Error& error) {
  if (error.code == ErrorCode::Cancelled) return error;
  Error told = error;
  told.message = "layers[" + std::to_string(number) + "]: " + error.message;
  return told;
}

/// Content and place of each layer that is read; the others keep their size.
struct ReadLayer {
  LayerContent content;
  Placement place;
};

Result<ReadLayer> readLayer(const Layer& layer, const Shape& shape, const ReadInput& read) {
  Result<LayerContent> content = readContent(layer, shape.page, read);
  if (!content) return content.error();
  const Placement place(layer, layer.at.value_or(shape.page * 0.5), content.value().size);
  return ReadLayer{std::move(content).value(), place};
}

/// \param spacing  of the beads that letters may be too thin for; 0: that is known.
PlacedLayer placedLayer(LayerKind kind, const ReadLayer& layer, double spacing) {
  PlacedLayer placed{layer.place.middle(), layer.place.size(), 0, {}, {}};
  for (const std::optional<Shape>* drawn : {&layer.content.shape, &layer.content.mask}) {
    if (!*drawn) continue;
    DrawingFacts facts = (*drawn)->drawing;
    placed.lacked.insert(placed.lacked.end(), facts.lacked.begin(), facts.lacked.end());
    facts.lacked.clear();                                                          // they are told with the layer's own
    facts.severalColours = facts.severalColours && drawn == &layer.content.shape;  // a mask shows no colours
    placed.drawings.push_back(std::move(facts));
  }
  if (spacing > 0 && (kind == LayerKind::Text || kind == LayerKind::Drawing)) {
    Shape shape = *layer.content.shape;
    const Vec2 scale{placed.size.x / shape.page.x, placed.size.y / shape.page.y};
    for (FilledPath& path : shape.paths) {
      for (Ring& ring : path.rings) {
        for (Vec2& point : ring) point = {point.x * scale.x, point.y * scale.y};
      }
    }
    shape.page = placed.size;
    placed.thin = thinShare(shape, spacing);
  }
  return placed;
}

/// The box of a layer that is not made.
PlacedLayer boxOf(const Layer& layer, const Shape& shape, std::optional<Error> problem = {}) {
  return {layer.at.value_or(shape.page * 0.5), layer.size, 0, std::move(problem), {}};
}

bool lacksLetter(const Error& error) {
  const std::string_view why = error.reason;
  return why == reason::kMissingLetter || why == reason::kPictureLetter;
}

int texelsOn(double side, double spacing) {
  return std::clamp(static_cast<int>(std::ceil(side / spacing * kTexelsPerBead)), 1, kMostTexels);
}

}  // namespace

Result<LayerStack> makeLayers(const Project& project, const Shape& shape, const ReadInput& read, const RunContext& run,
                              const LayerStack* before) {
  LayerStack stack;
  const double spacing = project.toolpath.spacing;
  for (std::size_t k = 0; k < project.layers.size(); ++k) {
    const Layer& layer = project.layers[k];
    if (!layer.visible) {
      stack.placed.push_back(boxOf(layer, shape));
      continue;
    }
    const Result<ReadLayer> known = readLayer(layer, shape, read);
    if (!known && lacksLetter(known.error())) {
      stack.placed.push_back(boxOf(layer, shape, ofLayer(k, known.error())));
      continue;
    }
    if (!known) return ofLayer(k, known.error());
    stack.placed.push_back(placedLayer(layer.kind, known.value(), before == nullptr ? spacing : 0));
    if (stack.width == 0) {
      stack.width = texelsOn(shape.page.x, spacing);
      stack.height = texelsOn(shape.page.y, spacing);
      stack.texels.resize(static_cast<std::size_t>(stack.width) * static_cast<std::size_t>(stack.height));
      markPlate({project, shape, stack.width, stack.height}, stack);
    }
    if (before != nullptr && before->pictures.contains(k)) stack.pictures[k] = before->pictures.at(k);
    const auto& [content, place] = known.value();
    if (auto error = drawLayer(k, content, place, {project, shape, stack.width, stack.height}, stack, run)) {
      return ofLayer(k, *error);
    }
  }
  return stack;
}

std::vector<Warning> letterWarnings(const std::vector<PlacedLayer>& placed) {
  std::vector<Warning> warnings;
  for (std::size_t k = 0; k < placed.size(); ++k) {
    const auto number = static_cast<double>(k + 1);
    if (const auto& problem = placed[k].problem) {
      const bool picture = std::string_view(problem->reason) == reason::kPictureLetter;
      warnings.push_back({picture ? WarningCode::LayerOnlyPicture : WarningCode::LayerLeftOut,
                          {{"layer", number}, {"letter", problem->values.back().text}}});
    }
    std::vector<Warning> more = letterWarnings(placed[k].lacked, k + 1);
    warnings.insert(warnings.end(), more.begin(), more.end());
  }
  return warnings;
}

std::vector<PlacedLayer> placeLayers(const Project& project, const Shape& shape, const ReadInput& read) {
  std::vector<PlacedLayer> placed;
  for (std::size_t k = 0; k < project.layers.size(); ++k) {
    const Layer& layer = project.layers[k];
    const Result<ReadLayer> known = readLayer(layer, shape, read);
    placed.push_back(known ? placedLayer(layer.kind, known.value(), project.toolpath.spacing)
                           : boxOf(layer, shape, ofLayer(k, known.error())));
  }
  return placed;
}

void layOver(const LayerStack& stack, PlateInput& input) {
  if (stack.width == 0) return;
  const Background background(input.directions, stack.width, stack.height);
  const auto texels = stack.texels.size();
  DirectionMap directions{stack.width, stack.height, std::vector<std::uint16_t>(texels)};
  ModeMap modes{stack.width, stack.height, std::vector<DirectionMode>(texels)};
  const auto below = [](int k, int from, int to) { return static_cast<int>((k + 0.5) * to / from); };
  for (int y = 0; y < stack.height; ++y) {
    for (int x = 0; x < stack.width; ++x) {
      const auto k = static_cast<std::size_t>(y) * static_cast<std::size_t>(stack.width) + static_cast<std::size_t>(x);
      const LayerStack::Texel& texel = stack.texels[k];
      const auto column = static_cast<std::size_t>(below(x, stack.width, input.modes.width));
      const auto row = static_cast<std::size_t>(below(y, stack.height, input.modes.height));
      modes.mode[k] = texel.cover >= 0.5F
                          ? DirectionMode::Constrained
                          : input.modes.mode[row * static_cast<std::size_t>(input.modes.width) + column];
      if (texel.cover == 0) {
        directions.angle[k] = background.angleAt(x, y);
        continue;
      }
      Vec2 line = wide(texel.line);
      if (texel.through != 0) {
        const exact::SinCos turn = exact::sinCos(2 * angleOf(background.angleAt(x, y)));
        line = line + Vec2{turn.cos, turn.sin} * static_cast<double>(texel.through);
      }
      directions.angle[k] = storedAngle(exact::atan2(line.y, line.x) / (2 * std::numbers::pi));
    }
  }
  input.showsPictures = input.showsPictures || !stack.pictures.empty();
  input.directions = std::move(directions);
  input.modes = std::move(modes);
}

}  // namespace sillon
