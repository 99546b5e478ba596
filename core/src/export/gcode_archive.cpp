#include "sillon/export/export.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/json.hpp"
#include "base/numbers.hpp"
#include "base/refused.hpp"
#include "export/packing.hpp"
#include "export/zip.hpp"
#include "sillon/settings/presets.hpp"

namespace sillon {
namespace {

bool isZip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t kMostMetadata = std::size_t{64} << 20;
// Growth of all but the G-code when a file is replaced [bytes]; the reserve of its buffer.
constexpr std::size_t kMostRecords = std::size_t{1} << 16;
constexpr double kMoved = 0.5;      // [mm]; a box that changes by less has not moved
constexpr int kSmallPicture = 128;  // [pixels], side of plate_1_small.png

// ---- A new package.

std::string metadata(std::string_view key, const std::string& value) {
  return "    <metadata key=\"" + std::string(key) + "\" value=\"" + value + "\"/>\n";
}

std::string weightOf(std::string_view gcode) {
  const std::string prusa = toldValue(gcode, "total filament used [g]");
  return prusa.empty() ? toldValue(gcode, "total filament weight [g]") : prusa;
}

std::string metresOf(std::string_view gcode) {
  const std::string mm = toldValue(gcode, "filament used [mm]");
  const std::string text = mm.empty() ? toldValue(gcode, "total filament length [mm]") : mm;
  const std::optional<double> value = plainNumber(text);
  return value ? fixed(*value / 1000, 2) : "";
}

// Time of the whole print. Bambu's own files give it in their header block, behind the time of the beads.
std::optional<std::uint64_t> secondsOf(std::string_view gcode) {
  std::string text = toldValue(gcode, "estimated printing time (normal mode)");
  if (text.empty()) text = toldValue(gcode, "total estimated time", "");
  if (text.empty()) text = toldValue(gcode, "model printing time");
  return text.empty() ? std::nullopt : std::optional(toldSeconds(text));
}

// slice_info.config, from which the printer reads time, weight and filament.
std::string sliceInfo(std::string_view gcode, int filament) {
  std::string out = std::string(kXml) + "<config>\n  <plate>\n" + metadata("index", "1");
  out += metadata("nozzle_diameters", toldValue(gcode, "nozzle_diameter"));
  out += metadata("prediction", std::to_string(secondsOf(gcode).value_or(0)));
  out += metadata("weight", weightOf(gcode));
  out += metadata("outside", "false") + metadata("support_used", "false") + metadata("label_object_enabled", "false");
  const std::string colour = toldValue(gcode, "filament_colour");
  return out + "    <filament id=\"" + std::to_string(filament + 1) + "\" tray_info_idx=\"\" type=\"" +
         toldValue(gcode, "filament_type") + "\" color=\"" + (colour.empty() ? "#FFFFFF" : colour) + "\" used_m=\"" +
         metresOf(gcode) + "\" used_g=\"" + weightOf(gcode) + "\"/>\n  </plate>\n</config>\n";
}

// Tells whether the G-code is for a Bambu printer. Its header block alone does not, because Orca writes it for all
// printers.
bool isForBambu(std::string_view gcode) {
  if (gcode.substr(0, kTold).find("; HEADER_BLOCK_START") == std::string_view::npos) return false;
  const std::optional<PrinterProfile> known = profileOf(toldValue(gcode, "printer_model"));
  const std::string dialect = toldValue(gcode, "gcode_flavor");
  return known ? known->printer.flavor == GcodeFlavor::Bambu : dialect.empty() || dialect == "marlin";
}

double rounded(double value) { return std::round(value * 1000) / 1000; }

OrderedJson corners(const Bounds& box) {
  return OrderedJson::array({rounded(box.min.x), rounded(box.min.y), rounded(box.max.x), rounded(box.max.y)});
}

// plate_1.json, from which the printer's screen and the slicers read where the plate lies.
std::string plateInfo(std::string_view gcode, int filament) {
  OrderedJson object = OrderedJson::object();
  const Bounds box = printedBox({gcode});
  const Bounds shown = box.empty() ? Bounds{{0, 0}, {0, 0}} : box;
  object["bbox"] = corners(shown);
  object["id"] = 1;
  object["name"] = "plate";
  OrderedJson root = OrderedJson::object();
  root["bbox_all"] = corners(shown);
  root["bbox_objects"] = OrderedJson::array({object});
  root["first_extruder"] = filament;
  root["is_seq_print"] = false;
  root["nozzle_diameter"] = plainNumber(toldValue(gcode, "nozzle_diameter")).value_or(0.4);
  root["version"] = 2;
  return root.dump() + "\n";
}

// The PNG whose width is nearest to `width`; empty: there is none.
std::string nearestPng(const std::vector<ToldPicture>& pictures, int width) {
  const ToldPicture* best = nullptr;
  for (const ToldPicture& picture : pictures) {
    if (picture.format != "PNG" || !picture.bytes.starts_with("\x89PNG")) continue;
    if (best == nullptr || std::abs(picture.width - width) < std::abs(best->width - width)) best = &picture;
  }
  return best == nullptr ? "" : best->bytes;
}

// ---- A package whose G-code is replaced.

// Finds the first plate, by number: plate_2 comes before plate_10.
const ZipEntry* plateOf(const ZipDirectory& directory) {
  const ZipEntry* best = nullptr;
  for (const ZipEntry& entry : directory.entries) {
    if (!entry.name.ends_with(".gcode")) continue;
    const bool shorter =
        best != nullptr &&
        (entry.name.size() != best->name.size() ? entry.name.size() < best->name.size() : entry.name < best->name);
    if (best == nullptr || shorter) best = &entry;
  }
  return best;
}

// Error of an archive without G-code; it tells whether the plate is just not sliced yet.
Error holdsNoPlate(const ZipDirectory& directory) {
  const auto& parts = directory.entries;
  const bool package =
      std::any_of(parts.begin(), parts.end(), [](const ZipEntry& part) { return part.name.ends_with(".model"); });
  if (package) return refusedFile("PackedEmpty", {{"file", ".gcode.3mf"}});
  return refusedFile("ArchiveEmpty");
}

// Width of a PNG [pixels]; 0 if it is none.
int widthOfPng(std::string_view png) {
  if (!png.starts_with("\x89PNG") || png.size() < 24) return 0;
  int width = 0;
  for (std::size_t k = 16; k < 20; ++k) width = width << 8 | static_cast<std::uint8_t>(png[k]);
  return width;
}

/// Replaces the value of an attribute; an empty value changes nothing.
void replaceAttribute(std::string& xml, std::string_view before, std::string_view name, const std::string& value,
                      std::size_t from, std::size_t& to) {
  const TextRange place = attribute(xml, before, name, from, to);
  if (value.empty() || place.end == 0) return;
  xml.replace(place.begin, place.end - place.begin, value);
  to = to + value.size() - (place.end - place.begin);
}

// New prediction of a slicer: it changes by the difference of the two times in the files, because the slicer may count
// other times as well. Empty: it stays.
std::string newPrediction(std::string_view old, std::string_view before, std::string_view after) {
  const auto was = secondsOf(before);
  const auto is = secondsOf(after);
  if (!is || was == is) return "";
  const auto told = plainNumber(old);
  if (!was || !told) return std::to_string(*is);
  const double more = static_cast<double>(*is) - static_cast<double>(*was);
  return fixed(std::max(0.0, *told + more), 0);
}

// Finds the part of slice_info.config about a plate; empty without one.
TextRange partOf(std::string_view xml, std::string_view plate) {
  const std::size_t from = xml.find("<metadata key=\"index\" value=\"" + std::string(plate) + "\"");
  if (from == std::string::npos) return {};
  return {from, std::min(xml.find("</plate>", from), xml.size())};
}

// Updates time and weight of the plate where they differ between the two files.
std::string newSliceInfo(std::string xml, std::string_view plate, std::string_view before, std::string_view after) {
  auto [from, to] = partOf(xml, plate);
  if (to == 0) return xml;
  constexpr std::string_view kPrediction = "<metadata key=\"prediction\"";
  const TextRange old = attribute(xml, kPrediction, "value", from, to);
  const std::string told = xml.substr(old.begin, old.end - old.begin);
  replaceAttribute(xml, kPrediction, "value", newPrediction(told, before, after), from, to);
  if (weightOf(before) == weightOf(after) && metresOf(before) == metresOf(after)) return xml;
  replaceAttribute(xml, "<metadata key=\"weight\"", "value", weightOf(after), from, to);
  const std::size_t filament = xml.find("<filament ", from);
  const bool single = filament < to && xml.find("<filament ", filament + 1) >= to;
  if (single) {  // with several filaments their shares are unknown
    replaceAttribute(xml, "<filament ", "used_m", metresOf(after), from, to);
    replaceAttribute(xml, "<filament ", "used_g", weightOf(after), from, to);
  }
  return xml;
}

// Replaces the boxes in plate_1.json.
std::string newPlateInfo(const std::string& text, const Bounds& box) {
  OrderedJson root = OrderedJson::parse(text, nullptr, false);
  if (!root.is_object() || box.empty()) return text;
  root["bbox_all"] = corners(box);
  if (root.contains("bbox_objects") && root["bbox_objects"].is_array() && !root["bbox_objects"].empty() &&
      root["bbox_objects"][0].is_object()) {
    OrderedJson object = root["bbox_objects"][0];
    object["bbox"] = corners(box);
    root["bbox_objects"] = OrderedJson::array({object});
  }
  return root.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

// Joins the first `size` bytes of a text in parts.
std::string firstOf(const std::vector<std::string_view>& parts, std::size_t size) {
  std::string out;
  out.reserve(size);
  for (const std::string_view part : parts) {
    out += part.substr(0, size - out.size());
    if (out.size() == size) break;
  }
  return out;
}

// The part of a text that toldValue and toldPictures read: its beginning and its end.
std::string toldPart(const std::vector<std::string_view>& parts, std::size_t size) {
  if (size <= 2 * kTold) return firstOf(parts, size);
  std::vector<std::string_view> ending;
  std::size_t rest = kTold;
  for (auto part = parts.rbegin(); rest > 0; ++part) {
    const std::size_t more = std::min(rest, part->size());
    ending.insert(ending.begin(), part->substr(part->size() - more));
    rest -= more;
  }
  return firstOf(parts, kTold) + firstOf(ending, kTold);
}

}  // namespace

Result<std::string> packGcode(std::string_view gcode) {
  if (const auto problem = tooLargeToPack(gcode.size())) return *problem;
  if (!isForBambu(gcode)) return refusedArgument("NotForBambu");
  const std::vector<int> loaded = loadedFilaments({gcode});
  if (loaded.size() > 1) return refusedArgument("ManyFilaments", {{"count", loaded.size()}});
  const int filament = loaded.empty() ? 0 : loaded.front();
  const std::vector<ToldPicture> pictures = toldPictures(gcode);
  const std::string png = nearestPng(pictures, 4096);
  Zip zip;
  addPackageParts(zip,
                  " <Default Extension=\"png\" ContentType=\"image/png\"/>\n"
                  " <Default Extension=\"gcode\" ContentType=\"text/x.gcode\"/>\n");
  zip.add("3D/3dmodel.model",
          std::string(kXml) +
              "<model unit=\"millimeter\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
              " <metadata name=\"Application\">Sillon</metadata>\n <resources/>\n <build/>\n</model>\n");
  const std::string thumbnails = png.empty() ? ""
                                             : metadata("thumbnail_file", "Metadata/plate_1.png") +
                                                   metadata("thumbnail_no_light_file", "Metadata/plate_no_light_1.png");
  zip.add("Metadata/model_settings.config",
          std::string(kXml) + "<config>\n  <plate>\n" + metadata("plater_id", "1") + metadata("plater_name", "") +
              metadata("locked", "false") + metadata("gcode_file", "Metadata/plate_1.gcode") + thumbnails +
              metadata("pattern_bbox_file", "Metadata/plate_1.json") + "  </plate>\n</config>\n");
  zip.add("Metadata/_rels/model_settings.config.rels",
          std::string(kXml) +
              "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
              " <Relationship Target=\"/Metadata/plate_1.gcode\" Id=\"rel-1\" "
              "Type=\"http://schemas.bambulab.com/package/2021/gcode\"/>\n</Relationships>\n");
  zip.add("Metadata/slice_info.config", sliceInfo(gcode, filament));
  if (!png.empty()) {
    zip.add("Metadata/plate_1.png", png);
    zip.add("Metadata/plate_1_small.png", nearestPng(pictures, kSmallPicture));
    zip.add("Metadata/plate_no_light_1.png", png);
  }
  zip.add("Metadata/plate_1.json", plateInfo(gcode, filament));
  zip.add("Metadata/plate_1.gcode.md5", md5(gcode));
  zip.add("Metadata/plate_1.gcode", gcode);
  return zip.finish();
}

Result<GcodeContainer> readGcodeContainer(std::string file) {
  GcodeContainer container;
  const std::string_view bytes = file;
  if (isBinaryGcode(bytes)) {
    Result<std::string> text = binaryToText(bytes);
    if (!text) return text.error();
    container.kind = GcodeContainerKind::Binary;
    container.gcode = std::move(text).value();
    container.file = std::move(file);
    return container;
  }
  if (isGzip(bytes)) {
    Result<std::string> text = gunzipped(bytes, kMostGcodeBytes);
    if (!text) return text.error();
    container.kind = GcodeContainerKind::Gzip;
    container.gcode = std::move(text).value();
    container.file = std::move(file);
    return container;
  }
  if (!isZip(bytes)) {
    container.gcode = std::move(file);
    return container;
  }
  const Result<ZipDirectory> directory = readZip(bytes);
  if (!directory) return directory.error();
  const ZipEntry* plate = plateOf(directory.value());
  if (plate == nullptr) return holdsNoPlate(directory.value());
  Result<std::string> text = unpackEntry(bytes, *plate, kMostGcodeBytes);
  if (!text) return text.error();
  container.kind = GcodeContainerKind::Package3mf;
  const auto& entries = directory.value().entries;
  container.plates = static_cast<int>(std::count_if(
      entries.begin(), entries.end(), [](const ZipEntry& entry) { return entry.name.ends_with(".gcode"); }));
  container.gcode = std::move(text).value();
  container.file = std::move(file);
  return container;
}

Result<std::string> writeGcodeContainer(const GcodeContainer& container, std::string gcode) {
  switch (container.kind) {
    case GcodeContainerKind::Text:
      return gcode;
    case GcodeContainerKind::Binary:
      return binaryWithText(container.file, gcode);
    case GcodeContainerKind::Gzip:
      return gzippedLike(container.file, gcode);
    case GcodeContainerKind::Package3mf:
      break;
  }
  std::string file;
  // Growing step by step would hold the file twice.
  file.reserve(container.file.size() + gcode.size() + kMostRecords);
  const auto problem = writeGcodeContainer(container, {gcode}, [&](std::string_view piece) { file += piece; });
  if (problem) return *problem;
  return file;
}

std::optional<Error> writeGcodeContainer(const GcodeContainer& container, const std::vector<std::string_view>& gcode,
                                         const std::function<void(std::string_view)>& take) {
  if (container.kind == GcodeContainerKind::Text) {
    for (const std::string_view part : gcode) take(part);
    return std::nullopt;
  }
  std::size_t size = 0;
  for (const std::string_view part : gcode) size += part.size();
  if (container.kind != GcodeContainerKind::Package3mf) {
    const Result<std::string> whole = writeGcodeContainer(container, firstOf(gcode, size));
    if (!whole) return whole.error();
    take(whole.value());
    return std::nullopt;
  }
  if (const auto problem = tooLargeToPack(size)) return *problem;
  const std::string_view file = container.file;
  const Result<ZipDirectory> directory = readZip(file);
  if (!directory) return directory.error();
  const ZipEntry* plate = plateOf(directory.value());
  if (plate == nullptr) return holdsNoPlate(directory.value());

  const std::string_view path = plate->name.substr(0, plate->name.size() - 6);          // Metadata/plate_1
  const std::string_view folder = path.substr(0, path.rfind('/') + 1);                  // Metadata/
  const std::string_view index = path.substr(path.find_last_not_of("0123456789") + 1);  // 1
  const std::string told = toldPart(gcode, size);
  const std::vector<ToldPicture> pictures = toldPictures(told);
  const bool newPictures =
      !pictures.empty() && nearestPng(pictures, 4096) != nearestPng(toldPictures(container.gcode), 4096);
  const Bounds before = printedBox({container.gcode});
  const Bounds after = printedBox(gcode);
  // A bead that lies slightly differently does not move the plate; its objects keep the boxes of their slicer.
  const bool moved =
      before.empty() != after.empty() ||
      (!after.empty() && std::max(length(before.min - after.min), length(before.max - after.max)) > kMoved);

  const auto unpacked = [&](const std::string& name) -> Result<std::string> {
    for (const ZipEntry& entry : directory.value().entries) {
      if (entry.name == name) return unpackEntry(file, entry, kMostMetadata);
    }
    return std::string();
  };
  const Result<std::string> info = unpacked(std::string(folder) + "slice_info.config");
  if (!info) return info.error();
  const Result<std::string> plateJson = unpacked(std::string(path) + ".json");
  if (!plateJson) return plateJson.error();
  const TextRange part = partOf(info.value(), index);
  const std::string_view xml = info.value();
  const PlateLists lists{part.end == 0 ? xml : xml.substr(part.begin, part.end - part.begin), plateJson.value()};
  if (auto error = packageDisagrees(lists, {loadedFilaments({container.gcode}), container.gcode},
                                    {loadedFilaments(gcode), told})) {
    return error;
  }

  std::vector<std::string> made(directory.value().entries.size());
  std::vector<std::vector<std::string_view>> contents(made.size());
  for (std::size_t k = 0; k < made.size(); ++k) {
    const ZipEntry& entry = directory.value().entries[k];
    const auto is = [&](std::string_view head, std::string_view tail) {
      return entry.name.starts_with(head) && entry.name.substr(head.size()) == tail;
    };
    const std::string noLight = std::string(folder) + "plate_no_light_" + std::string(index);
    std::optional<std::string> other;
    if (&entry == plate) {
      contents[k] = gcode;
    } else if (is(plate->name, ".md5")) {
      other = md5(gcode);
    } else if (newPictures && (is(path, ".png") || is(path, "_small.png") || is(noLight, ".png"))) {
      const Result<std::string> old = unpackEntry(file, entry, kMostMetadata);
      const std::string png = nearestPng(pictures, old ? widthOfPng(old.value()) : kSmallPicture);
      if (!png.empty()) other = png;
    } else if (is(folder, "slice_info.config") || (moved && is(path, ".json"))) {
      const std::string& old = entry.name.ends_with(".json") ? plateJson.value() : info.value();
      other = &old == &info.value() ? newSliceInfo(old, index, container.gcode, told) : newPlateInfo(old, after);
      if (*other == old) other.reset();
    }
    if (!other) continue;
    made[k] = std::move(*other);
    contents[k] = {made[k]};
  }
  withContents(file, directory.value(), contents, take);
  return std::nullopt;
}

Result<std::string> gzipGcode(std::string_view gcode) { return gzipped(gcode); }

Result<std::string> unpackGcode(std::string file) {
  Result<GcodeContainer> container = readGcodeContainer(std::move(file));
  if (!container) return container.error();
  return std::move(container.value().gcode);
}

bool isPackedGcode(std::string_view file) { return isZip(file) || isBinaryGcode(file) || isGzip(file); }

}  // namespace sillon
