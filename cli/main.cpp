// Runs the command that was asked for. Each reads and computes first, then writes all of its files at once.
// Exit codes: 0 done, 1 our fault, 2 bad input, 3 cancelled.
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "arguments.hpp"
#include "assemble.hpp"
#include "check.hpp"
#include "files.hpp"
#include "memory.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "sillon/export/gcode_archive.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/printer_import/printer_import.hpp"
#include "sillon/settings/presets.hpp"
#include "sillon/settings/table.hpp"
#include "threads.hpp"

namespace {

using sillon::Error;
using sillon::ErrorCode;

constexpr const char* kCancelled = "cancelled; nothing was written";

std::atomic<sillon::RunContext*> running{nullptr};
static_assert(std::atomic<sillon::RunContext*>::is_always_lock_free, "used in a signal handler");

// The first Ctrl-C asks the work to stop, the second one ends the program the hard way.
extern "C" void cancelRun(int signal) {
  if (sillon::RunContext* run = running.load()) run->requestCancel();
  std::signal(signal, SIG_DFL);
}

/// Signals cancel `run` while this lives.
class CancelOnSignal {
 public:
  explicit CancelOnSignal(sillon::RunContext& run) {
    running.store(&run);
#if defined(__unix__) || defined(__APPLE__)
    struct sigaction action {};
    action.sa_handler = cancelRun;  // without SA_RESTART: what waits for a pipe wakes up
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
    struct sigaction before {};
    ::sigaction(SIGHUP, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);  // else nohup asked for that
#else
    std::signal(SIGINT, cancelRun);
    std::signal(SIGTERM, cancelRun);
#endif
  }
  ~CancelOnSignal() { running.store(nullptr); }
  CancelOnSignal(const CancelOnSignal&) = delete;
  CancelOnSignal& operator=(const CancelOnSignal&) = delete;
};

int exitCode(ErrorCode code) {
  if (code == ErrorCode::Cancelled) return 3;
  return code == ErrorCode::Internal ? 1 : 2;
}

int fail(const Error& error) {
  std::fprintf(stderr, "sillon: %s\n", error.message.c_str());
  return exitCode(error.code);
}

/// The scene with the options laid over it, every field in range.
sillon::Result<sillon::Project> readInput(const cli::Arguments& arguments) {
  sillon::Project project;
  // Beads along the border would frame the picture in tones that it does not have.
  if (!arguments.pictures.files.empty()) project.toolpath.perimeterMode = sillon::PerimeterMode::None;
  if (!arguments.scene.empty()) {
    sillon::Result<sillon::Project> scene = cli::loadProject(arguments.scene);
    if (!scene) return scene.error();
    project = std::move(scene).value();
  }
  const sillon::Project given = project;
  for (const auto& change : arguments.changes) {
    if (std::string problem = change(project); !problem.empty()) {
      return Error{ErrorCode::InvalidArgument, std::move(problem)};
    }
  }
  sillon::followAdvance(given, project);
  if (std::string problem = cli::applyPictures(arguments.pictures, project); !problem.empty()) {
    return Error{ErrorCode::InvalidArgument, std::move(problem)};
  }
  if (auto wrong = sillon::invalidSettings(project)) return *std::move(wrong);
  return project;
}

int endWithoutMemory() {
  // Without a string, which would take memory.
  std::fputs("sillon: the memory does not suffice; a larger spacing or a smaller size takes less\n", stderr);
  return 2;
}

/// Where memory runs out in what may not throw: destructors, and some of the libraries.
[[noreturn]] void onTerminate() {
  try {
    if (const std::exception_ptr problem = std::current_exception()) std::rethrow_exception(problem);
  } catch (const std::bad_alloc&) {
    std::_Exit(endWithoutMemory());
  } catch (...) {  // ends as without this handler
  }
  std::abort();
}

/// Everything up to the first byte on the disk.
sillon::Result<cli::Outcome> prepare(const cli::Arguments& arguments, sillon::Project project, cli::Job& job,
                                     sillon::RunContext& run) {
  cli::ProgressBar bar(!arguments.quiet);
  run.onProgress([&bar](std::string_view stage, double fraction) { bar.show(stage, fraction); });
  const cli::OutputPaths& outputs = arguments.outputs;
  sillon::PlateOptions options;
  options.placing = arguments.placing;
  if (!outputs.gcode.empty() && sillon::needsAcross(project.print)) options.path = sillon::PlatePath::Both;
  // Measuring takes its time: only if the report, the header of the G-code or the summary shows it.
  options.measure = !outputs.report.empty() || !outputs.gcode.empty() || !arguments.quiet;
  options.countDislocations = !outputs.report.empty();  // shown there alone
  options.judgePictures = outputs.gcode.empty();
  sillon::Result<sillon::Plate> plate = sillon::makePlate(std::move(project), cli::readInputFile, options, run);
  if (!plate) return plate.error();
  job.plate = std::move(plate).value();
  auto files = cli::makeOutputs(job, outputs, run);
  run.onProgress({});
  if (!files) return files.error();
  std::string summary = arguments.quiet ? "" : cli::summary(job.plate, files.value());
  return cli::Outcome{std::move(files).value(), std::move(summary)};
}

/// What a command is asked for goes to stdout; a full disk or a closed pipe loses it.
int answer(const std::string& text, int code) {
  const bool written = std::fputs(text.c_str(), stdout) >= 0 && std::fflush(stdout) == 0;
  if (written) return code;
  return fail({ErrorCode::InvalidFile, std::string("stdout cannot be written: ") + std::strerror(errno)});
}

int check(const cli::Arguments& arguments) {
  sillon::Result<std::string> file = cli::readFile(arguments.check, "G-code", cli::kMaxGcodeBytes);
  if (!file) return fail(file.error());
  const sillon::Result<sillon::GcodeContainer> container = sillon::readGcodeContainer(std::move(file).value());
  if (!container) return fail(container.error());
  if (container.value().plates > 1) return fail(cli::severalPlates(arguments.check, container.value().plates));
  const std::string& text = container.value().gcode;
  const sillon::GcodeCheck result = sillon::checkGcode(text, arguments.checkPrinter);
  const std::vector<std::string> unchecked = sillon::uncheckedIn(text, arguments.checkPrinter);
  return answer(arguments.checkJson ? cli::checkJson(result, unchecked) : cli::checkText(result, unchecked),
                result.errors() == 0 ? 0 : 2);
}

/// The printer as a project on stdout, what needs a look on stderr.
int importFrom(const cli::Arguments& arguments) {
  const sillon::Result<std::string> text = cli::readFile(arguments.import, "file", cli::kMaxInputBytes);
  if (!text) return fail(text.error());
  const sillon::Result<sillon::ImportedPrinter> imported = sillon::importPrinter(text.value(), arguments.importName);
  if (!imported) return fail(imported.error());
  const sillon::ImportedPrinter& printer = imported.value();
  const std::string under = printer.profile.empty() ? "" : ", the rest from the profile " + printer.profile;
  if (const int code = answer(sillon::writePrinter(printer.printer), 0); code != 0) return code;
  std::fprintf(stderr, "sillon: read %zu settings as %s%s\n", printer.read.size(), printer.source.c_str(),
               under.c_str());
  for (const sillon::ImportNote& note : printer.notRead)
    std::fprintf(stderr, "sillon: note: %s\n", note.message.c_str());
  return 0;
}

/// The one place where files are written, after all that can fail. They are what was asked for, as JSON is: once they
/// are there, a summary that gets lost is no failure.
int commit(const sillon::Result<cli::Outcome>& made, const sillon::RunContext& run) {
  if (!run.cancelled() && !made) return fail(made.error());
  // From here on it is faster to finish than to stop.
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
#ifdef SIGHUP
  std::signal(SIGHUP, SIG_IGN);
#endif
  if (run.cancelled()) return fail({ErrorCode::Cancelled, kCancelled});
  if (const std::optional<Error> problem = cli::writeTogether(made.value().files)) return fail(*problem);
  if (made.value().files.empty() || made.value().textIsAsked) return answer(made.value().text, 0);
  std::fputs(made.value().text.c_str(), stdout);
  return 0;
}

int rebrush(const cli::RebrushArguments& arguments) {
  sillon::RunContext run(cli::threadsHere(arguments.threads));
  run.limitMemory(cli::memoryForPlates());
  const CancelOnSignal cancelOnSignal(run);
  return commit(cli::runRebrush(arguments, run), run);
}

int zones(const cli::Arguments& arguments) {
  sillon::RunContext run(cli::threadsHere(arguments.threads));
  run.limitMemory(cli::memoryForPlates());
  const CancelOnSignal cancelOnSignal(run);
  sillon::Result<sillon::Project> project = readInput(arguments);
  if (!project) return fail(project.error());
  return commit(cli::runZones(arguments.zones, std::move(project).value(), run), run);
}

int readPhotographs(cli::Arguments arguments) {
  std::vector<std::string> photographs = arguments.pictures.files;
  if (!arguments.scene.empty()) photographs.push_back(arguments.scene);
  photographs.insert(photographs.end(), arguments.calibrate.further.begin(), arguments.calibrate.further.end());
  arguments.scene.clear();
  arguments.pictures.files.clear();
  sillon::RunContext run(cli::threadsHere(arguments.threads));
  const CancelOnSignal cancelOnSignal(run);
  const sillon::Result<sillon::Project> project = readInput(arguments);
  if (!project) return fail(project.error());
  return commit(cli::runReadPhotographs(arguments.calibrate, photographs, project.value(), run), run);
}

int calibrate(const cli::Arguments& arguments) {
  if (!arguments.pictures.files.empty()) {
    return fail({ErrorCode::InvalidArgument,
                 "\"" + arguments.pictures.files.front() + "\" is a picture; calibrate takes a project file"});
  }
  sillon::RunContext run(cli::threadsHere(arguments.threads));
  run.limitMemory(cli::memoryForPlates());
  const CancelOnSignal cancelOnSignal(run);
  const sillon::Result<std::string> date = cli::runDate();
  if (!date) return fail(date.error());
  const sillon::Result<sillon::Project> project = readInput(arguments);
  if (!project) return fail(project.error());
  return commit(
      cli::runCalibrate(arguments.calibrate, arguments.pictures, project.value(), arguments.scene, date.value(), run),
      run);
}

int generate(const cli::Arguments& arguments) {
  sillon::RunContext run(cli::threadsHere(arguments.threads));
  run.limitMemory(cli::memoryForPlates());
  const CancelOnSignal cancelOnSignal(run);

  cli::Job job;
  sillon::Result<std::string> date = cli::runDate();
  if (!date) return fail(date.error());
  job.date = std::move(date).value();

  sillon::Result<sillon::Project> project = readInput(arguments);
  if (!project) return fail(project.error());
  const std::size_t pictures = project.value().pictures.files.size();

  job.pictureOptions = arguments.pictures;
  std::vector<std::string> inputs = cli::inputFiles(project.value());
  for (const std::string* name : {&arguments.scene, &arguments.pictures.spoolsFile, &arguments.outputs.container}) {
    if (!name->empty()) inputs.push_back(*name);
  }
  if (const std::optional<Error> problem = cli::checkOutputs(cli::outputNames(arguments.outputs, pictures), inputs)) {
    return fail(*problem);
  }

  if (!arguments.outputs.container.empty() && arguments.outputs.gcode.empty()) {
    return fail({ErrorCode::InvalidArgument,
                 "--container is \"" + arguments.outputs.container + "\"; it must go with --gcode"});
  }
  if (!arguments.outputs.conflict.empty() && pictures < 2) {
    return fail({ErrorCode::InvalidArgument,
                 "--conflict is \"" + arguments.outputs.conflict + "\"; it must go with two pictures or more"});
  }

  const sillon::Result<cli::Outcome> made = prepare(arguments, std::move(project).value(), job, run);
  if (made && made.value().files.empty() && job.bodyRefused) return fail(*job.bodyRefused);
  const int code = commit(made, run);
  return code == 0 && job.bodyRefused ? fail(*job.bodyRefused) : code;
}

}  // namespace

int main(int argc, char** argv) {
  cli::keepFreedMemory();
  std::set_terminate(onTerminate);
#ifdef SIGPIPE
  std::signal(SIGPIPE, SIG_IGN);  // whoever reads what is said may go away: what is written stays
#endif
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);  // a file larger than the shell allows is an error of writing
#endif
  try {
    sillon::Result<cli::Arguments> arguments = cli::readArguments(argc, argv);
    if (!arguments) return fail(arguments.error());
    if (!arguments.value().answer.empty()) return answer(arguments.value().answer, 0);
    for (cli::PictureOptions* options : {&arguments.value().pictures, &arguments.value().rebrush.pictures}) {
      if (const std::optional<Error> problem = cli::readOwnSpools(*options)) return fail(*problem);
    }
    const std::string& command = arguments.value().command;
    if (command == "check") return check(arguments.value());
    if (command == "rebrush") return rebrush(arguments.value().rebrush);
    if (command == "zones") return zones(arguments.value());
    if (command == "calibrate") {
      const bool reads = arguments.value().calibrate.kind == cli::kReadPhotograph;
      return reads ? readPhotographs(arguments.value()) : calibrate(arguments.value());
    }
    if (command == "shape") {
      const cli::ShapeAnswer shapes = cli::describeShapes(arguments.value().shape);
      return answer(shapes.text, shapes.failed ? 2 : 0);
    }
    if (command == "import") return importFrom(arguments.value());
    return generate(arguments.value());
  } catch (const std::bad_alloc&) {
    return endWithoutMemory();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sillon: stopped by %s; this is a fault of the program\n", error.what());
    return 1;
  }
}
