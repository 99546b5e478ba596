// Made by ./dev generate from core/data/fonts/fonts.json.
/** Files of the fonts that come with the engine, in dist/engine, by name. */
export const fontFiles: ReadonlyMap<string, string> = new Map([
  ['Nunito', 'nunito.ttf'],
  ['Bebas Neue', 'bebas-neue.ttf'],
  ['Roboto Slab', 'roboto-slab.ttf'],
  ['Fredoka', 'fredoka.ttf'],
  ['Caveat', 'caveat.ttf'],
]);
