// sillon printers and sillon filaments: list profiles, or print one as a project file.
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands/commands.hpp"
#include "run.hpp"
#include "sillon/settings/presets.hpp"
#include "sillon/settings/table.hpp"

namespace sillon::cli {
namespace {

struct Arguments {
  std::string id;  ///< id of a profile; empty for all
  bool json = false;
};

/// Returns the dialect of a printer as the settings name it.
std::string flavor(const Printer& printer) {
  Project project;
  project.printer = printer;
  return settingText(*findSetting(Section::Printer, "flavor"), project);
}

/// Formats the row of a printer in the table.
std::string printerLine(const PrinterProfile& profile) {
  const Printer& p = profile.printer;
  const Vec2 size = p.bedMax - p.bedMin;
  const bool centred = p.bedMin.x < 0;
  char bed[64];
  std::snprintf(bed, sizeof bed, "%gx%gx%g%s%s", size.x, size.y, p.maxZ, p.roundBed ? " round" : "",
                centred ? " centred" : "");
  char heat[32];
  std::snprintf(heat, sizeof heat, "%g/%g", p.maxNozzleTemperature, p.maxBedTemperature);
  char line[256];
  // Bambu printers need the user's own start block; others get a plain one.
  const char* start = !p.startGcode.empty() ? "own" : p.flavor == GcodeFlavor::Bambu ? "yours is needed" : "plain";
  std::snprintf(line, sizeof line, "%-28s %-8s %-26s %g    %-9s %s\n", profile.id.c_str(), flavor(p).c_str(), bed,
                p.nozzle, heat, start);
  return line;
}

std::string filamentLine(const PrinterProfile& profile) {
  const Printer& p = profile.printer;
  char line[256];
  std::snprintf(line, sizeof line, "%-12s %-6s %4g then %4g  %4g   %g\n", profile.id.c_str(), p.filamentType.c_str(),
                p.firstLayerNozzleTemperature, p.nozzleTemperature, p.bedTemperature, p.filamentDensity);
  return line;
}

/// Returns a table with a heading and one line per profile.
std::string profileTable(ProfileKind kind) {
  const bool printers = kind == ProfileKind::Printer;
  std::string out =
      printers ? "id                           dialect  bed [mm]                   nozzle most [C]  start block\n"
               : "id           type   nozzle [C]      bed [C]  g/cm3\n";
  for (const PrinterProfile& profile : profiles(kind)) out += printers ? printerLine(profile) : filamentLine(profile);
  return out;
}

/// Returns all profiles as JSON: an object with a list `printers` or `filaments`, whose items have `id`, `maker` if
/// there is one, and `printer`, that section of a project.
std::string profilesJson(ProfileKind kind) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const PrinterProfile& profile : profiles(kind)) {
    Json& one = list.emplace_back(Json{{"id", profile.id}});
    if (!profile.maker.empty()) one["maker"] = profile.maker;
    one["printer"] = Json::parse(writePrinter(profile.printer))["printer"];
  }
  return Json{{kind == ProfileKind::Printer ? "printers" : "filaments", list}}.dump(2) + "\n";
}

/// Returns a project file with the printer of a profile; empty if no profile has this id.
std::string profileFile(ProfileKind kind, const std::string& id) {
  for (const PrinterProfile& profile : profiles(kind)) {
    if (profile.id == id) return writePrinter(profile.printer);
  }
  return "";
}

int run(ProfileKind kind, const char* command, const Arguments& arguments) {
  const std::string& id = arguments.id;
  if (arguments.json && !id.empty()) {
    return fail(
        {ErrorCode::InvalidArgument, "--json applies to the list; a single profile, here " + id + ", is always JSON"});
  }
  const std::string text = arguments.json ? profilesJson(kind)
                           : id.empty()   ? profileTable(kind)
                                          : profileFile(kind, id);
  if (!text.empty()) return answer(text);
  // No profile has this id; applyProfile() is called only for its error message.
  Printer printer;
  return fail({ErrorCode::InvalidArgument, std::string(command) + ": " + applyProfile(kind, id, printer)->message});
}

/// Adds the options of both commands.
template <ProfileKind kind>
Action add(Options& options) {
  const auto arguments = std::make_shared<Arguments>();
  options.file("ID", "write this one as a project file", arguments->id, false);
  options.group("Options");
  options.flag("--json", "print all of them with their values, as JSON", arguments->json);
  const char* name = kind == ProfileKind::Printer ? "printers" : "filaments";
  return [arguments, name] { return run(kind, name, *arguments); };
}

}  // namespace

const Command printersCommand{"printers",
                              "list the printers that come with the program",
                              "[ID]",
                              "--json",
                              "Examples:\n"
                              "  sillon printers prusa-mk4s > mine.json",
                              add<ProfileKind::Printer>};

const Command filamentsCommand{
    "filaments", "list the filaments that come with the program", "[ID]", "--json", "", add<ProfileKind::Filament>};

}  // namespace sillon::cli
