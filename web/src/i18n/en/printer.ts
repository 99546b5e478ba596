// The visitor's printer and filament, as they are chosen or read from a file.

export const words = {
  'printer.import': 'From your slicer’s file…',
  'printer.byFile': '{name}: from your slicer’s file',
  'printer.imported': { one: '{name}: {n} setting imported.', other: '{name}: {n} settings imported.' },
  'printer.heats': 'It prints {type} at {nozzle} °C on a bed of {bed} °C.',
  'printer.keeps': 'The filament stays: {type} at {nozzle} °C on a bed of {bed} °C.',
  'printer.heatsOther':
    'The file heats the nozzle to {nozzle} °C and the bed to {bed} °C, and does not say for which filament.',
  'printer.takeHeat': 'Take {nozzle} °C of the file',
  'printer.look': 'Have a look at this: {list}',
  'printer.ownNamed': '{name} (own settings)',
  'printer.ownStart': {
    one: 'Files begin with {n} line of start G-code of your own.',
    other: 'Files begin with {n} lines of start G-code of your own.',
  },
  'printer.start': 'The file homes, heats and primes in a plain way. Check it for your printer before the first print.',
  'filament.goldPla': 'Gold PLA',
  'filament.bluePla': 'Blue PLA',
  'filament.greyPla': 'Grey PLA',
  'filament.redPetg': 'Red PETG',
  'filament.clearPetg': 'Clear PETG',
  'filament.ofFile': '{type}, from your file',
  'filament.at': '{name} at {n} °C',
  'filament.help': 'Glossy filaments shimmer; matt ones do not. Gloss as measured on printed samples.',
  'summary.filament': 'Filament',
  'summary.height': 'Height',
  'summary.size': 'File size: {size}.',
  'summary.estimate': 'Times are estimates.',
  'summary.warnings': 'Before you print',
} as const;
