// The options of commands other than generate, apart from what the commands do: what CLI11 is made of takes compilers
// long.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibrate.hpp"
#include "options.hpp"
#include "pictures.hpp"
#include "rebrush.hpp"
#include "words.hpp"
#include "zones.hpp"

namespace cli {
namespace {

using sillon::DirectionEncoding;
using sillon::PerimeterMode;
using sillon::PictureFit;

constexpr const char* kZonesExamples =
    "Examples:\n"
    "  sillon zones --shape badge.svg --directions waves.png --zones 6 -o badge.3mf\n"
    "  sillon zones --body part.stl --picture face.png --lamp 60 --zones 12 -o part.3mf\n"
    "\n"
    "Open the file in PrusaSlicer, OrcaSlicer or Bambu Studio and slice it with the layer heights given here: slicers\n"
    "turn their lines by 90 degrees on every other layer.";

constexpr const char* kCalibrateExamples =
    "Examples:\n"
    "  sillon calibrate coupon --printer prusa-mk4 --filament pla-silk -o coupon.gcode\n"
    "  sillon calibrate flow mine.json -o flow.gcode --preview flow.png\n"
    "  sillon calibrate advance mine.json --from 0.2 --to 0.6 -o advance.gcode --json\n"
    "  sillon calibrate read photograph.jpg --name mySilk -o mine.json   (a photograph of the coupon)\n"
    "  sillon calibrate read left.jpg right.jpg back.jpg    (several of one coupon, the lamp elsewhere in each)\n"
    "\n"
    "docs/guide/calibrate.md shows what to look for on each, and what to type back.";

constexpr const char* kRebrushExamples =
    "Examples:\n"
    "  sillon rebrush part.gcode --list\n"
    "  sillon rebrush part.gcode --angle 30 -o part_brushed.gcode\n"
    "  sillon rebrush part.gcode --directions waves.png --report part.json -o part_brushed.gcode\n"
    "  sillon rebrush part.gcode.3mf --picture face.png --lamp 60 --preview face_shown.png -o part_brushed.gcode.3mf\n"
    "\n"
    "Without -o the file itself is changed, as slicers expect of post-processing scripts.\n"
    "Exit codes: 0 done, 2 refused, 3 cancelled, 1 a fault of the program. Nothing is written unless all is done.";

std::string joined(const std::vector<std::string>& words, const char* between, const char* last) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k) {
    text += (k == 0 ? "" : k + 1 == words.size() ? last : between) + words[k];
  }
  return text;
}

/// Takes one of some words; throws by refuse().
template <class Value>
std::function<void(const std::string&)> choice(const char* option, std::vector<std::pair<std::string, Value>> words,
                                               std::function<void(Value)> take) {
  return [=](const std::string& text) {
    std::string all;
    for (const auto& [word, value] : words) {
      if (word == text) return take(value);
      all += (all.empty() ? "" : ", ") + word;
    }
    refuse(option, text, "one of " + all);
  };
}

}  // namespace

void addPictures(CLI::App& app, PictureOptions& pictures) {
  const char* group = "Pictures";
  CLI::Option* picture =
      app.add_option("--picture", pictures.files, "picture to be seen under a lamp; again for more, each under its own")
          ->option_text("F")
          ->allow_extra_args(false)
          ->group(group);
  picture->excludes(app.get_option("--directions"))->excludes(app.get_option("--angle"));
  app.add_option("--lamp", pictures.lamps,
                 "where the lamp of the first, then of the next picture stands, in degrees; also of --preview [chosen]")
      ->option_text("AZ[,EL]")
      ->allow_extra_args(false)
      ->group(group);
  app.add_option("--lamp-size", pictures.lampSize, "how large the lamps are, or their slope [softbox]")
      ->option_text("bulb|softbox|window|SLOPE")
      ->group(group);
  app.add_option("--proportions", pictures.proportions,
                 "cut off what sticks out of the page, or stretch the picture over it [keep]")
      ->option_text("keep|stretch")
      ->group(group);
  addSpools(app, pictures, group);
  addNumber(app, "--smoothness", pictures.smoothness, "more: fewer U-turns, less detail [0.02]")
      ->option_text("F")
      ->group(group);
  addNumber(app, "--local-contrast", pictures.localContrast, "raises what differs from its surroundings [0]")
      ->option_text("F")
      ->group(group);
}

void addSpools(CLI::App& app, PictureOptions& pictures, const std::string& group) {
  app.add_option("--spool", pictures.spool, "what the filament looks like [bluePla]")->option_text("KEY")->group(group);
  app.add_option("--spools", pictures.spoolsFile, "file of your own spools, of which --spool names one")
      ->option_text("F.json")
      ->group(group);
}

void addZones(CLI::App& command, ZonesArguments& arguments) {
  const char* group = "Zones";
  command.footer(kZonesExamples);
  command.add_option("-o,--output", arguments.out, "the 3MF")->option_text("F.3mf")->required()->group(group);
  CLI::Option* body =
      command.add_option("--body", arguments.body, "STL whose top surfaces get the zones [a prism of the shape]")
          ->option_text("F.stl")
          ->group(group);
  addNumber(command, "--height", arguments.height, "of that prism [2]")->option_text("MM")->group(group);
  for (const char* other : {"--height", "--shape", "--size"}) body->excludes(command.get_option(other));
  addNumber(command, "--zones", arguments.params.most, "how many directions at most, 2 to 12 [6]")
      ->option_text("N")
      ->group(group);
  addNumber(command, "--least", arguments.params.least, "narrowest place of a zone, 0.5 to 100 [3]")
      ->option_text("MM")
      ->group(group);
  addNumber(command, "--layer-height", arguments.layers.height, "of your slicer's profile [0.2]")
      ->option_text("MM")
      ->group(group);
  addNumber(command, "--first-layer-height", arguments.layers.firstHeight, "of your slicer's profile [0.2]")
      ->option_text("MM")
      ->group(group);
}

void addCalibrate(CLI::App& command, CalibrateArguments& arguments) {
  const char* group = "Calibration";
  const std::string kinds =
      joined(sillon::calibrationKinds(), ", ", " or ") + "; or read, for a photograph of the coupon";
  command.footer(kCalibrateExamples);
  command
      .add_option_function<std::string>(
          "kind",
          [&arguments, kinds](const std::string& text) {
            const std::vector<std::string>& all = sillon::calibrationKinds();
            if (text != kReadPhotograph && std::find(all.begin(), all.end(), text) == all.end()) {
              refuse("kind", text, kinds);
            }
            arguments.kind = text;
          },
          kinds)
      ->option_text("KIND")
      ->required();
  command
      .add_option("-o,--output", arguments.out,
                  "G-code; packed if F ends in .gcode.3mf, .bgcode or .gz; of a photograph, a file for --spools")
      ->option_text("F")
      ->group(group);
  addNumber(command, "--from", arguments.from, "first value to try [as the kind has it]")
      ->option_text("VALUE")
      ->group(group);
  addNumber(command, "--to", arguments.to, "last value to try [likewise]")->option_text("VALUE")->group(group);
  command.add_option("--preview", arguments.preview, "picture of directions and look, PNG")
      ->option_text("F")
      ->group(group);
  addPreviewWidth(command, arguments.previewWidth, "width of each of the picture's two panels [1600]")->group(group);
  command.add_flag("--json", arguments.json, "what is printed, as JSON")->group(group);
  const char* photograph = "Photograph (read)";
  command.add_option("--name", arguments.name, "of the spool [mySpool]")->option_text("KEY")->group(photograph);
  command
      .add_option("--lamp-size", arguments.lampSize, "of the lamp: bulb, softbox, window or its slope [unknown, small]")
      ->option_text("S")
      ->group(photograph);
  addNumber(command, "--lamp-elevation", arguments.lampElevation,
            "how high the lamp stands, as measured within 2 degrees [47 within 9]")
      ->option_text("DEG")
      ->group(photograph);
}

void addRebrush(CLI::App& app, RebrushArguments& arguments) {
  CLI::App* command = app.add_subcommand("rebrush", "Lay other beads on the top surfaces of a file by your slicer");
  command->footer(kRebrushExamples);
  command->add_option("file", arguments.file, "what PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio or Cura wrote")
      ->option_text("FILE.gcode")
      ->required();
  command->add_flag("--list", arguments.list, "show the surfaces, write nothing");
  command->add_flag("--json", arguments.json, "the list as JSON");
  command->add_option("-o,--output", arguments.out, "where the new file goes [the file itself]")->option_text("F");
  command->add_option("--report", arguments.report, "what became of each surface, JSON")->option_text("F");
  command->add_option("--preview", arguments.preview, "picture of each new surface: its directions, and its look")
      ->option_text("F");
  addPreviewWidth(*command, arguments.previewWidth, "of each of its panels [1600]");
  command
      ->add_option_function<std::string>("--surfaces",
                                         choice<int>("--surfaces", {{"top", 1}, {"bottom", 2}, {"both", 3}},
                                                     [&arguments](int which) {
                                                       arguments.options.tops = (which & 1) != 0;
                                                       arguments.options.bottoms = (which & 2) != 0;
                                                     }),
                                         "top, bottom (on the bed) or both [top]")
      ->option_text("WHICH");
  command
      ->add_option_function<std::vector<std::string>>(
          "--only",
          [&arguments](const std::vector<std::string>& words) {
            for (const std::string& word : words) {
              const std::optional<double> number = parseNumber(word);
              if (!number || !(*number >= 1 && *number <= 1e6) || *number != std::floor(*number)) {
                refuse("--only", word, "a number that --list shows; the first is 1");
              }
              arguments.options.only.push_back(static_cast<std::size_t>(*number) - 1);
            }
          },
          "these surfaces alone, by their numbers in --list")
      ->delimiter(',')
      ->option_text("N,N...");
  addNumber(*command, "--angle", arguments.angle, "direction of the beads, counter-clockwise from +x [0]")
      ->option_text("DEG");
  command->add_option("--directions", arguments.directions, "picture of directions, instead of an angle")
      ->option_text("F");
  command
      ->add_option_function<std::string>(
          "--encoding",
          choice<DirectionEncoding>("--encoding",
                                    {{"angle", DirectionEncoding::Angle},
                                     {"rotation", DirectionEncoding::Rotation},
                                     {"tangent", DirectionEncoding::Tangent}},
                                    [&arguments](DirectionEncoding encoding) { arguments.encoding = encoding; }),
          "how the picture tells directions: angle, rotation, tangent [angle]")
      ->option_text("HOW");
  command
      ->add_option("--modes", arguments.modes,
                   "parallel, orthogonal, smoothest, constrained, or a picture of modes [constrained]")
      ->option_text("M");
  command
      ->add_option_function<std::string>(
          "--fit",
          choice<PictureFit>("--fit",
                             {{"face", PictureFit::Face},
                              {"object", PictureFit::Object},
                              {"bed", PictureFit::Bed},
                              {"all", PictureFit::All}},
                             [&arguments](PictureFit fit) { arguments.options.fit = fit; }),
          "what the pictures are stretched over: each face, each object, the bed, or the box around all [face]")
      ->option_text("WHAT");
  command
      ->add_option_function<std::string>(
          "--perimeters",
          [&arguments](const std::string& text) {
            sillon::ToolpathParams& params = arguments.options.toolpath;
            arguments.perimeters = true;
            if (text == "none" || text == "soft") {
              params.perimeterMode = text == "none" ? PerimeterMode::None : PerimeterMode::Soft;
              return;
            }
            if (text.empty() || text.size() > 3 || text.find_first_not_of("0123456789") != std::string::npos) {
              refuse("--perimeters", text, "none, soft or 0 to 100");
            }
            params.perimeterMode = PerimeterMode::Count;
            params.perimeters = std::atoi(text.c_str());
          },
          "beads along the border of each surface: none, soft or a number [1; soft with --picture]")
      ->option_text("N");
  addPictures(*command, arguments.pictures);
  addThreads(*command, arguments.threads);
  CLI::Option* list = command->get_option("--list");
  command->get_option("--json")->needs(list);
  for (const char* output : {"--output", "--report", "--preview"}) list->excludes(command->get_option(output));
  command->get_option("--angle")->excludes(command->get_option("--directions"));
}

}  // namespace cli
