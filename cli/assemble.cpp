#include "assemble.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "files.hpp"
#include "sillon/settings/table.hpp"

#ifdef __EMSCRIPTEN__
#include <emscripten.h>

/// Asks JavaScript for letters or a code, see wasm/src/cli-texts.ts. \returns text that the caller frees.
// clang-format off: it is JavaScript.
EM_JS(char*, sillonMadeElsewhere, (const char* name), {
  const bytes = new TextEncoder().encode(globalThis.sillonMadeElsewhere(UTF8ToString(name)));
  const at = _malloc(bytes.length + 1);
  HEAPU8.set(bytes, at);
  HEAPU8[at + bytes.length] = 0;
  return at;
});
// clang-format on
#endif

namespace sillon::cli {
namespace {

namespace fs = std::filesystem;

/// Resolves a file name in a scene, relative to the working directory.
/// \param up  number of folders above the scene's own that are also searched.
std::string fromFolder(const fs::path& folder, const std::string& name, int up) {
  const fs::path beside = folder / pathOf(name);
  std::error_code error;
  fs::path above = folder;
  for (int k = 0; k < up && !fs::exists(beside, error); ++k) {
    above /= "..";
    const fs::path there = (above / pathOf(name)).lexically_normal();
    if (fs::is_regular_file(there, error)) return nameOf(there);
  }
  return nameOf(beside);
}

/// Makes a name on the command line relative to a folder.
std::string seenFrom(const fs::path& folder, const std::string& name) {
  std::error_code error;
  const fs::path relative = fs::proximate(pathOf(name), folder, error);
  return error ? name : nameOf(relative);
}

/// Describes a file that was given in place of a project, and how to give it correctly; nothing if it may be JSON.
std::optional<std::string> otherThanJson(std::string_view text) {
  const std::string_view start = text.substr(0, 64);
  const std::size_t first = start.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (first != std::string_view::npos && start[first] == '<')
    return " is a drawing and not a project; give it as --shape";
  if (std::any_of(start.begin(), start.end(), [](char c) { return static_cast<unsigned char>(c) < 9; })) {
    return " is neither a project nor a picture that can be read; PNG, JPEG, BMP and TGA can";
  }
  return std::nullopt;
}

/// Returns the fields that name a project's files, in the order of the project. \param project  a Project, const or not
template <class OneProject>
auto fileFields(OneProject& project) {
  std::vector<decltype(&project.shapeFile)> fields;
  const auto add = [&](auto& name) {
    if (!name.empty()) fields.push_back(&name);
  };
  const auto addFont = [&](auto& name) {
    if (isFontFile(name)) fields.push_back(&name);
  };
  add(project.shapeFile);
  addFont(project.shapeFont);
  for (auto& layer : project.layers) {
    const auto pictures = layer.template as<PictureLayer>();
    for (std::size_t k = 0; pictures != nullptr && k < pictures->pictures.size(); ++k) add(pictures->pictures[k].file);
    if (const auto part = layer.template as<LayerFile>()) add(part->file);
    if (const auto part = layer.template as<LayerLetters>()) addFont(part->font);
    add(layer.modeFile);
    add(layer.maskFile);
  }
  return fields;
}

/// Gets letters and codes that core leaves to others (core/src/text): from JavaScript in the command line for Node.
Result<InputFile> madeElsewhere(const std::string& name, const std::string& what) {
#ifdef __EMSCRIPTEN__
  const std::unique_ptr<char, decltype(&std::free)> made(sillonMadeElsewhere(name.c_str()), &std::free);
  if (what == "shaped line") return InputFile(std::string(made.get()));
  // A code comes as its side and a character for each module.
  const std::string_view text(made.get());
  const std::size_t space = text.find(' ');
  if (space == std::string_view::npos) return InputFile(std::string());
  const int side = std::atoi(made.get());
  Image image{side, side, 1, {}};
  for (const char module : text.substr(space + 1)) image.samples.push_back(module == '#' ? 0 : 65535);
  return InputFile(std::move(image));
#else
  static_cast<void>(name);
  return Error{ErrorCode::InvalidArgument,
               "this program was built without HarfBuzz and libqrcodegen, so it makes no " + what};
#endif
}

/// Converts UTF-16 with a byte order mark to UTF-8; other text is returned as it is. PowerShell redirects output, as in
/// `sillon import part.gcode > mine.json`, in UTF-16. An unpaired surrogate becomes U+FFFD.
std::string asUtf8(std::string text) {
  if (!text.starts_with("\xFF\xFE")) return text;
  const auto unit = [&](std::size_t at) -> unsigned {
    if (at + 1 >= text.size()) return 0;
    return static_cast<unsigned char>(text[at]) | static_cast<unsigned>(static_cast<unsigned char>(text[at + 1])) << 8;
  };
  std::string utf8;
  for (std::size_t at = 2; at + 1 < text.size(); at += 2) {
    unsigned code = unit(at);
    if (code >= 0xD800 && code < 0xE000) {
      const unsigned low = unit(at + 2);
      const bool pair = code < 0xDC00 && low >= 0xDC00 && low < 0xE000;
      code = pair ? 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00) : 0xFFFD;
      at += pair ? 2 : 0;
    }
    const int more = code < 0x80 ? 0 : code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;  // bytes after the first
    constexpr unsigned kFirst[] = {0, 0xC0, 0xE0, 0xF0};
    utf8 += static_cast<char>(kFirst[more] | code >> 6 * more);
    for (int k = more - 1; k >= 0; --k) utf8 += static_cast<char>(0x80 | (code >> 6 * k & 0x3F));
  }
  return utf8;
}

}  // namespace

Result<Project> loadProject(const std::string& path) {
  Result<std::string> text = readFile(path, "scene", kMaxProjectBytes);
  if (!text) return text.error();
  text = asUtf8(std::move(text).value());
  Result<Project> project = sillon::readProject(text.value());
  if (!project)
    return Error{project.error().code,
                 "scene \"" + path + "\"" + otherThanJson(text.value()).value_or(": " + project.error().message)};
  const fs::path folder = pathOf(path).parent_path();
  Project& read = project.value();
  // The paper's repository keeps its scenes in folders but names their files from its root. Its scenes are recognised
  // by two keys that only they set together.
  const int up = read.unitlessIsMm && read.ignorePaint ? 3 : 0;
  for (std::string* name : fileFields(read)) *name = fromFolder(folder, *name, up);
  return project;
}

Result<PlateInput> assemblePlate(const Project& project, const RunContext& run) {
  return readPlateInput(project, readInputFile, run);
}

Result<InputFile> readInputFile(const std::string& name, const std::string& what) {
  if (what == "shaped line" || what == "QR code") return madeElsewhere(name, what);
  Result<std::string> bytes = readFile(name, what, kMaxInputBytes);
  if (!bytes) return bytes.error();
  return InputFile(std::move(bytes).value());
}

std::vector<std::string> inputFiles(const Project& project) {
  std::vector<std::string> files;
  for (const std::string* name : fileFields(project)) files.push_back(*name);
  return files;
}

std::string projectFor(const Project& project, const std::string& path) {
  std::error_code error;
  const fs::path folder = fs::absolute(pathOf(path), error).parent_path();
  Project written = project;
  for (std::string* name : fileFields(written)) *name = seenFrom(folder, *name);
  return writeProject(written);
}

}  // namespace sillon::cli
