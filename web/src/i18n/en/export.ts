// Downloads.

export const words = {
  'export.gcode.help': 'For the printer.',
  'export.body.help': 'The bottom layers as a solid, to print elsewhere.',
  'export.zones.help': 'A body whose zones your slicer fills with straight lines: no G-code of ours.',
  'export.body.none': 'This plate has no bottom layers.',
  'export.svg.help': 'The beads as vector strokes.',
  'export.png.help': 'The appearance under the current light.',
  'export.loop.help': 'The light moves; small enough for messengers.',
  'export.view.help': 'A small file that <sillon-view> shows under moving light.',
  'export.project.help': 'Opens here and with the command line.',
  'export.link.help': 'Opens this page with the same settings.',
  'export.untried':
    'We have not tried any file of Sillon on a printer yet: stay beside yours. The first print that helps most is the coupon.',
  'export.untriedOn':
    'We have not tried any file of Sillon on the {printer} yet: stay beside yours. The first print that helps most is the coupon.',
} as const;
