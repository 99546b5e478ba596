// sillon shape: what is read of a drawing or a mask, without a plate.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cli {

struct ShapeArguments {
  std::vector<std::string> files;
  std::optional<double> width;  ///< of the page [mm]; unset: as drawn
  bool ignorePaint = false;
  bool json = false;
};

struct ShapeAnswer {
  std::string text;
  bool failed = false;  ///< a file could not be read; `text` says which
};

/// Page, area and notes of each file, one after the other, however many of them fail.
ShapeAnswer describeShapes(const ShapeArguments& arguments);

}  // namespace cli
