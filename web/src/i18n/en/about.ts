// Words for links to the project's other pages, in the menu and where an error is shown.

export const words = {
  'about.documentation': 'Documentation',
  'about.source': 'Source',
  'about.report': 'Report a problem',
  'about.licences': 'Licences',
  'about.version': 'Version {version}',
  'app.local': 'Everything happens on this device. Nothing is uploaded.',
  'app.host': 'Embedded in {host}, which can read this plate and the files you open here. Nothing else is uploaded.',
  'app.open': 'Open in a new tab',
  'offline.keep': 'Keep for offline use',
  'offline.ready': 'All of Sillon is kept on this device and works offline.',
  'offline.update': 'A new version is ready.',
} as const;
