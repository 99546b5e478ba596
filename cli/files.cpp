#include "files.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

namespace cli {
namespace {

namespace fs = std::filesystem;
using sillon::Error;
using sillon::ErrorCode;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

Error invalid(std::string message) { return {ErrorCode::InvalidFile, std::move(message)}; }

std::string reason(int error) { return error == 0 ? "unknown reason" : std::strerror(error); }

/// Where a name leads once links are followed, so that a link stays a link.
fs::path target(const std::string& path) {
  std::error_code error;
  // Absolute first: a relative name that is not there yet would stay as it was written, "a" and "./a" two names.
  const fs::path resolved = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? fs::path(path) : resolved;
}

/// A free name in the same folder: renaming is atomic only within one file system.
std::string temporaryName(const fs::path& path, std::size_t index) {
#if defined(__unix__) || defined(__APPLE__)
  const auto process = static_cast<long>(::getpid());
#else
  const long process = 0;
#endif
  const std::string name = ".sillon-" + std::to_string(process) + "-" + std::to_string(index) + ".tmp";
  return (path.parent_path() / name).string();
}

std::optional<Error> writeNew(const std::string& path, const std::string& bytes, const std::string& wanted) {
  File file(std::fopen(path.c_str(), "wbx"));  // x: never into a file that is there
  if (file == nullptr) return invalid("\"" + wanted + "\" cannot be written: " + reason(errno));
  errno = 0;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  const bool flushed = std::fflush(file.get()) == 0;
  if (!written || !flushed) return invalid("\"" + wanted + "\" cannot be written: " + reason(errno));
  return std::nullopt;
}

}  // namespace

sillon::Result<std::string> readFile(const std::string& path, const std::string& what, std::size_t maxBytes) {
  const std::string name = "the " + what + " \"" + path + "\"";
  std::error_code error;
  if (fs::is_directory(path, error)) return invalid(name + " is a folder; it must be a file");
  const auto unreadable = [&](int reasonNumber) {
    // A signal while it waited for the other end of a pipe.
    if (reasonNumber == EINTR) return Error{ErrorCode::Cancelled, "cancelled; nothing was written"};
    return invalid(name + " cannot be read: " + reason(reasonNumber));
  };
  File file(std::fopen(path.c_str(), "rb"));
  if (file == nullptr) return unreadable(errno);

  std::string bytes;
  std::array<char, 65536> buffer;
  while (bytes.size() <= maxBytes) {
    const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get());
    bytes.append(buffer.data(), count);
    if (count < buffer.size()) break;
  }
  if (std::ferror(file.get()) != 0) return unreadable(errno);
  if (bytes.size() > maxBytes) {
    return Error{ErrorCode::TooLarge,
                 name + " is larger than " + std::to_string(maxBytes >> 20) + " MiB; it must be at most that"};
  }
  if (bytes.empty()) return invalid(name + " is empty; it must hold at least one byte");
  return bytes;
}

std::optional<Error> checkOutputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    const std::string name = "the output \"" + outputs[k] + "\"";
    if (outputs[k] == "-") return invalid(name + " is no file; files cannot be written to stdout");
    const fs::path path = target(outputs[k]);
    std::error_code error;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error)) {
      return invalid(name + " cannot be written: \"" + folder.string() + "\" is no folder");
    }
    const fs::file_status status = fs::status(path, error);
    if (!fs::status_known(status))
      return invalid(name + " cannot be written: " + error.message());  // too long, for one
    if (fs::exists(status) && !fs::is_regular_file(status)) {
      return invalid(name + " is a folder or a device; it must be a file or a new name");
    }
#if defined(__unix__) || defined(__APPLE__)
    if (::access(folder.c_str(), W_OK) != 0) return invalid(name + " cannot be written: " + reason(errno));
#endif
    for (std::size_t j = 0; j < k; ++j) {
      if (target(outputs[j]) == path) return invalid(name + " is named for two outputs; each needs a name of its own");
    }
    for (const std::string& input : inputs) {
      if (target(input) == path) return invalid(name + " is also an input; it must be another file");
    }
  }
  return std::nullopt;
}

std::optional<Error> writeTogether(const std::vector<OutputFile>& files) {
  std::vector<std::string> temporary;
  std::optional<Error> problem;
  for (std::size_t k = 0; k < files.size() && !problem; ++k) {
    temporary.push_back(temporaryName(target(files[k].path), k));
    problem = writeNew(temporary.back(), files[k].bytes, files[k].path);
  }
  for (std::size_t k = 0; k < files.size() && !problem; ++k) {
    std::error_code error;
    fs::rename(temporary[k], target(files[k].path), error);
    if (error) problem = invalid("\"" + files[k].path + "\" cannot be written: " + error.message());
  }
  if (problem) {
    for (const std::string& path : temporary) std::remove(path.c_str());
  }
  return problem;
}

}  // namespace cli
