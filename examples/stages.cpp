// Draws what each stage of the pipeline makes of one project, as docs/internals/how-it-works.md shows it (./dev
// pictures).
//   stages PROJECT.json SPACING FOLDER
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "assemble.hpp"
#include "files.hpp"
#include "look/preview_parts.hpp"
#include "pipeline/stages.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/settings/table.hpp"

namespace {

using sillon::Rgb;
using sillon::Vec2;
using sillon::Vec2f;

constexpr double kPi = 3.14159265358979323846;
constexpr int kSide = 480;      // longer side of a picture [pixels]
constexpr double kMargin = 12;  // around the page [pixels]
constexpr Rgb kPaper{250, 250, 248};
constexpr Rgb kInk{38, 40, 46};
constexpr Rgb kPale{205, 205, 208};

[[noreturn]] void fail(const std::string& message) {
  std::fprintf(stderr, "stages: %s\n", message.c_str());
  std::exit(2);
}

template <class T>
T need(sillon::Result<T> result) {
  if (!result) fail(result.error().message);
  return std::move(result).value();
}

Rgb mixed(Rgb a, Rgb b, double share) {
  const auto channel = [share](int from, int to) {
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * std::clamp(share, 0.0, 1.0)));
  };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

/// A picture of the page: y up in mm, row 0 on top in pixels.
class Picture {
 public:
  explicit Picture(Vec2 page)
      : scale_((kSide - 2 * kMargin) / std::max(page.x, page.y)),
        width_(static_cast<int>(std::lround(page.x * scale_ + 2 * kMargin))),
        height_(static_cast<int>(std::lround(page.y * scale_ + 2 * kMargin))),
        rgb_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kPaper) {}

  /// Every pixel takes the mean of colourAt(point [mm]) over 3 x 3 samples.
  template <class ColourAt>
  void fill(const ColourAt& colourAt) {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        std::array<int, 3> sum{};
        for (int k = 0; k < 9; ++k) {
          const Rgb c = colourAt(pointAt(x + (k % 3 + 0.5) / 3, y + (k / 3 + 0.5) / 3));
          sum[0] += c.red, sum[1] += c.green, sum[2] += c.blue;
        }
        const auto mean = [&](std::size_t k) { return static_cast<std::uint8_t>((sum[k] + 4) / 9); };
        at(x, y) = {mean(0), mean(1), mean(2)};
      }
    }
  }

  /// A stroke with round ends; widths in mm, linear between the ends.
  void stroke(Vec2 a, Vec2 b, double widthA, double widthB, Rgb colour) {
    const Vec2 from = pixelOf(a), to = pixelOf(b);
    const double ra = widthA * scale_ / 2, rb = widthB * scale_ / 2, reach = std::max(ra, rb) + 1;
    const int x0 = std::max(0, static_cast<int>(std::min(from.x, to.x) - reach));
    const int x1 = std::min(width_ - 1, static_cast<int>(std::max(from.x, to.x) + reach));
    const int y0 = std::max(0, static_cast<int>(std::min(from.y, to.y) - reach));
    const int y1 = std::min(height_ - 1, static_cast<int>(std::max(from.y, to.y) + reach));
    const Vec2 along = to - from;
    const double squared = std::max(dot(along, along), 1e-12);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const Vec2 p{x + 0.5, y + 0.5};
        const double t = std::clamp(dot(p - from, along) / squared, 0.0, 1.0);
        const double covered = std::clamp(ra + (rb - ra) * t - length(p - (from + along * t)) + 0.5, 0.0, 1.0);
        if (covered > 0) at(x, y) = mixed(at(x, y), colour, covered);
      }
    }
  }
  /// \param pixels  width of the stroke, however large the page is.
  void line(Vec2 a, Vec2 b, double pixels, Rgb colour) { stroke(a, b, pixels / scale_, pixels / scale_, colour); }

  [[nodiscard]] std::string png() const {
    std::vector<std::uint8_t> bytes;
    for (const Rgb& c : rgb_) bytes.insert(bytes.end(), {c.red, c.green, c.blue});
    const std::vector<std::uint8_t> png = sillon::encodePng(width_, height_, bytes);
    return {png.begin(), png.end()};
  }

 private:
  [[nodiscard]] Vec2 pointAt(double x, double y) const {
    return {(x - kMargin) / scale_, (height_ - kMargin - y) / scale_};
  }
  [[nodiscard]] Vec2 pixelOf(Vec2 p) const { return {p.x * scale_ + kMargin, height_ - kMargin - p.y * scale_}; }
  Rgb& at(int x, int y) {
    return rgb_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }

  double scale_;  // [pixels/mm]
  int width_;
  int height_;
  std::vector<Rgb> rgb_;
};

Vec2 wide(Vec2f p) { return {p.x, p.y}; }

/// The cell that holds a point, the nearest one outside of the grid.
std::size_t cellAt(const sillon::Grid& grid, Vec2 p) {
  const int x = std::clamp(static_cast<int>(std::floor((p.x - grid.origin.x) / grid.cell)), 0, grid.nx - 1);
  const int y = std::clamp(static_cast<int>(std::floor((p.y - grid.origin.y) / grid.cell)), 0, grid.ny - 1);
  return grid.index(x, y);
}

Rgb colourOfBead(Vec2f across) { return sillon::directionColourAt(sillon::directionColourPlace(-across.y, across.x)); }

/// Blue below 0, white at 0, orange above.
Rgb waveColour(double value) {
  constexpr Rgb low{36, 84, 150}, middle{247, 245, 240}, high{214, 120, 36};
  return value < 0 ? mixed(middle, low, -value) : mixed(middle, high, value);
}

/// Calls draw(a, b, share of the curve's points passed) for every segment of every curve.
template <class Draw>
void eachSegment(const sillon::ClosedCurves& curves, const Draw& draw) {
  for (int c = 0; c < curves.count(); ++c) {
    const int first = curves.begin[c], size = curves.size(c);
    for (int k = 0; k < size; ++k) {
      const auto a = static_cast<std::size_t>(first + k), b = static_cast<std::size_t>(first + (k + 1) % size);
      draw(c, wide(curves.points[a]), wide(curves.points[b]), static_cast<double>(k) / size);
    }
  }
}

sillon::ToolpathParams parametersOf(const sillon::Project& project, const char* spacing) {
  sillon::ToolpathParams params = project.toolpath;
  char* end = nullptr;
  params.spacing = std::strtod(spacing, &end);
  if (end == spacing || *end != '\0') fail("the spacing is \"" + std::string(spacing) + "\"; it must be a number [mm]");
  if (const auto wrong = sillon::invalidSettings(params)) fail(wrong->message);
  return params;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) fail("usage: stages PROJECT.json SPACING FOLDER");
  const sillon::Project project = need(sillon::cli::loadProject(arguments[1]));
  const sillon::ToolpathParams params = parametersOf(project, arguments[2]);
  const sillon::PlateInput input = need(sillon::cli::assemblePlate(project));
  const std::string folder = arguments[3];
  const sillon::RunContext run;
  const Vec2 page = input.shape.page;
  const double spacing = params.spacing;

  std::vector<sillon::cli::OutputFile> files;
  const auto keep = [&](const char* name, const Picture& picture) {
    files.push_back({folder + "/" + name + ".png", picture.png()});
  };

  // --- Shape and distance
  const sillon::Stages stages = need(sillon::generateStages(input, params, run));
  const sillon::Grid& grid = stages.sdf.grid;
  const sillon::BorderIndex& border = stages.border;
  const auto drawBorder = [&](Picture& picture, double pixels) {
    for (const auto& [a, b] : stages.outline.segments) picture.line(a, b, pixels, kInk);
  };
  Picture shape(page);
  shape.fill([&](Vec2 p) { return border.outside(p) ? kPaper : Rgb{222, 226, 232}; });
  drawBorder(shape, 2);
  keep("01-shape", shape);

  float deepest = 0;
  for (const float distance : stages.sdf.distance) deepest = std::min(deepest, distance);
  Picture distance(page);
  distance.fill([&](Vec2 p) {
    const double depth = (border.outside(p) ? 1 : -1) * std::abs(border.nearest(p).distance);
    const double rings = std::abs(std::remainder(depth, 2 * spacing)) / spacing;  // a line every two beads
    const Rgb ground = depth > 0 ? kPaper : mixed({196, 222, 236}, {20, 60, 110}, depth / deepest);
    return rings < 0.09 && depth < 0 ? mixed(ground, kPaper, 0.6) : ground;
  });
  drawBorder(distance, 2);
  keep("02-distance", distance);

  // --- What is asked for, and the lines that follow
  const sillon::CellConstraints& cells = stages.cells;
  Picture asked(page);
  asked.fill([&](Vec2 p) {
    const std::size_t i = cellAt(grid, p);
    if (border.outside(p)) return kPaper;
    if (cells.zone[i] == sillon::Zone::Masked || cells.zone[i] == sillon::Zone::Ring) return kInk;
    switch (cells.mode[i]) {
      case sillon::DirectionMode::Parallel:
        return Rgb{206, 66, 66};
      case sillon::DirectionMode::Orthogonal:
        return Rgb{58, 94, 190};
      case sillon::DirectionMode::Smoothest:
        return Rgb{240, 208, 84};
      default:
        break;
    }
    const Vec2f z = cells.mapLine[i];  // of the line across the bead: half its angle
    const double angle = std::atan2(z.y, z.x) / 2;
    const double grey = std::abs(std::cos(angle));
    return mixed({70, 70, 74}, {236, 236, 236}, grey);
  });
  keep("03-asked", asked);

  const sillon::LineField& lines = stages.lines;
  Picture directions(page);
  directions.fill([&](Vec2 p) {
    const Vec2f d = lines.direction[cellAt(grid, p)];
    return d == Vec2f{} || border.outside(p) ? kPaper : colourOfBead(d);
  });
  constexpr int kEvery = 4;  // cells between ticks
  for (int y = kEvery / 2; y < grid.ny; y += kEvery) {
    for (int x = kEvery / 2; x < grid.nx; x += kEvery) {
      const Vec2 d = wide(lines.direction[grid.index(x, y)]), centre = grid.centre(x, y);
      const Vec2 half = Vec2{-d.y, d.x} * (0.36 * kEvery * grid.cell);
      if (dot(d, d) > 0 && !border.outside(centre)) directions.line(centre - half, centre + half, 1.6, kInk);
    }
  }
  keep("04-lines", directions);

  // --- Waves
  const sillon::SineField& waves = stages.waves;
  const auto waveOf = [&](Vec2 p, bool aligned) {
    const std::size_t i = cellAt(grid, p);
    const Vec2 k = wide(waves.wave[i]);
    if (border.outside(p) || dot(k, k) == 0) return kPaper;
    const Vec2 centre = grid.centre(static_cast<int>(i) % grid.nx, static_cast<int>(i) / grid.nx);
    const double phase = aligned ? std::atan2(waves.phase[i].y, waves.phase[i].x) : 0;
    return waveColour(std::sin(kPi / spacing * dot(p - centre, k) + phase));
  };
  Picture before(page), after(page);
  before.fill([&](Vec2 p) { return waveOf(p, false); });
  after.fill([&](Vec2 p) { return waveOf(p, true); });
  keep("05-waves", before);
  keep("06-phases", after);

  const sillon::Grid nodes = sillon::nodeLattice(grid);
  const std::vector<float>& values = stages.nodeValues;
  Picture field(page);
  field.fill([&](Vec2 p) {
    const double u = std::clamp((p.x - nodes.origin.x) / nodes.cell - 0.5, 0.0, nodes.nx - 1.001);
    const double v = std::clamp((p.y - nodes.origin.y) / nodes.cell - 0.5, 0.0, nodes.ny - 1.001);
    const int x = static_cast<int>(u), y = static_cast<int>(v);
    const auto row = [&](int r) {
      return values[nodes.index(x, r)] * (x + 1 - u) + values[nodes.index(x + 1, r)] * (u - x);
    };
    return border.outside(p) ? kPaper : waveColour(row(y) * (y + 1 - v) + row(y + 1) * (v - y));
  });
  keep("07-field", field);

  // --- Curves
  const sillon::ClosedCurves& contour = stages.contour;
  Picture cycles(page);
  eachSegment(contour, [&](int c, Vec2 a, Vec2 b, double) {
    cycles.line(a, b, 2.6, mixed(sillon::directionColourAt(c * 97.0), kInk, 0.25));  // 97: neighbours differ
  });
  keep("08-contour", cycles);

  const sillon::Stitched& stitched = stages.stitched;
  Picture one(page);
  eachSegment(stitched.curves, [&](int, Vec2 a, Vec2 b, double share) {
    one.line(a, b, 2.6, mixed(sillon::directionColourAt(share * sillon::kDirectionColours), kInk, 0.25));
  });
  keep("09-stitched", one);

  const sillon::Relaxed& relaxed = stages.relaxed;
  Picture relaxation(page);
  eachSegment(stitched.curves, [&](int, Vec2 a, Vec2 b, double) { relaxation.line(a, b, 4, {240, 170, 110}); });
  eachSegment(relaxed.curves, [&](int, Vec2 a, Vec2 b, double) { relaxation.line(a, b, 1.6, kInk); });
  keep("10-relaxed", relaxation);

  // --- Beads
  const sillon::Toolpath& toolpath = stages.result.toolpath;
  Picture beads(page);
  for (const sillon::Cycle& cycle : toolpath.cycles) {
    for (std::size_t k = 0; k < cycle.points.size(); ++k) {
      const std::size_t next = (k + 1) % cycle.points.size();
      const double a = cycle.widths[k], b = cycle.widths[next];
      const double ratio = (a + b) / 2 / spacing - 1;  // blue is narrower than the spacing, orange is wider
      beads.stroke(wide(cycle.points[k]), wide(cycle.points[next]), 0.86 * a, 0.86 * b,
                   mixed(kPale, ratio < 0 ? Rgb{36, 84, 150} : Rgb{214, 120, 36}, 2.5 * std::abs(ratio)));
    }
  }
  drawBorder(beads, 1);
  keep("11-widths", beads);

  const sillon::RgbImage look = need(sillon::renderLook(toolpath, page, kSide, kSide, {}, run));
  const std::vector<std::uint8_t> png = sillon::encodePng(look.width, look.height, look.rgb);
  files.push_back({folder + "/12-look.png", std::string(png.begin(), png.end())});

  if (const auto error = sillon::cli::writeTogether(files)) fail(error->message);
  std::printf("%zu pictures, %d cycles joined to %zu toolpath, %zu points\n", files.size(), contour.count(),
              toolpath.cycles.size(), toolpath.cycles.front().points.size());
}
