// What every report of a plate holds.
#pragma once

#include <doctest/doctest.h>

/// \param report  a nlohmann::json object.
template <class Json>
void checkReportKeys(const Json& report) {
  for (const char* key : {"grid",
                          "parts",
                          "cycles",
                          "toolpaths",
                          "lengthMm",
                          "alignment",
                          "alignmentInterior",
                          "alignmentConstrained",
                          "coverage",
                          "overlap",
                          "spill",
                          "uTurns",
                          "kinks",
                          "crossings",
                          "width",
                          "fillRatio",
                          "lostAreaMm2",
                          "lostPlaces",
                          "keptAreaMm2",
                          "keptPlaces",
                          "longestJointMm",
                          "gapJoints",
                          "unjoined",
                          "time",
                          "peakBytes",
                          "threads",
                          "digest"}) {
    CAPTURE(key);
    CHECK(report.contains(key));
  }
}
