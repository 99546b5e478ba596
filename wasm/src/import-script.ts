// Compiled with its comments (tsconfig.worker.json): by them bundlers leave alone an address that they cannot know.
export const importScript = (url: string): Promise<unknown> => import(/* @vite-ignore */ /* webpackIgnore: true */ url);
