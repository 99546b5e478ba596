// Functions that all bindings share.
#pragma once

#include <emscripten/val.h>

#include <functional>
#include <optional>
#include <string>

#include "sillon/base/run_context.hpp"
#include "sillon/project/project.hpp"

namespace sillon::bindings {

using emscripten::val;

/// Runs one call with a fresh state and returns {value}, or {error: {code, message}} if it throws.
val guarded(const std::function<val(RunContext&)>& body);

/// Runs a call with a project made from arguments; its errors are InvalidArgument instead of InvalidFile.
val withProject(const std::string& json, const std::function<val(Project&, RunContext&)>& body);

/// Reports progress to JavaScript. \param begin, end  part of the whole call that the job takes, in [0, 1].
void tell(RunContext& run, const val& onProgress, double begin, double end);

/// Returns the memory that is free, or that the engine may still get [bytes].
double freeMemory();

/// Reads a project made from arguments; its errors are InvalidArgument instead of InvalidFile.
Result<Project> projectOf(const std::string& json);

/// Converts a number or undefined.
inline std::optional<double> optionalOf(const val& js) {
  return js.isUndefined() ? std::nullopt : std::optional<double>(js.as<double>());
}

/// Takes the file that the host has put into room().
std::string takenFile();

}  // namespace sillon::bindings
