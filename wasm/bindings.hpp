// Everything that JavaScript may call of the engine, as src/engine/worker.ts describes it: each function returns
// {value} or {error: {code, message, reason, values}}, and no exception leaves.
#pragma once

#include <emscripten/val.h>

#include <string>

namespace bindings {

using emscripten::val;

/// \param most  that the memory may grow to [bytes]. \param poll  () => boolean, for RunContext::onPoll; null where
/// memory is shared.
val start(int threads, double most, const val& poll);
/// Memory for a file of so many bytes: good until the next call, which takes the file from there.
val room(double size);
/// Numbers of what the calls below need no value for: kept.hpp.
val keptNumbers();

/// \param across  the path of the layer below instead, which nothing measures. \param number  under which its beads are
/// kept.
val generateToolpath(const std::string& projectJson, const val& files, bool measure, bool across, int number,
                     const val& onProgress);
val readShape(const std::string& projectJson, const val& files);
val placeLayers(const std::string& projectJson, const val& files);
/// Directions and modes that the layers ask for.
val paintDrawing(const val& files, const std::string& name);
val drawLayers(const std::string& projectJson, const val& files, const val& onProgress);
/// \param body  whether an STL has come, on whose top the layers lie. \param params  height of the prism without one,
/// most directions, narrowest place, layer height.
val makeZones(const std::string& projectJson, const val& files, bool body, const val& params, const val& onProgress);
/// Names under which the calls above ask for lines of a drawing's text. \param file  bytes.
val linesOfDrawing(const val& file);
val decodePicture(const val& file, const std::string& name);
val readProject(const std::string& json);
/// \param projectJson  made of arguments: what is wrong in it is no file's fault.
val writeProject(const std::string& projectJson);
/// Printers as the text of project files.
val profiles();

/// \param below  a toolpath, or undefined. \param number  under which the text is kept; 0: it is not.
val writeGcode(const val& toolpath, const val& below, const std::string& projectJson, const std::string& date,
               int number, const val& onChunk);
val writeBaseBody(const val& shape, const std::string& projectJson, bool stl);
val writeSvg(const val& toolpath);
val renderPreview(const val& toolpath, int width, const val& light, const val& colour, const val& slopes, bool lookOnly,
                  const val& onProgress);
val writeView(const val& toolpath, const val& colour, double slopeAlong, double slopeAcross);
val importPrinter(const std::string& name);
/// \param projectJson  whose printer counts; empty: what the file's own settings say. \param number  of the text that
/// is kept; 0: of the file that came last.
val checkGcode(const std::string& projectJson, int number);
val packGcode(int number);
/// \param projectJson  whose printer's flavour counts.
val examineBlock(const std::string& block, const std::string& projectJson);

/// Makes room for another print.
void forgetPrint();
/// Takes the file that came last, for the calls below.
val readPrint();
val listSurfaces(const val& onProgress);
/// \param side  most cells of the longer side.
val printRelief(int side, const val& onProgress);
/// \param projectJson  whose layers, pictures and toolpath count. \param sides, fit, only  as sillon.d.ts
/// names them. \param onPiece  takes the new file piece by piece: whole, it would be held once more.
val rebrush(const std::string& projectJson, const val& files, const std::string& sides, const std::string& fit,
            const val& only, const val& onProgress, const val& onPiece);

/// \param kind  as the command line names it. \param from, to  undefined: the kind's own.
/// \param pictureSide  of the longer side [pixels], 0: no picture.
val calibrate(const std::string& kind, const val& from, const val& to, const std::string& projectJson,
              const val& filament, const std::string& date, int pictureSide);
/// \param picture  as imageFrom takes it. \param projectJson  that the coupon was made with.
val readCoupon(const val& picture, const std::string& projectJson, const val& from, const val& to, const val& lampSize,
               const val& lampElevation);
/// \param readings  a list, as readCoupon gives them, of at least one.
val joinReadings(const val& readings, const val& lampSize);

}  // namespace bindings
