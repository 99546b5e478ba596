/** The languages of the page's words, by the names that their speakers give them. */
export const languages = { en: 'English', fr: 'Français' } as const;
export type Language = keyof typeof languages;
