// Made by ./dev generate from core/data/fonts/fonts.json.
/** The fonts that come with the engine, in the order in which they are offered. */
export const builtInFonts = ['Nunito', 'Bebas Neue', 'Roboto Slab', 'Fredoka', 'Caveat'] as const;
