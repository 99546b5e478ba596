// Code that all bindings share.
#pragma once

#include <emscripten/val.h>

#include <functional>
#include <optional>
#include <string>

#include "sillon/base/run_context.hpp"
#include "sillon/project/project.hpp"

namespace call {

using emscripten::val;

/// Runs one call in a fresh state and turns whatever it throws into an error: {value} or {error: {code, message}}.
val guarded(const std::function<val(sillon::RunContext&)>& body);

/// Tells JavaScript how far a job is. \param begin, end  the part of the whole call that the job is, in [0, 1].
void tell(sillon::RunContext& run, const val& onProgress, double begin, double end);

/// Memory of the engine that is free or may be had [bytes].
double freeMemory();

/// A project made of arguments: what is wrong in it is no file's fault.
sillon::Result<sillon::Project> projectOf(const std::string& json);

/// Of a number, or of undefined.
inline std::optional<double> optionalOf(const val& js) {
  return js.isUndefined() ? std::nullopt : std::optional<double>(js.as<double>());
}

/// The file that the host has put into room().
std::string takenFile();

/// {value}: the bytes of a file.
val file(const std::string& bytes);

}  // namespace call
