// Sentences that explain the measures to somebody who is about to print.

export const words = {
  'verdict.coverage.good': '{percent}% of the shape is covered by beads.',
  'verdict.coverage.fair': '{percent}% of the shape is covered; small gaps may show the layer below.',
  'verdict.coverage.poor':
    'Only {percent}% of the shape is covered. A smaller “Line width” or a larger “Widest bead” would close the gaps.',
  'verdict.order.good':
    'Beads follow their neighbours soon: {percent}% are laid over two minutes apart. A slicer’s plain top has {usual}%.',
  'verdict.order.fair':
    '{percent}% of the beads are laid over two minutes after or before a neighbour, and may shine differently. A slicer’s plain top has {usual}%.',
  'verdict.squeezed.good':
    'Nearly all beads lean on the one that was there before them; {percent}% are squeezed between two earlier ones.',
  'verdict.squeezed.fair':
    '{percent}% of the beads are squeezed between two earlier ones. There the side changes to which beads lean, and with it the shine; “Colour by: Leaning side” shows where.',
  'verdict.overlap.good': 'Beads hardly overlap: {percent}% of the shape.',
  'verdict.overlap.fair': 'Beads overlap on {percent}% of the shape; the surface may be rough there.',
  'verdict.overlap.poor': 'Beads overlap on {percent}% of the shape. Smoother directions would help.',
  'verdict.alignment.good': 'Beads follow the directions: {percent}% on a scale where 0 is random and 100 is perfect.',
  'verdict.alignment.fair':
    'Beads mostly follow the directions ({percent}%). They cannot where directions change within a few beads.',
  'verdict.alignment.poor':
    'Beads often do not follow the directions ({percent}%). Larger features, smoother directions or a smaller “Line width” would help.',
  'verdict.alignment.free': 'No directions were requested, so there is nothing to compare with.',
  'verdict.uTurns.good': { one: '{n} U-turn, {density} per cm².', other: '{n} U-turns, {density} per cm².' },
  'verdict.uTurns.fair': {
    one: '{n} U-turn, {density} per cm². It is visible as a dot; these directions need about {bound}.',
    other: '{n} U-turns, {density} per cm². They are visible as dots; these directions need about {bound}.',
  },
  'verdict.uTurns.poor': {
    one: '{n} U-turn, {density} per cm². These directions need about {bound}; smoother ones need fewer.',
    other: '{n} U-turns, {density} per cm². These directions need about {bound}; smoother ones need fewer.',
  },
  'verdict.uTurns.needed': {
    one: '{n} U-turn, {density} per cm². No more than these directions need (about {bound}); smoother ones need fewer.',
    other:
      '{n} U-turns, {density} per cm². No more than these directions need (about {bound}); smoother ones need fewer.',
  },
  'verdict.kinks.good': { one: '{n} sharp corner.', other: '{n} sharp corners.' },
  'verdict.kinks.fair': {
    one: '{n} sharp corner; the printer slows down there. Fine, under “Quality”, removes most.',
    other: '{n} sharp corners; the printer slows down there. Fine, under “Quality”, removes most.',
  },
  'verdict.widths.good': 'Beads are {low} to {high} mm wide, typically {median} mm.',
  'verdict.widths.fair':
    'Beads are {low} to {high} mm wide; {percent}% of the path is wider or narrower than allowed and is held at the limit.',
  'verdict.widths.poor':
    'Beads are {low} to {high} mm wide; {percent}% of the path is at the limit of what can be printed. Another “Line width” would help.',
  'verdict.fill.good': 'The plastic fills {percent}% of the space: just right.',
  'verdict.fill.fair': 'The plastic fills {percent}% of the space; 97 to 105% print well.',
  'verdict.lost.good': 'No part of the shape is too narrow for a bead.',
  'verdict.lost.fair': '{area} mm² of the shape are narrower than a bead and stay empty.',
  'verdict.lost.poor':
    '{area} mm² of the shape, {percent}%, are narrower than a bead and stay empty. A smaller “Line width” or a larger plate would keep them.',
  'verdict.picture.good': 'The plate shows the picture: likeness {percent}%, contrast {contrast} : 1.',
  'verdict.picture.fair':
    'The picture can be recognised: likeness {percent}%, contrast {contrast} : 1. A larger plate shows more.',
  'verdict.picture.poor':
    'The picture is hard to recognise: likeness {percent}%, contrast {contrast} : 1. Try a larger plate, a shinier spool or a smaller lamp.',
  'verdict.path.one': 'One closed path of {length} m: the nozzle never lifts.',
  'verdict.path.many': {
    one: '{n} closed path, {length} m in all.',
    other: '{n} closed paths, one per part, {length} m in all.',
  },
  'verdict.path.apart':
    '{n} closed paths, {length} m in all. {apart} of them lie apart: what joins them to their part is too thin for a bead.',
  'verdict.crossings.poor': {
    one: 'The path crosses itself {n} time. Please report this plate.',
    other: 'The path crosses itself {n} times. Please report this plate.',
  },
} as const;
