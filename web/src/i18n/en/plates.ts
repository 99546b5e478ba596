// Your plates: the list of those that this browser keeps, and plates that are open elsewhere.

export const words = {
  'plates.title': 'Your plates',
  'plates.what': 'Kept in this browser, on this device. Also save what matters to you as a project file.',
  'plates.none': 'No plates here yet. A plate is saved here as soon as you change it.',
  'plates.untitled': 'Untitled',
  'plates.size': '{width} × {height} mm',
  'plates.open': 'Open {name}',
  'plates.name': 'Name of {name}',
  'plates.here': 'Open here',
  'plates.elsewhere': 'Open in another tab',
  'plates.foreign': 'Of another version',
  'plates.foreignHelp':
    '{name} was kept by another version of this page, or is damaged. It cannot be opened here, and stays as it is until you delete it.',
  'plates.foreignLeft':
    'Your last plate was kept by another version of this page and cannot be opened here. It stays among your plates.',
  'plates.download': 'Download {name}',
  'plates.duplicate': 'Duplicate {name}',
  'plates.copyOf': '{name}, copy',
  'plates.delete': 'Delete {name}',
  'plates.deleted': '{name} was deleted.',
  'plates.new': 'New plate',
  'plates.asked': '{name} is open in another tab.',
  'plates.take': 'Continue here',
  'plates.takeHelp': 'The other tab continues with a copy.',
  'plates.copy': 'Open a copy',
  'plates.left': 'Your last plate is open in another tab; this tab starts with another one.',
  'plates.unshown':
    'Your last plate was not shown before the page was closed. It is kept, but not opened, in case it stopped the page.',
  'plates.openAnyway': 'Open it anyway',
  'plates.copied': 'This plate is open in another tab, too. You continue here with a copy.',
  'plates.taken': 'Another tab continues with this plate. You continue here with a copy.',
  'plates.gone': 'That plate is no longer there.',
  'plates.savedTo': 'Saved to {name}.',
} as const;
