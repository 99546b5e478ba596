// What each surface shall look like: maps cut to it, or pictures solved for it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sillon/base/run_context.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/quality/metrics.hpp"
#include "sillon/rebrush/rebrush.hpp"

namespace sillon {

struct WantedDirections {
  DirectionMap directions;
  ModeMap modes;
  std::vector<ShownPicture> shown;  ///< as seen from above, also of bottoms; empty without pictures
  std::vector<double> leftOut;      ///< share of each picture that is cut off, 0..1
  Roughness roughness;
};

/// Solves each picture once for all surfaces that share it.
class DirectionSource {
 public:
  /// \param options, file  must outlive this.
  DirectionSource(const RebrushOptions& options, const SlicedFile& file) : options_(options), file_(file) {}

  /// \return as solveDirections; InvalidArgument for a spool that is none, or if the file does not tell its bed where
  /// PictureFit::Bed needs it.
  Result<WantedDirections> of(std::size_t block, const RunContext& run);

 private:
  /// What the maps of a surface are stretched over; empty: its own page.
  [[nodiscard]] Result<Bounds> whole(const SlicedSurface& surface) const;
  /// The box around all surfaces that share a picture with this one.
  [[nodiscard]] Bounds shared(const SlicedSurface& surface) const;

  struct Solved {
    SolvedDirections directions;
    std::vector<double> leftOut;
  };

  const RebrushOptions& options_;
  const SlicedFile& file_;
  std::map<std::string, Solved> solved_;
};

/// Whether the options ask for this surface. \param index  of SlicedFile::surfaces
bool isChosen(const SlicedSurface& surface, std::size_t index, const RebrushOptions& options);

}  // namespace sillon
