/** Registers an element once, however many scripts bring it; its attributes are properties of the same names, too. */
export function define(tag: string, element: CustomElementConstructor, attributes: readonly string[]): void {
  if (customElements.get(tag) !== undefined) return;
  for (const name of attributes) {
    Object.defineProperty(element.prototype, name, {
      configurable: true,
      enumerable: true,
      get(this: HTMLElement) {
        return this.getAttribute(name) ?? '';
      },
      set(this: HTMLElement, value: string | null) {
        if (value === null) this.removeAttribute(name);
        else this.setAttribute(name, value);
      },
    });
  }
  customElements.define(tag, element);
}
