// The layers as each surface of a sliced file shows them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sillon/base/run_context.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/rebrush/rebrush.hpp"

namespace sillon {

struct WantedDirections {
  DirectionMap directions;  ///< over the page of the surface, as seen from above
  ModeMap modes;
};

/// Lays the layers once on all surfaces that share a page.
class DirectionSource {
 public:
  /// \param options, file  must outlive this.
  DirectionSource(const RebrushOptions& options, const SlicedFile& file) : options_(options), file_(file) {}

  /// \return the errors of readPlateInput and compose; InvalidArgument if the file does not tell its bed where
  /// PictureFit::Bed needs it.
  Result<WantedDirections> of(std::size_t block, const RunContext& run);

  /// Tells how well a surface shows the pictures that were wanted of it last.
  Result<std::vector<JudgedPicture>> judge(std::size_t block, Toolpath toolpath, const RunContext& run) const;

  /// The composition that `of` gave directions of last.
  [[nodiscard]] const Composition& last() const { return last_->composition; }

 private:
  /// One composition, on the page that several surfaces share, as it is seen from the side that they show.
  struct Laid {
    Composition composition;
    DirectionMap directions;  ///< as seen from above
    ModeMap modes;
    Bounds page;  ///< on the bed
  };
  /// The page that a surface shares with others.
  [[nodiscard]] Result<Bounds> pageFor(const SlicedSurface& surface) const;
  /// Tells whether two surfaces lie on the same page.
  [[nodiscard]] bool share(const SlicedSurface& one, std::size_t index, const SlicedSurface& other) const;
  [[nodiscard]] Shape shapeOn(const Bounds& page, const SlicedSurface& surface) const;
  Result<Laid> lay(const SlicedSurface& surface, const RunContext& run) const;

  const RebrushOptions& options_;
  const SlicedFile& file_;
  std::map<std::string, Laid> laid_;
  const Laid* last_ = nullptr;
};

/// Tells whether the options ask for this surface. \param index  of SlicedFile::surfaces
bool isChosen(const SlicedSurface& surface, std::size_t index, const RebrushOptions& options);

}  // namespace sillon
