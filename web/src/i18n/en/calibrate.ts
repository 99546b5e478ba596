// Words of the calibration page, the visitor's own spools and the first print.

export const words = {
  'calibrate.title': 'Calibrate',
  'calibrate.tabs': 'Calibration',
  'calibrate.tab.prints': 'Prints',
  'calibrate.tab.photo': 'Photograph',
  'calibrate.tab.spools': 'Spools',

  // Prints.
  'calibrate.what':
    'Small prints that get to know your printer and filament. Begin with the coupon, or go from the top: each print relies on those before it.',
  'calibrate.kinds': 'Prints',
  'calibrate.cost': '{time} · {grams}',
  'calibrate.grams': '{g} g',
  'calibrate.cannot': 'Not on this printer',
  'calibrate.rendered': 'Rendered, not printed',
  'calibrate.picture': '{name}, as it would look in your filament',
  'calibrate.look': 'What you should see',
  'calibrate.best': 'Value to enter',
  'calibrate.best.value': 'Best value',
  'calibrate.best.constant': 'The right half looked better (constant flow)',
  'calibrate.best.lowest': 'Narrowest even width',
  'calibrate.best.widest': 'Widest even width',
  'calibrate.best.spacing': 'Line width {spacing} mm, variation {variation}',
  'calibrate.best.directions':
    'Nothing, if the numbers read correctly. Choose the filament above whose picture shines like your print, or measure yours.',
  'calibrate.best.swatch': 'Nothing: keep the card with the spool.',
  'calibrate.use': 'Use {value}',
  'calibrate.used': '{name}: {value}',
  'calibrate.inUse': 'In use now',
  'calibrate.toPhoto': 'Photograph it…',

  'calibrate.kind.coupon': 'Coupon',
  'calibrate.finds.coupon': 'Flow, width and directions in one print.',
  'calibrate.see.coupon':
    'Find the lowest disc without dark gaps. The ruler must measure 30 mm. Photograph it, and Sillon reads from it how your filament shines.',
  'calibrate.kind.flow': 'Flow',
  'calibrate.finds.flow': 'How much plastic closes the surface.',
  'calibrate.see.flow':
    'Too little: dark gaps between the turns. Too much: the surface feels rough. Right: two bright wings turn with the lamp, smooth as on a record. Take the lowest value without gaps.',
  'calibrate.kind.speed': 'Speed',
  'calibrate.finds.speed': 'How fast beads stay glossy.',
  'calibrate.see.speed':
    'Above some speed the gloss turns dull or streaky. Take the fastest row that looks like the slowest. If the right half stays even for longer, constant flow suits your extruder.',
  'calibrate.kind.fan': 'Fan',
  'calibrate.finds.fan': 'How much air the gloss can take.',
  'calibrate.see.fan':
    'Too much air takes the gloss of silk and PETG, and beads separate. Without any, edges curl. Take the glossiest strip with clean edges.',
  'calibrate.kind.width': 'Bead width',
  'calibrate.finds.width': 'How narrow and how wide beads may be.',
  'calibrate.see.width':
    'At the narrow end beads tear or leave gaps; at the wide end they flatten, with grooves between them. Note the two widths between which the wedge is closed and even.',
  'calibrate.kind.directions': 'Directions',
  'calibrate.finds.directions': 'Whether prints are mirrored, and how wide the highlight is.',
  'calibrate.see.directions':
    'Two opposite groups of sectors shine and move as you turn the print. The numbers rise counter-clockwise. If they read backwards, the print is mirrored on its way to the bed.',
  'calibrate.kind.swatch': 'Swatch',
  'calibrate.finds.swatch': 'What this spool can do under your lamps.',
  'calibrate.see.swatch':
    'Beads run upright in the letters and horizontally around them. The band below has twelve directions.',

  // Photograph.
  'calibrate.photo.what':
    'Photograph the coupon, and read from it how your filament shines. Photographs stay on this device.',
  'calibrate.photo.drop': 'Drop photographs of one coupon, or choose them',
  'calibrate.photo.choose': 'Choose photographs…',
  'calibrate.photo.another': 'Add photographs…',
  'calibrate.photo.list': 'Photographs',
  'calibrate.photo.remove': 'Remove {name}',
  'calibrate.photo.example': 'A photograph as it should be (rendered)',
  'calibrate.photo.how1': 'Lay it on plain paper that is clearly lighter or darker, all of it in the picture.',
  'calibrate.photo.how2': 'One small lamp in a dark room, half a metre away and 35 to 60° high. No flash, no window.',
  'calibrate.photo.how3': 'Tilt the camera by 10 to 30°, fill half of the picture, and underexpose slightly.',
  'calibrate.photo.how4': 'Take three or more, with the lamp on another side in each: together they are more reliable.',
  'calibrate.photo.elevation': 'Height of the lamp, if measured',
  'calibrate.photo.same': 'The coupon must have been printed with the nozzle and flow that are set now.',
  'calibrate.photo.reading': 'Reading',
  'calibrate.photo.read': {
    one: 'What the photograph shows',
    other: 'What {n} photographs show together',
  },
  'calibrate.photo.gave': '{along} along, {across} across',
  'calibrate.photo.refused': 'Cannot be read',
  'calibrate.photo.apart': 'These do not belong together',
  'calibrate.photo.along': 'Slope along the bead',
  'calibrate.photo.across': 'Slope across the bead',
  'calibrate.photo.flow': 'Flow that closes the surface',
  'calibrate.photo.flow.lower': 'below the coupon’s: all discs are closed',
  'calibrate.photo.flow.higher': 'above the coupon’s: no disc is closed',
  'calibrate.photo.flow.unknown': 'cannot be told: move the lamp, and take another photograph',
  'calibrate.photo.width': 'Bead width ({asked} mm requested)',
  'calibrate.photo.lamp': 'lamp at {azimuth}°, {elevation} ± {error}° high',
  'calibrate.photo.bars': '± is one standard deviation.',
  'calibrate.photo.more': 'Add others, with the lamp on other sides: together they are more reliable.',
  'calibrate.photo.name': 'Name of the spool',
  'calibrate.photo.keep': 'Keep as a spool',
  'calibrate.photo.kept': '{name} is kept, and this plate uses it.',

  // Spools.
  'calibrate.spools.what':
    'Measured filaments, kept in this browser and in each project that uses one. Pictures are drawn and solved for their gloss.',
  'calibrate.spools.none': 'None yet. Measure one by a photograph of the coupon, or open a file of spools.',
  'calibrate.spools.use': 'Use {name}',
  'calibrate.spools.rename': 'Name of {name}',
  'calibrate.spools.delete': 'Delete {name}',
  'calibrate.spools.deleted': '{name} was deleted.',
  'calibrate.spools.slopes': '{along}° along, {across}° across',
  'calibrate.spools.import': 'Open a file…',
  'calibrate.spools.export': 'Save as a file',
  'calibrate.spools.imported': { one: '{n} spool is kept.', other: '{n} spools are kept.' },
  'calibrate.spools.unreadable': '{name} is not a spool file: {why}.',
  'calibrate.spools.give': 'To pass yours on to everybody, open an issue with this file and how you measured it.',
  'calibrate.spools.builtIn': 'Measured by the authors of the method',
  'calibrate.spools.yours': 'Your spools…',

  // First print.
  'calibrate.first.title': 'First print',
  'calibrate.first.what': 'For anyone with a printer and glossy filament: three choices, then print.',
  'calibrate.first.machine': 'Which printer?',
  'calibrate.first.machineHelp':
    'Yours is not there? Choose a file that your slicer made for it: its start code is known to work.',
  'calibrate.first.print': 'What to print first?',
  'calibrate.first.coupon': 'Coupon',
  'calibrate.first.couponHelp': 'Shows how well printer and filament do',
  'calibrate.first.coaster': 'Coaster',
  'calibrate.first.coasterHelp': 'A disc of 80 mm that shimmers',
  'calibrate.first.download': 'Download G-code',
  'calibrate.first.after': 'What to look at afterwards',
  'calibrate.first.after1': 'Watch the first layer: its lines must lie side by side and stick.',
  'calibrate.first.after2': 'Turn the print under a low lamp, in a dark room: bands of light must move over it.',
  'calibrate.first.after3': 'Dark gaps: more flow. Rough ridges: less. Dull: slower or hotter. “Calibrate” finds each.',
} as const;
