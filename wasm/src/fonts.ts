// The fonts that come with the engine, as core/include/sillon/text/text.hpp lists them.
export const builtinFonts: readonly string[] = ['Nunito', 'Bebas Neue', 'Roboto Slab', 'Fredoka', 'Caveat'];

/** The name of a built-in font's file in dist/engine; undefined: it is none of them. */
export const fontFile = (font: string): string | undefined =>
  builtinFonts.includes(font) ? `${font.toLowerCase().replace(' ', '-')}.ttf` : undefined;
