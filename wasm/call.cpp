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
#include "sillon/base/version.hpp"
#include "sillon/project/project.hpp"

namespace call {
namespace {

using convert::failure;
using convert::success;

// Lives as long as the module, because threads are started once, with the module.
std::unique_ptr<sillon::RunContext> context;
double granted = 0;  // limit to which the host lets this module's memory grow [bytes]

std::string incoming;  // file from the host, filled between two calls

}  // namespace

// Returns the free memory; a quarter is reserved for fragments too small to use, and for results.
double freeMemory() {
  const double most = std::min(static_cast<double>(emscripten_get_heap_max()), granted);
  return 0.75 * (most - static_cast<double>(static_cast<std::uint32_t>(mallinfo().uordblks)));
}

sillon::Result<sillon::Project> projectOf(const std::string& json) {
  auto project = sillon::readProject(json);
  if (project || project.error().code != sillon::ErrorCode::InvalidFile) return project;
  sillon::Error error = project.error();
  error.code = sillon::ErrorCode::InvalidArgument;
  return error;
}

val guarded(const std::function<val(sillon::RunContext&)>& body) {
  try {
    if (context == nullptr) context = std::make_unique<sillon::RunContext>(1);
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

void tell(sillon::RunContext& run, const val& onProgress, double begin, double end) {
  run.onProgress([=](std::string_view stage, double fraction) {
    onProgress(convert::toJs(stage), begin + (end - begin) * fraction);
  });
}

std::string takenFile() { return std::exchange(incoming, std::string()); }

val file(const std::string& bytes) {
  return success(convert::copied(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

}  // namespace call

namespace bindings {

using call::guarded;

val start(int threads, double most, const val& poll) {
  return guarded([&](sillon::RunContext&) {
    call::granted = most;
    call::context = std::make_unique<sillon::RunContext>(threads);
    if (!poll.isNull()) call::context->onPoll([poll] { return poll().as<bool>(); });
    val out = val::object();
    out.set("version", convert::toJs(sillon::kVersion));
    out.set("cancelFlag", reinterpret_cast<std::uintptr_t>(&call::context->cancelFlag()));
    return convert::success(out);
  });
}

val room(double size) {
  return guarded([&](sillon::RunContext&) {
    call::incoming = std::string();
    constexpr double kMiB = 1 << 20;
    const double most = std::floor(call::freeMemory() / 2 / kMiB);  // half, because results are as large as the file
    if (!(size <= most * kMiB)) {
      return convert::failure(sillon::refused(sillon::ErrorCode::TooLarge, "FileTooLarge",
                                              {{"megabytes", std::ceil(size / kMiB)}, {"most", most}}));
    }
    call::incoming.resize(static_cast<std::size_t>(size));
    return convert::success(val(
        emscripten::typed_memory_view(call::incoming.size(), reinterpret_cast<std::uint8_t*>(call::incoming.data()))));
  });
}

val keptNumbers() {
  return guarded([](sillon::RunContext&) {
    val list = val::array();
    for (const int number : kept::numbers()) list.call<void>("push", number);
    return convert::success(list);
  });
}

}  // namespace bindings
