// Other words by which people look for actions, in any order; they are searched, never shown.

export const words = {
  'also.open': 'file image photo photograph picture logo drawing svg png jpeg upload import load',
  'also.undo': 'back step',
  'also.share': 'link url send address copy',
  'also.rebrush':
    'brush rebrush top surface face sliced slicer bambu ironing cura prusaslicer orcaslicer stl 3mf gcode',
  'also.first': 'test try begin start tutorial',
  'also.calibrate': 'flow speed pressure advance test coupon tuning swatch spool',
  'also.gcode': 'g-code print printer file save export sd card ender',
  'also.zones': 'slicer bambu prusaslicer orcaslicer ams 3mf stl modifier infill direction',
  'also.svg': 'vector laser plotter dxf',
  'also.loop': 'video film gif animation send share messenger',
  'also.project': 'save file backup zip',
  'also.layers': 'picture photo pattern layers layer text code',
  'also.shape':
    'hole holes size diameter width height inch mm outline round square ring heart thickness proportions radius offset',
  'also.print':
    'printer nozzle temperature bed heat thickness height base bottom filament pla petg spool weight time bambu toolpath path line width walls quality preset bridge',
  'also.quality': 'quality problems errors verdict width gaps u-turns places',
  'also.light': 'lamp sun shine azimuth',
  'also.text': 'name letters font word caption writing sign',
  'also.code': 'qr url wifi link barcode scan',
  'also.drawing': 'logo svg icon vector dxf outline',
  'also.picture': 'photograph image portrait lithophane lamp under a lamp',
  'also.brightness': 'picture by brightness tones grey photo',
  'also.edges': 'picture along edges contours',
  'also.levels': 'logo two directions black white threshold icon',
  'also.colours': 'a direction per colour flat colors',
  'also.flow': 'flow directions',
  'also.beads': 'beads toolpath gcode',
  'also.look': 'appearance shimmer shine render',
  'also.spacing': 'bead spacing distance extrusion width',
  'also.outline': 'border mode perimeter',
  'also.walls': 'perimeters loops shells',
  'also.top': 'oriented layers shimmer',
  'also.bottom': 'base layers infill floor',
} as const;
