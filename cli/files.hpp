// Reads and writes files. The outputs of a command appear together or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"

namespace sillon::cli {

inline constexpr std::size_t kMaxSpoolsBytes = std::size_t{1} << 20;
inline constexpr std::size_t kMaxInputBytes = std::size_t{256} << 20;
inline constexpr std::size_t kMaxGcodeBytes = std::size_t{1}
                                              << 30;  ///< `generate` writes hundreds of MB for tall plates

/// Converts names between UTF-8 and the system's paths. Projects, command line and messages use UTF-8 on every system,
/// but paths of Windows do not.
std::filesystem::path pathOf(const std::string& name);
std::string nameOf(const std::filesystem::path& path);

/// Tells whether a file's name has an ending, ignoring case. \param end  in small letters
bool endsWith(std::string name, std::string_view end);

/// Reads a file. \param what  "shape", "direction picture", ..., for messages.
Result<std::string> readFile(const std::string& path, const std::string& what, std::size_t maxBytes);

/// Tells whether two names lead to the same place, also through links, and if nothing exists there yet.
bool sameFile(const std::string& a, const std::string& b);

/// Makes the error for a package with several plates, of which a command would read only the first.
Error severalPlates(const std::string& path, int plates);

struct OutputFile {
  std::string path;
  std::string bytes;
};

/// Results of a command. Nothing is written until all of them exist, so that no computation can fail in between.
struct Outcome {
  std::vector<OutputFile> files;
  std::string text;          ///< text for stdout, printed after the files are written
  bool textIsAsked = false;  ///< the text is data, as with --json: losing it is a failure
};

/// Checks output names before the work begins: folders exist, names are files, and no name is used twice or is an
/// input.
/// \param moving  outputs that may be moving pictures
std::optional<Error> checkOutputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs,
                                  const std::vector<std::string>& moving = {});

/// Writes each file beside its target first and renames them only when all are complete. If anything fails on the way,
/// existing files stay as they were.
std::optional<Error> writeTogether(const std::vector<OutputFile>& files);

}  // namespace sillon::cli
