// Directions that a project's layers want on each surface of a sliced file.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sillon/base/run_context.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/rebrush/rebrush.hpp"

namespace sillon {

/// Directions and modes that a surface shall have.
struct WantedDirections {
  DirectionMap directions;  ///< map over the page of the surface, as seen from above
  ModeMap modes;
};

/// Lays the layers once on all surfaces that share a page, and cuts each surface's directions out.
class DirectionSource {
 public:
  /// \param options, file  must outlive the source.
  DirectionSource(const RebrushOptions& options, const SlicedFile& file) : options_(options), file_(file) {}

  /// Directions that the layers want on a surface. \param block  index of SlicedFile::surfaces. \return the errors of
  /// readPlateInput and compose; InvalidArgument if PictureFit::Bed needs the bed and the file does not give it.
  Result<WantedDirections> of(std::size_t block, const RunContext& run);

  /// Tells how well a surface shows the pictures that were wanted of it last.
  Result<std::vector<JudgedPicture>> judge(std::size_t block, Toolpath toolpath, const RunContext& run) const;

  /// Composition from which `of` took the last directions.
  [[nodiscard]] const Composition& last() const { return last_->composition; }

 private:
  /// One composition, on the page that several surfaces share, as it is seen from the side that they show.
  struct LaidComposition {
    Composition composition;
    DirectionMap directions;  ///< map over the page, as seen from above
    ModeMap modes;
    Bounds page;  ///< place of the page on the bed [mm]
  };
  /// Page that a surface shares with others.
  [[nodiscard]] Result<Bounds> pageFor(const SlicedSurface& surface) const;
  /// Tells whether two surfaces lie on the same page.
  [[nodiscard]] bool share(const SlicedSurface& one, std::size_t index, const SlicedSurface& other) const;
  /// Regions of all surfaces that share a surface's page, as seen from the side that they show.
  [[nodiscard]] Shape shapeOn(const Bounds& page, const SlicedSurface& surface) const;
  /// Composes the layers on the page of a surface.
  Result<LaidComposition> lay(const SlicedSurface& surface, const RunContext& run) const;

  const RebrushOptions& options_;
  const SlicedFile& file_;
  std::map<std::string, LaidComposition> laid_;
  const LaidComposition* last_ = nullptr;
};

/// Tells whether the options ask for this surface. \param index  index of SlicedFile::surfaces.
bool isChosen(const SlicedSurface& surface, std::size_t index, const RebrushOptions& options);

}  // namespace sillon
