// Files in, files out. Outputs appear together or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sillon/base/result.hpp"

namespace cli {

inline constexpr std::size_t kMaxSpoolsBytes = std::size_t{1} << 20;
inline constexpr std::size_t kMaxInputBytes = std::size_t{256} << 20;
inline constexpr std::size_t kMaxGcodeBytes = std::size_t{1}
                                              << 30;  ///< `generate` writes hundreds of MB for tall plates

/// Names are UTF-8 in projects, on the command line and in messages, on every system. Windows' own paths are not.
std::filesystem::path pathOf(const std::string& name);
std::string nameOf(const std::filesystem::path& path);

/// Whether a file's name ends so, in letters of any case. \param end  in small letters
bool endsWith(std::string name, std::string_view end);

/// \param what  "shape", "direction picture", ...: for the message.
sillon::Result<std::string> readFile(const std::string& path, const std::string& what, std::size_t maxBytes);

/// Whether both names lead to the same place, also through links and where nothing is yet.
bool sameFile(const std::string& a, const std::string& b);

/// For a package that holds more plates than one, of which a command reads the first.
sillon::Error severalPlates(const std::string& path, int plates);

struct OutputFile {
  std::string path;
  std::string bytes;
};

/// What a command has made. Nothing of it is written yet, so that nothing can go wrong once something is.
struct Outcome {
  std::vector<OutputFile> files;
  std::string text;          ///< for stdout, once the files are there
  bool textIsAsked = false;  ///< it is data, as with --json: losing it is a failure
};

/// What can be known before the work begins: folders exist, names are files, no name is used twice or read from.
/// \param moving  of the outputs those that may be moving pictures
std::optional<sillon::Error> checkOutputs(const std::vector<std::string>& outputs,
                                          const std::vector<std::string>& inputs,
                                          const std::vector<std::string>& moving = {});

/// Writes every file beside its target first and renames only when all are complete. A file that was there before
/// stays as it was if anything fails on the way.
std::optional<sillon::Error> writeTogether(const std::vector<OutputFile>& files);

}  // namespace cli
