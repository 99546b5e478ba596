// Made by tools/generate.mjs from the core's words: ./dev generate.
export const words = {
  'help.layers.kind':
    'The content of the layer: one direction, a direction picture, pictures under their lamps, a text, a QR code, a pattern, the tones of a picture, a drawing, a band along the border, or strokes of brushes.',
  'help.layers.visible': 'A layer that is not visible draws nothing.',
  'help.layers.at': 'Middle of the layer, from the lower left corner of the page; null: the middle of the page.',
  'help.layers.size': 'Width and height before it turns; a side of 0 follows the content.',
  'help.layers.rotation': 'Turns the layer counter-clockwise about its middle.',
  'help.layers.mirror': 'Mirrors the layer left to right before it turns.',
  'help.layers.mask':
    'The places where it shows: its own letters, drawing or box, the disc in its box, the whole page, or inside or outside of the mask file.',
  'help.layers.maskFile': 'Drawing or mask picture that bounds the layer, stretched over its box.',
  'help.layers.soft': 'Width over which its directions turn into those below, about its edge.',
  'help.layers.mode': 'Beads lie along the border, across it, as smoothly as possible, or as the directions say.',
  'help.layers.modeFile': 'Picture of the modes, over the layer’s box; empty: the mode everywhere.',
  'help.layers.angle':
    'Direction of its beads on the page, counter-clockwise from the right; turns rays, rings and edges.',
  'help.layers.ground':
    'Direction in the box around letters or a drawing; null: what lies below shows, and the light modules of a QR code lie across the dark ones.',
  'help.layers.fill':
    'Beads fill letters, drawings and borders in one direction, along the outline, or across what lies below.',
  'help.layers.file': 'File of a map, of tones, of a drawing or of an echo.',
  'help.layers.encoding':
    'Reading of a map’s picture as directions: grey is −90 to 90°; grey is 0 to 180°; red and green are x and y.',
  'help.layers.cropMin': 'Lower left corner of the part of a picture that is used, in shares of the picture.',
  'help.layers.cropMax': 'Upper right corner of that part.',
  'help.layers.text': 'Letters, in one or several lines, what a QR code says, or what an echo without a file follows.',
  'help.layers.font': 'A built-in font, or a TTF or OTF file.',
  'help.layers.textSize': 'Height of capitals, where the size is 0.',
  'help.layers.circle':
    'Radius of the circle that letters stand on; 0: straight; below 0: along the lower side, to be read from inside.',
  'help.layers.align': 'Place of shorter lines in the box.',
  'help.layers.correction': 'Share of a QR code that may be damaged: 7, 15, 25 or 30 percent.',
  'help.layers.pattern':
    'Rays from the middle turned by the angle (90 makes rings), rays that turn on their way out, waves, smooth chance, or contours around a drawing or letters.',
  'help.layers.waveLength':
    'Length of one wave, way out over which a spiral turns by 180°, or distance of the knots of noise.',
  'help.layers.amplitude': 'Angle by which waves and noise turn the directions to either side.',
  'help.layers.seed': 'Another number makes another noise of the same kind.',
  'help.layers.by':
    'Directions follow the brightness, two levels of it, the edges, or the flat colours of a picture or drawing.',
  'help.layers.from': 'Direction where the picture is black, or darker than the threshold.',
  'help.layers.to': 'Direction where the picture is white, or lighter than the threshold.',
  'help.layers.threshold': 'Tone between dark and light levels: 0 is black, 1 is white.',
  'help.layers.contrast': 'Contrast of brightness about the middle grey; 1 leaves the picture as it is.',
  'help.layers.smoothing': 'Blur of the brightness, or width over which edges are averaged.',
  'help.layers.width': 'Width of a band along the border.',
  'help.toolpath.spacing': 'Distance between the centre lines of neighbouring beads; start with the nozzle diameter.',
  'help.toolpath.perimeterMode':
    'Whether beads end at the border, follow it where the directions allow, or are enclosed by a number of perimeters.',
  'help.toolpath.perimeters': 'Number of beads along the border, where the border mode encloses the others.',
  'help.toolpath.bridge': 'Joins solids closer than this into one path.',
  'help.toolpath.mapFilter':
    'Whether neighbouring pixels of the direction picture are averaged or the nearest one is taken.',
  'help.toolpath.seed': '0 is regular; every other number gives a different plate of the same quality.',
  'help.toolpath.jitter': 'How far a seed moves the points where directions are sampled.',
  'help.toolpath.phaseTransport':
    'Continues a neighbour’s wave by the mean of both directions, or by the neighbour’s alone as in 2023.',
  'help.toolpath.sweepsPerLevel': 'Smoothing sweeps on each level of the hierarchy; more sweeps take longer.',
  'help.toolpath.spacingVariation':
    'How much closer or wider than the spacing beads may lie to save U-turns, by a factor of up to e^this; 0 keeps them evenly spaced.',
  'help.toolpath.directionTolerance':
    'Beads may deviate from the directions by up to this angle to save U-turns; takes about twice as long.',
  'help.toolpath.kernelRadius':
    'Radius over which the cells’ waves are averaged: three standard deviations of a Gaussian; 0.5 in 2023.',
  'help.toolpath.borderWeight':
    'How strongly beads follow the border where the border mode leaves the choice to them, relative to a neighbour.',
  'help.toolpath.stitchAlignment': 'Cost of misaligned length where two curves are joined.',
  'help.toolpath.order':
    'Lays neighbouring beads soon after one another, for an even shine, or joins curves wherever that costs least.',
  'help.toolpath.relaxationRounds':
    'Rounds of relaxation, which evens out the gaps between beads: fewer kinks, slightly less exact directions.',
  'help.toolpath.relaxationStrength':
    'How far a bead moves towards its wider gap per round, as a fraction of the difference between its gaps.',
  'help.toolpath.relaxationSmoothing': 'How much each round of relaxation straightens a bead.',
  'help.toolpath.widthBalance':
    '0: the nearer neighbour limits the width on both sides (Eq. 16); 1: the space between both neighbours does.',
  'help.toolpath.beadOverlap': 'Overlap of neighbouring beads above which both are made narrower; 1 allows any.',
  'help.toolpath.minWidth': 'Minimum bead width, except where the border leaves less space.',
  'help.toolpath.maxWidth': 'Maximum bead width.',
  'help.toolpath.simplifyTolerance':
    'Largest change of position and width when points are removed; larger values make smaller files.',
  'help.print.layers': 'Number of oriented layers on each side that shows them.',
  'help.print.base': 'Number of plain layers under the oriented ones.',
  'help.print.basePattern':
    'Hatching at alternately 45 and 135°, loops that follow the border, the oriented path itself, or hatching with the layer next to the oriented ones across their beads, which takes a second path.',
  'help.print.basePerimeters': 'Loops around the border of hatched base layers.',
  'help.print.showSide':
    'Top: oriented layers on top. Bed: mirrored on the bed, base above. Both: both sides, for shapes that are their own mirror image.',
  'help.print.skirt': 'Loops around the plates that prime the nozzle.',
  'help.print.purgeLength':
    'Filament extruded beside the plate before printing, in addition to what the last print retracted.',
  'help.print.rim':
    'Number of layers of a raised border on top of the oriented layers, along the outline and its holes.',
  'help.print.rimWidth': 'Width of the raised border, in whole lines as wide as the nozzle and at least one.',
  'help.print.brim': 'Loops attached to the plate’s first layer, for adhesion.',
  'help.print.elephantFoot': 'Inset of the first base layer, to compensate for its being squeezed wider.',
  'help.print.constantFlow':
    'Prints wide oriented beads slower and narrow ones faster (speed × spacing / width, at most 1.5 times the speed), so that the plastic flows evenly; not on the first layer.',
  'help.print.coast': 'Length before the end of a path that is travelled without extruding.',
  'help.print.scarf':
    'Length over which the two ends of an oriented cycle overlap, one ramping down while the other ramps up; requires coasting of 0.',
  'help.print.copies': 'Columns and rows of copies, printed one after another; copied plates may be at most 3 mm high.',
  'help.print.copyGap': 'Distance between copies, brims included.',
  'help.print.layerHeight': 'Layer height, at most 0.8 of the nozzle diameter.',
  'help.print.startHeight':
    'Prints on top of an object of this height that stands on the bed, which the printer must not touch as it homes; at most the build height.',
  'help.print.firstLayerHeight':
    'First layer height, at least 0.05 mm and at most 0.8 of the nozzle diameter; 0 uses the layer height.',
  'help.print.flow':
    'Extrusion multiplier of the oriented layers; slightly below 1 keeps the grooves between beads crisp.',
  'help.print.baseFlow': 'Extrusion multiplier of the base layers; 1 fills them.',
  'help.print.bedFlow':
    'Extrusion multiplier of an oriented layer printed on the bed; less than 1 leaves fine gaps there.',
  'help.print.rotate': 'Rotation of the plate on the bed, counter-clockwise.',
  'help.print.mirror':
    'Mirrors the plate left to right, before rotation, for plates seen from below; a show side on the bed is mirrored automatically.',
  'help.print.strict':
    'Refuses a path that crosses itself or leaves the shape by more than 0.1 mm; otherwise both are only reported.',
  'help.print.place': 'Where the lower left corner of the (rotated) page goes on the bed.',
  'help.printer.name': 'Printer name, written into the G-code.',
  'help.printer.flavor':
    'Firmware dialect of the G-code; Prusa is for Prusa’s Buddy boards; Bambu needs your own start block.',
  'help.printer.bedMin':
    'Lower left corner of the bed: 0, 0 on most printers, negative where the origin is at the centre.',
  'help.printer.bedMax': 'Upper right corner of the bed, at least 10 mm to the right of and above the lower left one.',
  'help.printer.roundBed': 'The bed is the disc inscribed in its corners, which must form a square.',
  'help.printer.excludedMin': 'Lower left corner of a rectangle on the bed that nothing may touch.',
  'help.printer.excludedMax': 'Upper right corner of that rectangle; equal corners exclude nothing.',
  'help.printer.maxZ': 'Highest Z the printer can reach while printing.',
  'help.printer.zOffset':
    'Added to each Z position between the start block and the end block, for printers whose Z is 0 above or below the bed; slicers call it z_offset.',
  'help.printer.nozzle': 'Nozzle diameter; 0.4 mm on most printers.',
  'help.printer.filamentDiameter': 'Filament diameter: 1.75 mm, or 2.85 mm on some printers.',
  'help.printer.filamentDensity': 'Filament density, used only to estimate weight.',
  'help.printer.filamentFlow':
    'Flow ratio of the filament (extrusion multiplier), as calibrated in your slicer; it multiplies the flow of every layer, brim and purge line.',
  'help.printer.filamentType': 'Filament type, written into the G-code.',
  'help.printer.maxNozzleTemperature':
    'Highest nozzle temperature that the hot end is made for, such as 240 with a PTFE tube down to the nozzle.',
  'help.printer.maxBedTemperature': 'Highest bed temperature that the printer is made for.',
  'help.printer.anyTemperature':
    'For experts: allows nozzle temperatures of 0 to 500 °C and bed temperatures of up to 200, whatever the limits are.',
  'help.printer.nozzleTemperature':
    'Nozzle temperature, as on the filament’s label; 170 to the printer’s limit unless any temperature is allowed.',
  'help.printer.firstLayerNozzleTemperature':
    'Nozzle temperature of the first layer, often slightly higher for adhesion; 170 to the printer’s limit unless any temperature is allowed.',
  'help.printer.bedTemperature':
    'Bed temperature, as on the filament’s label; at most the printer’s limit unless any temperature is allowed.',
  'help.printer.speed': 'Printing speed; slow and constant gives the cleanest reflection.',
  'help.printer.firstLayerSpeed': 'Printing speed of the first layer; slower adheres better.',
  'help.printer.baseSpeed': 'Printing speed of base layers above the first; 0 uses the printing speed.',
  'help.printer.showSpeed':
    'Printing speed of the oriented layers; 0 uses the printing speed, but at most 20 mm/s where pressure advance is not set.',
  'help.printer.travelSpeed': 'Speed of moves that do not extrude.',
  'help.printer.machineSpeed':
    'The machine’s own speed limit, at least 5; all speeds are capped at it; 0 means unknown.',
  'help.printer.acceleration': 'Acceleration while printing; 1000 to 2000 gives clean U-turns.',
  'help.printer.firstLayerAcceleration': 'Acceleration on the first layer; 0 uses the printing acceleration.',
  'help.printer.machineAcceleration':
    'The printer’s own acceleration, restored at the end, and the upper limit while printing; 0 means unknown: acceleration is only used for estimates and not set.',
  'help.printer.cornerSpeed': 'Klipper’s square corner velocity; about half of Marlin’s jerk.',
  'help.printer.machineCornerSpeed':
    'The printer’s own corner speed, restored at the end; 0 means unknown: corner speed is only used for estimates and not set.',
  'help.printer.curveAcceleration':
    'Limits speed in curves of radius r to the square root of this times r, but never below 5 mm/s; 0 means no limit.',
  'help.printer.firstLayerFan': 'Fan speed on the first layer.',
  'help.printer.baseFan':
    'Fan speed on base layers above the first; negative values choose what the filament usually gets, such as 100 for PLA, 50 for PETG and 10 for ABS.',
  'help.printer.showFan':
    'Fan speed on oriented layers above the first; negative values choose what the filament usually gets, such as 100 for PLA, 50 for PETG and 10 for ABS.',
  'help.printer.minLayerTime':
    'Layers that would take less time are slowed down, but not below 5 mm/s; 0 means no minimum.',
  'help.printer.maxFlow':
    'Largest volume per second the hot end can melt; wide beads are slowed down to stay within it.',
  'help.printer.maxSegmentsPerSecond': 'Largest number of moves per second the printer’s board can process.',
  'help.printer.pressureAdvance':
    'Pressure advance of the printer and filament; limits how fast the bead width changes along the path.',
  'help.printer.setPressureAdvance': 'Writes pressure advance into the G-code; otherwise the printer keeps its own.',
  'help.printer.retractLength': 'Length of filament retracted before a travel.',
  'help.printer.retractSpeed': 'Speed at which filament is retracted and returned.',
  'help.printer.lift': 'Height the nozzle is raised before a travel.',
  'help.printer.absoluteE':
    'Writes E as absolute positions (M82, reset with G92 E0 on each layer) instead of distances, for hosts that do not support relative extrusion.',
  'help.printer.startGcode': 'Start block with optional placeholders; empty uses the built-in one: home, heat, wait.',
  'help.printer.endGcode': 'End block with optional placeholders; empty uses the built-in one: park, heaters off.',
  'help.printer.screenSizes':
    'Thumbnail sizes in pixels: WxH, WxH/PNG or WxH/QOI; at most 8, with sides of 16 to 1024.',
} as const;
