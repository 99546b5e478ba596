// The project's other places, in the menu and where something went wrong.

export const words = {
  'about.documentation': 'Documentation',
  'about.source': 'Source',
  'about.report': 'Report a problem',
  'about.licences': 'Licences',
  'about.version': 'Version {version}',
} as const;
