// Draws pictures for the cards of a panel, again whenever the plate has changed and rests.
import type { ReactiveController, ReactiveControllerHost } from 'lit';
import type { Plate } from '../model/plate.js';
import type { Draw } from '../studio/services.js';
import type { StudioElement } from './element.js';

const restsAfter = 250; // [ms]

export class DrawnChoices<Name extends string> implements ReactiveController {
  #plate: Plate | undefined;
  #urls = new Map<Name, string>();
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** Adds itself to the host. @param draw  returns the drawing function, which is loaded on first use */
  constructor(
    private readonly host: ReactiveControllerHost & StudioElement,
    private readonly draw: () => Draw<Name>,
  ) {
    host.addController(this);
  }

  /** Returns the address of a picture; undefined: there is none yet. */
  url(name: Name): string | undefined {
    return this.#urls.get(name);
  }

  hostUpdated(): void {
    const { plate, live } = this.host.state;
    if (!this.host.isConnected || this.#same(plate)) return;
    this.#plate = plate;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#draw(plate), live ? 2 * restsAfter : restsAfter);
  }

  hostConnected(): void {
    this.host.requestUpdate(); // the host may have been in the page before
  }

  /** Frees the pictures. It requests no update, which would draw the whole host again. */
  hostDisconnected(): void {
    clearTimeout(this.#timer);
    this.#plate = undefined;
    this.#forget(this.#urls);
    this.#urls = new Map();
  }

  /** Tells whether the pictures still fit the plate. */
  #same(plate: Plate): boolean {
    const before = this.#plate;
    if (before === undefined) return false;
    const { layers, shape, width, height, pictures } = plate;
    return (
      before.layers[0] === layers[0] &&
      before.shape === shape &&
      before.width === width &&
      before.height === height &&
      before.pictures.spool === pictures.spool
    );
  }

  async #draw(plate: Plate): Promise<void> {
    const wanted = (): boolean => this.#plate === plate;
    try {
      const made = await this.draw()(plate, wanted);
      if (wanted()) this.#show(new Map([...made].map(([name, blob]) => [name, URL.createObjectURL(blob)])));
    } catch {
      // Icons stand in for the pictures.
    }
  }

  #show(urls: Map<Name, string>): void {
    const before = this.#urls;
    this.#urls = urls;
    this.host.requestUpdate();
    // The old addresses stay valid until the new pictures are on the screen.
    void this.host.updateComplete.then(() => this.#forget(before));
  }

  #forget(urls: ReadonlyMap<Name, string>): void {
    for (const url of urls.values()) URL.revokeObjectURL(url);
  }
}
