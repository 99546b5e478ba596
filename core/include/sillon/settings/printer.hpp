// A machine with its filament, as a person may describe it.
#pragma once

#include <string>

#include "sillon/base/types.hpp"

namespace sillon {

/// Bambu machines take only what their own slicer's start block begins: they need `startGcode`.
enum class GcodeFlavor { Marlin, Klipper, RepRap, PrusaBuddy, Bambu };

/// A machine with its filament. Lengths mm, speeds mm/s, accelerations mm/s², temperatures in degrees Celsius. Ranges
/// where none stands here: docs/reference/project.md, section `printer`.
struct Printer {
  std::string name = "Generic";
  GcodeFlavor flavor = GcodeFlavor::Marlin;
  Vec2 bedMin{0, 0};
  Vec2 bedMax{220, 220};
  bool roundBed = false;  ///< the disc within bedMin and bedMax, which must be a square
  Vec2 excludedMin;       ///< box on the bed that nothing may touch; of no size: none
  Vec2 excludedMax;
  double maxZ = 200;
  double zOffset = 0;   ///< added to each Z that is written, but those of startGcode and endGcode; -2..2
  double nozzle = 0.4;  ///< 0.05..2
  double filamentDiameter = 1.75;
  double filamentDensity = 1.24;  ///< [g/cm³]
  double filamentFlow = 1;  ///< the slicers' extrusion multiplier: of all that is laid, over the flows of PrintParams
  std::string filamentType = "PLA";
  double maxNozzleTemperature = 300;  ///< what the hot end bears, 170..300
  double maxBedTemperature = 120;     ///< 0..120
  bool anyTemperature = false;        ///< for those who know why: temperatures up to 500 and 200, and cold nozzles
  double nozzleTemperature = 215;     ///< 170..maxNozzleTemperature; 0..500 with anyTemperature
  double firstLayerNozzleTemperature = 220;
  double bedTemperature = 60;  ///< 0..maxBedTemperature; 0..200 with anyTemperature
  double speed = 50;
  double firstLayerSpeed = 20;
  double baseSpeed = 0;  ///< of base layers above the first; 0: `speed`
  double showSpeed = 0;  ///< of oriented layers; 0: `speed`, but at most 20 where nothing sets pressure advance
  double travelSpeed = 120;
  double machineSpeed = 0;  ///< all speeds are held at it; 0: not known
  double acceleration = 1000;
  double firstLayerAcceleration = 0;  ///< set like `acceleration`; 0: the same
  double machineAcceleration = 0;     ///< put back at the end; 0: `acceleration` is only estimated with, not set
  double cornerSpeed = 5;             ///< Klipper's square corner velocity; Marlin's jerk is twice this
  double machineCornerSpeed = 0;      ///< put back at the end; 0: `cornerSpeed` is only estimated with, not set
  double curveAcceleration = 1000;    ///< curves of radius r go at most at √(this · r); 0: as fast as straights
  double firstLayerFan = 0;           ///< [%]
  double baseFan = -1;                ///< of base layers above the first [%]; below 0: what the filament usually gets
  double showFan = -1;                ///< of oriented layers above the first [%], likewise
  double minLayerTime = 8;            ///< layers that would take less are slowed, not below 5 mm/s [s]; 0: none
  double maxFlow = 10;                ///< [mm³/s]
  double maxSegmentsPerSecond = 300;
  double pressureAdvance = 0.04;    ///< [s]; bounds the change of width along the path
  bool setPressureAdvance = false;  ///< write it, and 0 at the end; else the printer's own stays
  double retractLength = 0.8;
  double retractSpeed = 35;
  double lift = 0.4;
  bool absoluteE = false;                      ///< M82 and G92 E0 per layer, for hosts that know nothing else
  std::string startGcode;                      ///< template, docs/reference/gcode.md; empty: home, heat, wait
  std::string endGcode;                        ///< template; empty: park, heaters off
  std::string screenSizes = "32x32, 300x300";  ///< of the pictures for its screen: WxH, WxH/PNG or WxH/QOI
};

}  // namespace sillon
