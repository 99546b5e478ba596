// Words about downloads.

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
  'card.title': 'Where the lamp must stand',
  'card.print': 'Print this card',
  'card.size': '{width} × {height} mm, {thickness} mm thick',
  'card.stand': 'Lay the plate as in the picture, and look at it from straight above. Its upper edge is 12 o’clock.',
  'card.lamp':
    'The lamp stands at {hour} o’clock (exactly {turn}° clockwise from 12), {elevation}° above the plate: for example {across} cm to that side and {up} cm up.',
  'card.above': 'The lamp hangs straight above the plate.',
  'card.any': 'It shimmers under every lamp that moves, and looks best under this one.',
  'card.alone': 'Put out other lights, or turn the plate away from them.',
  'card.drawing': 'The lamp from above, and from the side',
} as const;
