// Words about doubts whether the plate will show its picture.

export const words = {
  'scan.reads':
    'As computed, a phone reads this code with the light at {where}, counter-clockwise from the right, or from the opposite side.',
  'scan.none':
    'As computed, no phone reads this code, wherever the light is. Make the code larger, the text shorter, or the two directions more different.',
  'doubt.fine':
    'The plate hardly shows what it is made from: that has finer details than its beads. Make the plate larger, “Line width” smaller, or take a simpler picture.',
  'doubt.faint':
    'Dark and bright places hardly differ on this plate. Set the directions nearer to 90° apart, or take a glossier filament.',
} as const;
