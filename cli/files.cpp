#include "files.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>
#include <random>
#include <utility>

#include "sillon/base/types.hpp"

#if defined(__unix__) || defined(__APPLE__)
#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#elif defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#endif

namespace sillon::cli {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

Error invalid(std::string message) { return {ErrorCode::InvalidFile, std::move(message)}; }

std::string reason(int error) { return error == 0 ? "unknown reason" : std::strerror(error); }

std::FILE* openToRead(const std::string& name) {
#if defined(_WIN32)
  return ::_wfopen(pathOf(name).c_str(), L"rb");
#else
  return std::fopen(name.c_str(), "rb");
#endif
}

/// Creates a new file; fails if the name exists. Windows' oldest C library does not know the mode "x".
std::FILE* openNew(const fs::path& path) {
#if defined(_WIN32)
  const int file = ::_wopen(path.c_str(), _O_CREAT | _O_EXCL | _O_BINARY | _O_WRONLY, _S_IREAD | _S_IWRITE);
  return file < 0 ? nullptr : ::_fdopen(file, "wb");
#else
  return std::fopen(path.c_str(), "wbx");
#endif
}

/// Resolves links in a name, so that writing to a link keeps the link.
fs::path target(const std::string& name) {
  std::error_code error;
  const fs::path path = pathOf(name);
  // A relative name that does not exist would stay as written, and "a" and "./a" would be two names; so it is made
  // absolute first.
  fs::path resolved = fs::weakly_canonical(fs::absolute(path, error), error);
  if (error) return path;
  // Follows a link whose target does not exist yet.
  for (int links = 0; links < 16; ++links) {
    const fs::path to = fs::read_symlink(resolved, error);
    if (error) break;
    resolved = fs::weakly_canonical(resolved.parent_path() / to, error);
    if (error) return path;
  }
  return resolved;
}

/// Returns a unique name in the same folder, because renaming is atomic only within one file system.
fs::path temporaryName(const fs::path& path, const char* ending) {
  std::random_device random;
  return path.parent_path() / (".sillon-" + std::to_string(random()) + std::to_string(random()) + ending);
}

/// Tells whether temporaryName() makes such names: a run that was killed leaves such files behind.
[[maybe_unused]] bool isTemporaryName(std::string_view name) {
  constexpr std::string_view kBegin = ".sillon-";
  if (!name.starts_with(kBegin) || (!name.ends_with(".tmp") && !name.ends_with(".old"))) return false;
  const std::string_view number = name.substr(kBegin.size(), name.size() - kBegin.size() - 4);
  return !number.empty() && number.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Removes leftovers older than an hour from a folder; a live run has such files for seconds only. A file ".old" keeps
/// the age of its content, so that the time of its second name counts. On Windows it may be the only copy of its
/// content, so that nothing is removed.
void removeLeftovers(const fs::path& folder) {
#if defined(__unix__) || defined(__APPLE__)
  constexpr std::time_t kLeft = 3600;  // [s]
  // The iterator of the C++ library would end the program when memory runs out.
  DIR* const entries = ::opendir(folder.c_str());
  if (entries == nullptr) return;
  while (const dirent* const entry = ::readdir(entries)) {
    const std::string_view name = static_cast<const char*>(entry->d_name);
    struct stat status {};
    if (!isTemporaryName(name) || ::fstatat(::dirfd(entries), name.data(), &status, AT_SYMLINK_NOFOLLOW) != 0) continue;
    const std::time_t since = name.ends_with(".tmp") ? status.st_mtime : status.st_ctime;
    const bool left = S_ISREG(status.st_mode) && std::time(nullptr) - since > kLeft;
    if (left) ::unlinkat(::dirfd(entries), name.data(), 0);
  }
  ::closedir(entries);
#else
  (void)folder;
#endif
}

/// Interprets the result of a sync, without which a file might not survive a power cut. Some file systems and devices
/// do not support it.
bool isSynced(int result) { return result == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS; }

bool sync(std::FILE* file) {
#if defined(__unix__) || defined(__APPLE__)
  return isSynced(::fsync(::fileno(file)));
#elif defined(_WIN32)
  return isSynced(::_commit(::_fileno(file)));
#else
  return true;
#endif
}

/// Syncs the names in a folder. A folder that cannot be opened for reading is left to the system.
bool syncFolder(const fs::path& folder) {
#if defined(__unix__) || defined(__APPLE__)
  const int opened = ::open(folder.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) return true;
  const bool synced = isSynced(::fsync(opened));
  const int reason = errno;
  ::close(opened);
  errno = reason;
  return synced;
#else
  (void)folder;
  return true;
#endif
}

/// Tells whether a name stands for a stream. Such a name must not be written as a file, which would replace the target
/// of stdout.
bool namesStream(const std::string& path) {
  return path == "-" || path == "/dev/stdout" || path == "/dev/stderr" || path.starts_with("/dev/fd/");
}

bool namesOtherPicture(const std::string& path) {
  constexpr std::array<std::string_view, 8> kEndings{".jpg", ".jpeg", ".webp", ".gif", ".bmp", ".tga", ".tif", ".tiff"};
  return std::any_of(kEndings.begin(), kEndings.end(), [&](std::string_view end) { return endsWith(path, end); });
}

/// Writes a new file, with the permissions of the file that it will replace.
/// \param path  temporary name.
/// \param wanted  final name.
std::optional<Error> writeNew(const fs::path& path, const std::string& bytes, const std::string& wanted) {
  File file(openNew(path));
  if (file == nullptr) return invalid("\"" + wanted + "\" cannot be written: " + reason(errno));
  std::error_code error;
  const fs::file_status before = fs::status(target(wanted), error);
  if (fs::exists(before)) fs::permissions(path, before.permissions(), error);  // otherwise the default permissions stay
  errno = 0;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  const bool flushed = std::fflush(file.get()) == 0 && sync(file.get());
  const bool closed = std::fclose(file.release()) == 0;  // a network file system may report only here that it is full
  if (!written || !flushed || !closed) return invalid("\"" + wanted + "\" cannot be written: " + reason(errno));
  return std::nullopt;
}

/// Temporary files beside their targets, removed at the end unless they were kept. All names are made at the beginning,
/// so that memory cannot run out after the first byte is written.
class TemporaryFiles {
 public:
  explicit TemporaryFiles(const std::vector<OutputFile>& files) {
    for (const OutputFile& file : files) {
      const fs::path to = target(file.path);
      fs::path folder = to.parent_path();
      removeLeftovers(folder);
      if (std::any_of(files_.begin(), files_.end(), [&](const Names& other) { return other.folder == folder; })) {
        folder.clear();
      }
      files_.push_back({file.path, temporaryName(to, ".tmp"), temporaryName(to, ".old"), to, std::move(folder)});
    }
  }
  ~TemporaryFiles() {
    std::error_code ignored;
    for (std::size_t k = 0; k < files_.size(); ++k) {
      if (k >= kept_) fs::remove(files_[k].from, ignored);
      if (files_[k].saved) fs::remove(files_[k].old, ignored);
    }
  }
  TemporaryFiles(const TemporaryFiles&) = delete;
  TemporaryFiles& operator=(const TemporaryFiles&) = delete;

  [[nodiscard]] const fs::path& name(std::size_t k) const { return files_[k].from; }

  std::optional<Error> keep() {
    for (; kept_ < files_.size(); ++kept_) {
      Names& file = files_[kept_];
      std::error_code error;
      file.isNew = !fs::exists(file.to, error);
      error.clear();
      // A file may be refused after others are in place, such as another user's file in a shared folder; and last, the
      // sync of the folder may fail.
      if (!file.isNew) error = save(file);
      if (!error) fs::rename(file.from, file.to, error);
      if (!error) continue;
      giveBack();
      return invalid("\"" + file.wanted + "\" cannot be written: " + error.message());
    }
    for (const Names& file : files_) {
      errno = 0;
      if (file.folder.empty() || syncFolder(file.folder)) continue;
      const int why = errno;
      giveBack();
      return invalid("\"" + file.wanted + "\" cannot be written: " + reason(why));
    }
    return std::nullopt;
  }

 private:
  struct Names {
    std::string wanted;
    fs::path from;
    fs::path old;  ///< name for the previous file
    fs::path to;
    fs::path folder;     ///< folder to sync; empty if another file syncs it
    bool isNew = false;  ///< true if no file was there before
    bool saved = false;  ///< previous file has the name `old`, also or only; never on disks without hard links
  };

  /// Keeps the previous file under a second name. \returns the error if it cannot be replaced
  static std::error_code save(Names& file) {
    std::error_code error;
#if defined(_WIN32)
    // A file that another program holds cannot get a removable second name: it is moved aside, or refused.
    fs::rename(file.to, file.old, error);
    file.saved = !error;
    return error;
#else
    fs::create_hard_link(file.to, file.old, error);
    file.saved = !error;
    return {};
#endif
  }

  // Restores the previous files.
  void giveBack() {
    std::error_code ignored;
    for (std::size_t k = 0; k < std::min(kept_ + 1, files_.size()); ++k) {
      const Names& file = files_[k];
      if (file.isNew && k < kept_) fs::remove(file.to, ignored);
      if (file.saved) fs::rename(file.old, file.to, ignored);
    }
  }

  std::vector<Names> files_;
  std::size_t kept_ = 0;
};

}  // namespace

fs::path pathOf(const std::string& name) {
#if defined(_WIN32)
  return {std::u8string(name.begin(), name.end())};
#else
  return name;
#endif
}

std::string nameOf(const fs::path& path) {
#if defined(_WIN32)
  const std::u8string name = path.generic_u8string();
  return {name.begin(), name.end()};
#else
  return path.string();
#endif
}

bool endsWith(std::string name, std::string_view end) {
  std::transform(name.begin(), name.end(), name.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  return name.ends_with(end);
}

Result<std::string> readFile(const std::string& path, const std::string& what, std::size_t maxBytes) {
  const std::string name = "the " + what + " \"" + path + "\"";
  std::error_code error;
  if (fs::is_directory(pathOf(path), error)) return invalid(name + " is a folder; it must be a file");
  const auto unreadable = [&](int reasonNumber) {
    // A signal arrived while waiting for the other end of a pipe.
    if (reasonNumber == EINTR) return Error{ErrorCode::Cancelled, "cancelled; nothing was written"};
    return invalid(name + " cannot be read: " + reason(reasonNumber));
  };
  File file(openToRead(path));
  if (file == nullptr) return unreadable(errno);

  const Error tooLarge{ErrorCode::TooLarge,
                       name + " is larger than " + std::to_string(maxBytes >> 20) + " MiB; it must be at most that"};
  std::string bytes;
  // Reserves the size: a string that grows step by step would hold a large file twice. A pipe or device has no size.
  const std::uintmax_t size = fs::file_size(pathOf(path), error);
  if (!error && size > maxBytes) return tooLarge;
  if (!error) bytes.reserve(sillon::toSize(size) + 1);
  std::array<char, 65536> buffer;
  while (bytes.size() <= maxBytes) {
    const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get());
    bytes.append(buffer.data(), count);
    if (count < buffer.size()) break;
  }
  if (std::ferror(file.get()) != 0) return unreadable(errno);
  if (bytes.size() > maxBytes) return tooLarge;
  if (bytes.empty()) return invalid(name + " is empty; it must hold at least one byte");
  return bytes;
}

bool sameFile(const std::string& a, const std::string& b) { return target(a) == target(b); }

Error severalPlates(const std::string& path, int plates) {
  return {ErrorCode::InvalidFile, "\"" + path + "\": it holds " + std::to_string(plates) +
                                      " plates; export them one by one, so that none is forgotten"};
}

std::optional<Error> checkOutputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs,
                                  const std::vector<std::string>& moving) {
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    const std::string name = "the output \"" + outputs[k] + "\"";
    if (namesStream(outputs[k])) return invalid(name + " is not a file; files cannot be written to stdout");
    const fs::path path = target(outputs[k]);
    std::error_code error;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error)) {
      return invalid(name + " cannot be written: \"" + nameOf(folder) + "\" is not a folder");
    }
    const fs::file_status status = fs::status(path, error);
    if (!fs::status_known(status))
      return invalid(name + " cannot be written: " + error.message());  // the name may be too long, for example
    if (fs::exists(status) && !fs::is_regular_file(status)) {
      return invalid(name + " is a folder or a device; it must be a file or a new name");
    }
#if defined(__unix__) || defined(__APPLE__)
    if (::access(folder.c_str(), W_OK) != 0) return invalid(name + " cannot be written: " + reason(errno));
    if (fs::exists(status) && ::access(path.c_str(), W_OK) != 0)
      return invalid(name + " cannot be written: " + reason(errno));
#endif
    for (std::size_t j = 0; j < k; ++j) {
      if (target(outputs[j]) == path) return invalid(name + " is named for two outputs; each needs a name of its own");
    }
    for (const std::string& input : inputs) {
      if (target(input) == path) return invalid(name + " is also an input; it must be another file");
    }
    const bool moves = std::find(moving.begin(), moving.end(), outputs[k]) != moving.end();
    if (namesOtherPicture(outputs[k]) && !(moves && endsWith(outputs[k], ".webp"))) {
      return invalid(name + " is named like a picture that is not written; pictures are written as .png, and " +
                     "--preview also as .webp, which moves");
    }
  }
  return std::nullopt;
}

std::optional<Error> writeTogether(const std::vector<OutputFile>& files) {
  TemporaryFiles written(files);
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (auto problem = writeNew(written.name(k), files[k].bytes, files[k].path)) return problem;
  }
  return written.keep();
}

}  // namespace sillon::cli
