#include "pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "files.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/settings/table.hpp"
#include "words.hpp"

namespace sillon::cli {
namespace {

constexpr double kElevation = 45;  // default elevation of lamps [degrees]

/// Parses "AZ" or "AZ,EL".
std::optional<Vec2> lampOf(const std::string& text) {
  const std::size_t comma = text.find(',');
  const std::optional<double> azimuth = parseNumber(text.substr(0, comma));
  if (!azimuth || !(std::abs(*azimuth) <= 360)) return std::nullopt;
  if (comma == std::string::npos) return Vec2{*azimuth, kElevation};
  const std::optional<double> elevation = parseNumber(text.substr(comma + 1));
  if (!elevation || !(*elevation >= 1 && *elevation <= 90)) return std::nullopt;
  return Vec2{*azimuth, *elevation};
}

/// Sets a choice of the pictures from its option, which has the name of its key.
/// \param besides  further names for the message.
/// \return an error, or an empty string
std::string choose(const char* key, const std::string& word, const std::vector<std::string>& besides,
                   Project& project) {
  const Setting& row = *findSetting(Section::Pictures, key);
  const std::vector<std::string> words = splitWords(row.choices);
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) {
    std::string all = words.front();
    for (std::size_t k = 1; k < words.size(); ++k) all += ", " + words[k];
    for (const std::string& other : besides) all += ", " + other;
    return std::string("--") + key + " is \"" + word + "\"; it must be one of " + all;
  }
  sillon::choose(row.field(viewOf(project)), found - words.begin());
  return "";
}

std::string likeness(const PictureMeasures& measures) {
  char text[80];
  std::snprintf(text, sizeof text, ": r %.3f, SSIM %.3f, contrast %.1f", measures.r, measures.ssim, measures.contrast);
  return text;
}

}  // namespace

void addPictures(Options& options, PictureOptions& pictures) {
  options.group("Pictures");
  options.list("--picture", "F", "picture to show under a lamp; repeat for more, one lamp each",
               [&pictures](const std::string& text) { pictures.files.push_back(text); });
  options.excludes("--picture", "--directions");
  options.excludes("--picture", "--angle");
  options.list("--lamp", "AZ[,EL]",
               "lamp azimuth and elevation in degrees, one per picture in order; --preview uses it too [chosen]",
               [&pictures](const std::string& text) { pictures.lamps.push_back(text); });
  options.text("--lamp-size", "SIZE", "size of the lamps: " + lampSizeRange() + " [softbox]", pictures.lampSize);
  options.take("--proportions", "HOW", "how a picture of other proportions fits the page [keep]",
               [&pictures](const std::string& text) { pictures.proportions = text; },
               {{"keep", "cut off what sticks out of the page"}, {"stretch", "stretch the picture over the page"}});
  addSpools(options, pictures);
  options.number("--smoothness", "F", "higher values give fewer U-turns and less detail [0.02]", pictures.smoothness);
  options.number("--local-contrast", "F", "how far to raise what differs from its surroundings [0]",
                 pictures.localContrast);
}

void addSpools(Options& options, PictureOptions& pictures) {
  options.text("--spool", "KEY", "look of the filament, as sillon spools lists it [bluePla]", pictures.spool);
  options.text("--spools", "F.json", "file of your own spools, of which --spool names one", pictures.spoolsFile);
}

std::array<std::pair<const char*, double>, 3> lampSizes() {
  return {{{"bulb", bulbSlope()}, {"softbox", softboxSlope()}, {"window", windowSlope()}}};
}

std::string lampSizeRange() {
  std::vector<std::string> names;
  for (const auto& [name, slope] : lampSizes()) names.emplace_back(name);
  names.emplace_back("a slope from 0 to 2");
  return listed(names);
}

std::optional<double> lampSlopeOf(const std::string& size) {
  for (const auto& [name, slope] : lampSizes()) {
    if (size == name) return slope;
  }
  return parseNumber(size);
}

std::optional<Error> readOwnSpools(PictureOptions& options) {
  if (options.spoolsFile.empty()) return std::nullopt;
  const Result<std::string> text = readFile(options.spoolsFile, "file of spools", kMaxSpoolsBytes);
  if (!text) return text.error();
  Result<std::vector<Spool>> read = readSpools(text.value());
  if (!read) return Error{read.error().code, "\"" + options.spoolsFile + "\": " + read.error().message};
  options.ownSpools = std::move(read).value();
  return std::nullopt;
}

const Spool* ownSpool(const PictureOptions& options) {
  for (const Spool& spool : options.ownSpools) {
    if (options.spool == spool.key) return &spool;
  }
  return nullptr;
}

std::string applyPictures(const PictureOptions& options, Project& project) {
  std::vector<std::optional<Vec2>> lamps;
  for (const std::string& text : options.lamps) {
    lamps.push_back(lampOf(text));
    if (lamps.back()) continue;
    return "--lamp is \"" + text +
           "\"; it must be AZ or AZ,EL: azimuth from -360 to 360 degrees counter-clockwise from the right, elevation "
           "from 1 to 90 degrees";
  }
  if (options.lampSize) {
    const std::optional<double> slope = lampSlopeOf(*options.lampSize);
    if (!slope || !(*slope >= 0 && *slope <= 2)) {
      return "--lamp-size is \"" + *options.lampSize + "\"; it must be " + lampSizeRange();
    }
    project.pictures.lampSize = *slope;
  }
  if (!options.spoolsFile.empty() && !options.spool) {
    return "--spools is \"" + options.spoolsFile + "\", but no --spool is given; it must name one";
  }
  if (const Spool* own = ownSpool(options)) {
    const bool bed = project.print.showSide == ShowSide::Bed;
    const Roughness slopes = sillon::roughnessOf(*own, project.printer.nozzle, bed);
    project.pictures.slopes = Vec2{slopes.along, slopes.across};
  } else if (options.spool) {
    std::vector<std::string> own;
    for (const Spool& spool : options.ownSpools) own.push_back(spool.key);
    if (std::string problem = choose("spool", *options.spool, own, project); !problem.empty()) return problem;
    project.pictures.slopes.reset();  // removes the slopes of an own spool
  }
  if (options.proportions) {
    if (std::string problem = choose("proportions", *options.proportions, {}, project); !problem.empty())
      return problem;
  }
  if (options.smoothness) project.pictures.smoothness = *options.smoothness;
  if (options.localContrast) project.pictures.localContrast = *options.localContrast;
  const std::size_t count = groundPictures(project.layers).size();
  if (lamps.size() > std::max<std::size_t>(1, count)) {
    return "--lamp is given " + plural(lamps.size(), "time") + " for " + plural(count, "picture") +
           "; give at most one for each picture";
  }
  for (std::size_t k = 0; k < std::min(lamps.size(), count); ++k) {
    project.layers[0].as<PictureLayer>()->pictures[k].lamp = lamps[k];
  }
  return "";
}

bool looksLikePicture(const std::string& path) {
  constexpr std::array<std::string_view, 5> kEndings{".png", ".jpg", ".jpeg", ".bmp", ".tga"};
  if (std::any_of(kEndings.begin(), kEndings.end(), [&](std::string_view end) { return endsWith(path, end); })) {
    return true;
  }
  std::error_code error;
  if (!std::filesystem::is_regular_file(pathOf(path), error)) return false;  // reading would use up a pipe
  std::array<char, 32> head{};
  std::ifstream in(pathOf(path), std::ios::binary);
  in.read(head.data(), head.size());
  return beginsLikePicture({reinterpret_cast<const std::uint8_t*>(head.data()), sillon::toSize(in.gcount())});
}

LookParams previewLook(const PictureOptions& options, const Project& project, const PlatePictures& pictures,
                       std::size_t picture) {
  LookParams look = sillon::lookOf(project, pictures, picture);
  if (const Spool* own = ownSpool(options)) look.colour = own->colour;
  if (picture < pictures.shown.size() || options.lamps.empty()) return look;
  const Vec2 lamp = lampOf(options.lamps[0]).value_or(Vec2{look.lamp.azimuth, look.lamp.elevation});
  look.lamp.azimuth = lamp.x;
  look.lamp.elevation = lamp.y;
  return look;
}

std::string cutOffNote(double leftOut) {
  constexpr double kTold = 0.03;
  if (leftOut < kTold) return {};
  char text[120];
  std::snprintf(text, sizeof text,
                "%.0f %% of it is cut off to keep its proportions; --proportions stretch squeezes all of it in",
                100 * leftOut);
  return text;
}

std::string pictureLines(const Plate& plate) {
  const PlatePictures& pictures = plate.pictures();
  std::string out;
  for (std::size_t k = 0; k < pictures.shown.size(); ++k) {
    const ShownPicture& shown = pictures.shown[k];
    char text[160];
    std::snprintf(text, sizeof text, " under a lamp at %.0f degrees, %.0f high%s", shown.lamp.azimuth,
                  shown.lamp.elevation, pictures.chosen[k] ? " (chosen)" : "");
    out += "picture    " + shown.file + text;
    if (k < plate.shown.size()) out += likeness(plate.shown[k].measures);
    out += "\n";
    const std::string note = cutOffNote(pictures.leftOut[k]);
    if (!note.empty()) out += "note       " + note + "\n";
  }
  for (std::size_t k = pictures.shown.size(); k < plate.shown.size(); ++k) {
    const JudgedPicture& one = plate.shown[k];
    char text[160];
    std::snprintf(text, sizeof text, " in layer %zu under a lamp at %.0f degrees, %.0f high", one.layer,
                  one.lamp.azimuth, one.lamp.elevation);
    out += "picture    " + one.file + text + likeness(one.measures) + "\n";
  }
  if (!pictures.shown.empty() && pictures.contrast < kWeakContrast) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "note       this spool under this lamp shows white only %.1f times as bright as black\n",
                  pictures.contrast);
    out += text;
  }
  return out;
}

}  // namespace sillon::cli
