// Doubts that the plate shows what it was made from.

export const words = {
  'scan.reads':
    'As computed, a phone reads this code with the light at {where}, counter-clockwise from the right, or from the opposite side.',
  'scan.none':
    'As computed, no phone reads this code, wherever the light is. Make the plate larger, the text shorter, or the two directions more different; a round shape leaves less room than a square.',
  'scan.empty': 'The code is empty. Enter a text or an address.',
  'doubt.blank': 'There are no letters to show. Write some under Directions.',
  'doubt.small':
    'The letters are {height} mm high and cannot be seen: with this bead spacing they need about {need} mm. Break the text into more lines, or make the letters or the plate larger.',
  'doubt.letters':
    'These letters can hardly be read: they are too fine for their beads. Make the plate or the letters larger, the text shorter, or the bead spacing finer.',
  'doubt.fine':
    'The plate hardly shows what it is made from: that has finer details than its beads. Make it larger, the bead spacing finer, or take a simpler picture.',
  'doubt.faint':
    'Dark and bright places hardly differ on this plate. Set the directions nearer to 90° apart, or take a glossier filament.',
} as const;
