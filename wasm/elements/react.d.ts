// Types of the elements in React's JSX, from React 19 on: import type {} from 'sillon/elements/react'
import type { DetailedHTMLProps, HTMLAttributes } from 'react';
import type {
  SillonStudioElement,
  SillonViewElement,
  StudioAttributes,
  StudioEventMap,
  ViewAttributes,
  ViewEventMap,
} from './index.js';

export * from './index.js';

type Handlers<Events> = { [Name in keyof Events & string as `on${Name}`]?: (event: Events[Name]) => void };
type Props<Element, Attributes, Events> = DetailedHTMLProps<HTMLAttributes<Element>, Element> &
  Partial<Attributes> &
  Handlers<Events>;

declare module 'react' {
  namespace JSX {
    interface IntrinsicElements {
      'sillon-studio': Props<SillonStudioElement, StudioAttributes, StudioEventMap>;
      'sillon-view': Props<SillonViewElement, ViewAttributes, ViewEventMap>;
    }
  }
}
