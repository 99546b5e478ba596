#include "sillon/printer_import/printer_import.hpp"

#include <optional>

#include "base/refused.hpp"
#include "export/packing.hpp"
#include "export/zip.hpp"
#include "printer_import/slicer_files.hpp"
#include "sillon/export/export.hpp"

namespace sillon {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{256} << 20;  // largest file that is read

// Tells G-code from settings, by the first line that has a command or a setting.
bool looksLikeGcode(std::string_view text) {
  for (int k = 0; k < 5000 && !text.empty(); ++k) {
    const std::string_view line = trimmed(nextLine(text));
    if (line.size() >= 2 && (line[0] == 'G' || line[0] == 'M') && line[1] >= '0' && line[1] <= '9') return true;
    if (isLayerMark(line)) return true;
    std::string_view key;
    std::string_view value;
    if (!line.empty() && line[0] != ';' && line[0] != '#' && splitSetting(line, key, value)) return false;
  }
  return false;
}

// Entry with the settings in a project of PrusaSlicer.
constexpr std::string_view kPrusaProject = "Metadata/Slic3r_PE.config";

// Finds the settings in a project of PrusaSlicer, Orca or Bambu Studio that is not sliced, or in a printer that Orca
// exported; nothing if the file holds G-code.
std::optional<ZipEntry> packedSettings(std::string_view zip) {
  const Result<ZipDirectory> directory = readZip(zip);
  std::optional<ZipEntry> found;
  if (!directory) return found;
  for (const ZipEntry& entry : directory.value().entries) {
    const bool project = entry.name == "Metadata/project_settings.config" || entry.name == kPrusaProject;
    const bool preset = entry.name.starts_with("printer/") && entry.name.ends_with(".json");
    if (entry.name.ends_with(".gcode")) return std::nullopt;
    if ((project || preset) && !found) found = entry;
  }
  return found;
}

}  // namespace

Result<ImportedPrinter> importPrinter(std::string_view bytes, std::string_view name) {
  if (isPackedGcode(bytes)) {
    if (const auto entry = packedSettings(bytes)) {
      const Result<std::string> settings = unpackEntry(bytes, *entry, kMaxSettingsBytes);
      if (!settings) return settings.error();
      if (entry->name != kPrusaProject) return importJson(settings.value());
      std::string lines;  // the settings without the ';' before each line
      for (std::string_view rest = settings.value(); !rest.empty();) {
        std::string_view line = nextLine(rest);
        line.remove_prefix(line.starts_with(';') ? 1 : 0);
        lines.append(line).append("\n");
      }
      return importIni(lines, {});
    }
    const Result<std::string> gcode = unpackGcode(std::string(bytes));
    if (!gcode) return gcode.error();
    if (!looksLikeGcode(gcode.value())) return refusedFile("UnknownContent");
    return importDonor(gcode.value());
  }
  if (bytes.size() > kMaxBytes) return fileTooLarge(bytes.size(), kMaxBytes);
  std::string_view text = bytes;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  const bool json = begin != std::string_view::npos && text[begin] == '{';
  if (text.find('\0') != std::string_view::npos) return refusedFile("UnknownContent");
  if (!json && looksLikeGcode(text)) return importDonor(text);
  if (text.size() > kMaxSettingsBytes) return fileTooLarge(text.size(), kMaxSettingsBytes);
  return json ? importJson(text) : importIni(text, name);
}

}  // namespace sillon
