// Types of the elements in Vue's templates, from Vue 3.3 on: import type {} from 'sillon/elements/vue'
import type { HTMLAttributes } from 'vue';
import type { StudioAttributes, StudioEventMap, ViewAttributes, ViewEventMap } from './index.js';

export * from './index.js';

type Handlers<Events> = { [Name in keyof Events & string as `on${Capitalize<Name>}`]?: (event: Events[Name]) => void };
type Tag<Attributes, Events> = new () => {
  $props: Omit<HTMLAttributes, keyof Handlers<Events> | keyof Attributes> & Partial<Attributes> & Handlers<Events>;
};

declare module 'vue' {
  interface GlobalComponents {
    'sillon-studio': Tag<StudioAttributes, StudioEventMap>;
    'sillon-view': Tag<ViewAttributes, ViewEventMap>;
  }
}
