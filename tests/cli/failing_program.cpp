// The command line with a memory and a disk that fail at a given call: SILLON_FAIL=new:N or SILLON_FAIL=write:N lets
// the N-th allocation, or the N-th opening, writing, flushing, syncing, closing or renaming of an output, or the
// syncing of a folder, fail once. Without it both are counted and told on stderr at the end. Linked with --wrap for
// main, fopen, fwrite, fflush and fclose.
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

std::atomic<bool> counting{false};
std::atomic<long> allocations{0};
std::atomic<long> writes{0};
long failingAllocation = 0;
long failingWrite = 0;
std::FILE* output = nullptr;  // outputs are open one at a time; what is read does not count

bool writeFails() {
  if (!counting || ++writes != failingWrite) return false;
  errno = ENOSPC;
  return true;
}

void* taken(std::size_t size) {
  if (counting && ++allocations == failingAllocation) throw std::bad_alloc();
  void* const block = std::malloc(size == 0 ? 1 : size);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

}  // namespace

void* operator new(std::size_t size) { return taken(size); }
void* operator new[](std::size_t size) { return taken(size); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }

extern "C" {

int __real_main(int argc, char** argv);
std::FILE* __real_fopen(const char* name, const char* mode);
std::size_t __real_fwrite(const void* data, std::size_t size, std::size_t count, std::FILE* file);
int __real_fflush(std::FILE* file);
int __real_fclose(std::FILE* file);

std::FILE* __wrap_fopen(const char* name, const char* mode) {
  const bool writes = std::strchr(mode, 'w') != nullptr;
  if (writes && writeFails()) return nullptr;
  std::FILE* const file = __real_fopen(name, mode);
  if (writes) output = file;
  return file;
}

std::size_t __wrap_fwrite(const void* data, std::size_t size, std::size_t count, std::FILE* file) {
  if (file != output || !writeFails()) return __real_fwrite(data, size, count, file);
  return __real_fwrite(data, size, count / 2, file);  // half of it is there
}

int __wrap_fflush(std::FILE* file) { return file == output && writeFails() ? EOF : __real_fflush(file); }

int __wrap_fclose(std::FILE* file) {
  const bool fails = file == output && writeFails();
  if (file == output) output = nullptr;
  return __real_fclose(file) != 0 || fails ? EOF : 0;
}

// The C++ library's own calls come here too.
int rename(const char* from, const char* to) noexcept {
  return writeFails() ? -1 : renameat(AT_FDCWD, from, AT_FDCWD, to);
}

int fsync(int file) { return writeFails() ? -1 : static_cast<int>(syscall(SYS_fsync, file)); }

int __wrap_main(int argc, char** argv) {
  const char* const fail = std::getenv("SILLON_FAIL");
  if (fail != nullptr && std::strncmp(fail, "new:", 4) == 0) failingAllocation = std::atol(fail + 4);
  if (fail != nullptr && std::strncmp(fail, "write:", 6) == 0) failingWrite = std::atol(fail + 6);
  counting = true;
  const int code = __real_main(argc, argv);
  counting = false;
  if (fail == nullptr) std::fprintf(stderr, "%ld %ld\n", allocations.load(), writes.load());
  return code;
}
}
