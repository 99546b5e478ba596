#include "bindings.hpp"

#include <emscripten/bind.h>

namespace sillon::bindings {

EMSCRIPTEN_BINDINGS(sillon) {
  using emscripten::function;
  function("start", &start);
  function("room", &room);
  function("keptNumbers", &keptNumbers);

  function("generateToolpath", &generateToolpath);
  function("readShape", &readShape);
  function("placeLayers", &placeLayers);
  function("drawLayers", &drawLayers);
  function("makeZones", &makeZones);
  function("linesOfDrawing", &linesOfDrawing);
  function("paintDrawing", &paintDrawing);
  function("decodePicture", &decodePicture);
  function("readProject", &readProject);
  function("writeProject", &writeProject);
  function("profiles", &profiles);

  function("writeGcode", &writeGcode);
  function("writeBaseBody", &writeBaseBody);
  function("writeSvg", &writeSvg);
  function("renderPreview", &renderPreview);
  function("writeView", &writeView);
  function("importPrinter", &importPrinter);
  function("checkGcode", &checkGcode);
  function("packGcode", &packGcode);
  function("examineBlock", &examineBlock);

  function("forgetPrint", &forgetPrint);
  function("readPrint", &readPrint);
  function("listSurfaces", &listSurfaces);
  function("printRelief", &printRelief);
  function("rebrush", &rebrush);

  function("calibrate", &calibrate);
  function("readCoupon", &readCoupon);
  function("joinReadings", &joinReadings);
}

}  // namespace sillon::bindings
