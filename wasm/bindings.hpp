// Functions of the engine that JavaScript may call; src/engine/worker.ts declares them. Each returns {value} or {error:
// {code, message, reason, values}}, and no exception leaves it.
#pragma once

#include <emscripten/val.h>

#include <string>

namespace sillon::bindings {

using emscripten::val;

/// Starts the engine.
/// \param most  limit of the memory [bytes].
/// \param poll  () => boolean, for RunContext::onPoll; null if memory is shared.
val start(int threads, double most, const val& poll);
/// Returns memory for a file of this size. It is valid until the next call, which takes the file from there.
val room(double size);
/// Returns the numbers of values that the engine keeps, which calls need not hand over: see kept.hpp.
val keptNumbers();

/// Makes a plate.
/// \param across  true for the path of the layer below, which is never measured.
/// \param number  number under which the beads are kept.
val generateToolpath(const std::string& projectJson, const val& files, bool measure, bool across, int number,
                     const val& onProgress);
val readShape(const std::string& projectJson, const val& files);
val placeLayers(const std::string& projectJson, const val& files);
/// Paints a drawing to a picture.
val paintDrawing(const val& files, const std::string& name);
/// Returns the directions and modes that the layers give.
val drawLayers(const std::string& projectJson, const val& files, const val& onProgress);
/// Makes a body with zones.
/// \param body  true if an STL was handed over, on whose top the layers lie.
/// \param params  height of the prism without a body, largest number of directions, narrowest place, layer height; with
/// a face, its corner and height.
val makeZones(const std::string& projectJson, const val& files, bool body, const val& params, const val& onProgress);
/// Returns the names under which the calls above ask for lines of a drawing's text. \param file  bytes.
val linesOfDrawing(const val& file);
val decodePicture(const val& file, const std::string& name);
val readProject(const std::string& json);
/// Formats a project. \param projectJson  made from arguments, so that its errors are InvalidArgument.
val writeProject(const std::string& projectJson);
/// Returns all printers and filaments, as texts of project files.
val profiles();

/// Writes G-code.
/// \param below  a toolpath, or undefined.
/// \param number  number under which the text is kept; 0 to keep nothing.
val writeGcode(const val& toolpath, const val& below, const std::string& projectJson, const std::string& date,
               int number, const val& onChunk);
val writeBaseBody(const val& shape, const std::string& projectJson, bool stl);
val writeSvg(const val& toolpath);
val renderPreview(const val& toolpath, int width, const val& light, const val& colour, const val& slopes, bool lookOnly,
                  const val& onProgress);
val writeView(const val& toolpath, const val& colour, double slopeAlong, double slopeAcross);
val importPrinter(const std::string& name);
/// Checks G-code.
/// \param projectJson  project whose printer's limits apply; empty to use the file's own settings.
/// \param number  number of a kept text; 0 for the file that came last.
val checkGcode(const std::string& projectJson, int number);
val packGcode(int number);
/// Checks a block of G-code. \param projectJson  project whose printer's flavour applies.
val examineBlock(const std::string& block, const std::string& projectJson);

/// Forgets the last print, to make room for another.
void forgetPrint();
/// Takes the file that came last as the print for the calls below.
val readPrint();
val listSurfaces(const val& onProgress);
/// Returns the heights of the print in a raster. \param side  largest number of cells on the longer side.
val printRelief(int side, const val& onProgress);
/// Replaces surfaces of the print.
/// \param projectJson  project whose layers, pictures and toolpath apply.
/// \param sides, fit, only  see sillon.d.ts.
/// \param onPiece  receives the new file in pieces; as a whole, it would be in memory twice.
val rebrush(const std::string& projectJson, const val& files, const std::string& sides, const std::string& fit,
            const val& only, const val& onProgress, const val& onPiece);

/// Makes a calibration print.
/// \param kind  name in the command line.
/// \param from, to  undefined for the kind's own.
/// \param pictureSide  longer side of the picture [pixels]; 0 for none.
val calibrate(const std::string& kind, const val& from, const val& to, const std::string& projectJson,
              const val& filament, const std::string& date, int pictureSide);
/// Reads a photograph of a coupon.
/// \param picture  pixels, see imageFrom().
/// \param projectJson  project with which the coupon was made.
val readCoupon(const val& picture, const std::string& projectJson, const val& from, const val& to, const val& lampSize,
               const val& lampElevation);
/// Joins readings of one coupon. \param readings  list of at least one result of readCoupon().
val joinReadings(const val& readings, const val& lampSize);

}  // namespace sillon::bindings
