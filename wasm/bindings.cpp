#include "bindings.hpp"

#include <emscripten/bind.h>

EMSCRIPTEN_BINDINGS(sillon) {
  using emscripten::function;
  function("start", &bindings::start);
  function("room", &bindings::room);
  function("keptNumbers", &bindings::keptNumbers);

  function("generateToolpath", &bindings::generateToolpath);
  function("readShape", &bindings::readShape);
  function("placeLayers", &bindings::placeLayers);
  function("drawLayers", &bindings::drawLayers);
  function("makeZones", &bindings::makeZones);
  function("linesOfDrawing", &bindings::linesOfDrawing);
  function("paintDrawing", &bindings::paintDrawing);
  function("decodePicture", &bindings::decodePicture);
  function("readProject", &bindings::readProject);
  function("writeProject", &bindings::writeProject);
  function("profiles", &bindings::profiles);

  function("writeGcode", &bindings::writeGcode);
  function("writeBaseBody", &bindings::writeBaseBody);
  function("writeSvg", &bindings::writeSvg);
  function("renderPreview", &bindings::renderPreview);
  function("writeView", &bindings::writeView);
  function("importPrinter", &bindings::importPrinter);
  function("checkGcode", &bindings::checkGcode);
  function("packGcode", &bindings::packGcode);
  function("examineBlock", &bindings::examineBlock);

  function("forgetPrint", &bindings::forgetPrint);
  function("readPrint", &bindings::readPrint);
  function("listSurfaces", &bindings::listSurfaces);
  function("printRelief", &bindings::printRelief);
  function("rebrush", &bindings::rebrush);

  function("calibrate", &bindings::calibrate);
  function("readCoupon", &bindings::readCoupon);
  function("joinReadings", &bindings::joinReadings);
}
