#include "call.hpp"

#include <emscripten/bind.h>
#include <emscripten/heap.h>

#include <cstdint>
#include <exception>
#include <memory>
#include <new>

#include "convert.hpp"
#include "sillon/base/version.hpp"
#include "sillon/project/project.hpp"

namespace call {
namespace {

using convert::failure;
using convert::success;

// Lives as long as the module: threads are started once, with it.
std::unique_ptr<sillon::RunContext> context;

/// \param poll  () => boolean, for RunContext::onPoll; null where memory is shared.
val start(int threads, const val& poll) {
  return guarded([&](sillon::RunContext&) {
    context = std::make_unique<sillon::RunContext>(threads);
    if (!poll.isNull()) context->onPoll([poll] { return poll().as<bool>(); });
    val out = val::object();
    out.set("version", convert::toJs(sillon::kVersion));
    out.set("cancelFlag", reinterpret_cast<std::uintptr_t>(&context->cancelFlag()));
    return success(out);
  });
}

val readProject(const std::string& json) {
  return guarded([&](sillon::RunContext&) {
    const auto project = sillon::readProject(json);
    if (!project) return failure(project.error());
    return success(val(sillon::writeProject(project.value())));
  });
}

}  // namespace

val guarded(const std::function<val(sillon::RunContext&)>& body) {
  try {
    if (context == nullptr) context = std::make_unique<sillon::RunContext>(1);
    context->cancelFlag().store(false);
    context->onProgress({});
    return body(*context);
  } catch (const std::bad_alloc&) {
    return failure("OutOfMemory",
                   "the engine ran out of memory at " + std::to_string(emscripten_get_heap_size() >> 20) + " MiB");
  } catch (const std::exception& problem) {
    return failure("Internal", problem.what());
  } catch (...) {
    return failure("Internal", "something that is no exception was thrown");
  }
}

void tell(sillon::RunContext& run, const val& onProgress, double begin, double end) {
  run.onProgress([=](std::string_view stage, double fraction) {
    onProgress(convert::toJs(stage), begin + (end - begin) * fraction);
  });
}

val file(const std::string& bytes) {
  return success(convert::copied(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

}  // namespace call

EMSCRIPTEN_BINDINGS(call) {
  emscripten::function("start", &call::start);
  emscripten::function("readProject", &call::readProject);
}
