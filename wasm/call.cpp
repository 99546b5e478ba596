#include "call.hpp"

#include <emscripten/bind.h>
#include <emscripten/heap.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <utility>

#include "bindings.hpp"
#include "convert.hpp"
#include "kept.hpp"
#include "sillon/base/words.hpp"

namespace sillon::bindings {
namespace {

// Lives as long as the module, because threads are started once, with the module.
std::unique_ptr<RunContext> context;
double granted = 0;  // limit to which the host lets this module's memory grow [bytes]

std::string incoming;  // file from the host, filled between two calls

}  // namespace

// Returns the free memory; a quarter is reserved for fragments too small to use, and for results.
double freeMemory() {
  const double most = std::min(static_cast<double>(emscripten_get_heap_max()), granted);
  return 0.75 * (most - static_cast<double>(static_cast<std::uint32_t>(mallinfo().uordblks)));
}

Result<Project> projectOf(const std::string& json) {
  auto project = sillon::readProject(json);
  if (project || project.error().code != ErrorCode::InvalidFile) return project;
  Error error = project.error();
  error.code = ErrorCode::InvalidArgument;
  return error;
}

val guarded(const std::function<val(RunContext&)>& body) {
  try {
    if (context == nullptr) context = std::make_unique<RunContext>(1);
    context->cancelFlag().store(false);
    context->onProgress({});
    context->limitMemory(freeMemory());
    return body(*context);
  } catch (const std::bad_alloc&) {
    return failure(sillon::refused(sillon::ErrorCode::OutOfMemory, "NeedsMoreMemory"));
  } catch (const std::exception& problem) {
    return failure("Internal", problem.what());
  } catch (...) {
    return failure("Internal", "something other than an exception was thrown");
  }
}

val withProject(const std::string& json, const std::function<val(Project&, RunContext&)>& body) {
  return guarded([&](RunContext& run) {
    auto project = projectOf(json);
    return project ? body(project.value(), run) : failure(project.error());
  });
}

void tell(RunContext& run, const val& onProgress, double begin, double end) {
  run.onProgress(
      [=](std::string_view stage, double fraction) { onProgress(toJs(stage), begin + (end - begin) * fraction); });
}

std::string takenFile() { return std::exchange(incoming, std::string()); }

val start(int threads, double most, const val& poll) {
  return guarded([&](RunContext&) {
    granted = most;
    context = std::make_unique<RunContext>(threads);
    if (!poll.isNull()) context->onPoll([poll] { return poll().as<bool>(); });
    return success(
        object({{"version", kVersion}, {"cancelFlag", val(reinterpret_cast<std::uintptr_t>(&context->cancelFlag()))}}));
  });
}

val room(double size) {
  return guarded([&](RunContext&) {
    incoming = std::string();
    constexpr double kMiB = 1 << 20;
    const double most = std::floor(freeMemory() / 2 / kMiB);  // half, because results are as large as the file
    if (!(size <= most * kMiB)) {
      return failure(
          refused(ErrorCode::TooLarge, "PrintTooLarge", {{"megabytes", std::ceil(size / kMiB)}, {"most", most}}));
    }
    incoming.resize(toSize(size));
    return success(
        val(emscripten::typed_memory_view(incoming.size(), reinterpret_cast<std::uint8_t*>(incoming.data()))));
  });
}

val keptNumbers() {
  return guarded([](RunContext&) { return success(listOf(kept::numbers())); });
}

}  // namespace sillon::bindings
