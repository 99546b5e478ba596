// A card that goes with a print: its facts, and the place of each lamp. Printing the page prints the card.
import { css, html, nothing, svg, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { words } from '../i18n/en/export.js';
import { machineName } from '../i18n/say.js';
import { say, t } from '../i18n/text.js';
import { hourOf, lampSizes, standingLamps, type Standing } from '../model/lamp.js';
import { pageOf } from '../model/plate.js';
import { isOf } from '../model/result.js';
import type { PlateResult } from '../model/state.js';
import { thicknessOf } from '../model/thickness.js';
import type { Light } from '../model/view.js';
import { DialogElement } from '../controls/dialog.js';
import { icon } from '../controls/icons.js';
import { miniature } from '../views/miniature.js';
import { smallLook } from '../views/plate-look.js';
import { filamentName } from '../print/filament-name.js';
import { button } from '../controls/button.js';

const pictureSide = 640; // [pixels] for 50 mm on paper
const away = 60; // [cm] from the plate to the lamp
const straightUp = 85; // [degrees] elevation from which a lamp counts as straight above

/** Describes a lamp's place, also by a clock's hour and by lengths [cm], so that nobody needs a protractor. */
function lampText({ azimuth, elevation }: Light): string {
  if (elevation >= straightUp) return say(words, 'card.above');
  const angle = (elevation * Math.PI) / 180;
  return say(words, 'card.lamp', {
    hour: hourOf(azimuth),
    turn: Math.round(450 - azimuth) % 360,
    elevation: Math.round(elevation),
    across: Math.round(away * Math.cos(angle)),
    up: Math.round(away * Math.sin(angle)),
  });
}

/** Draws a lamp's place from above, with a clock's face around the plate, and from the side, with its elevation. */
function drawing({ azimuth, elevation }: Light): TemplateResult {
  const [a, e] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
  const at = (angle: number, far: number): [number, number] => [far * Math.cos(angle), -far * Math.sin(angle)];
  const [x, y] = at(a, 52);
  const [sx, sy] = at(e, 62);
  const hours = Array.from({ length: 12 }, (_, k) => k + 1);
  const lamp = (cx: number, cy: number): TemplateResult => svg`<circle class="lamp" cx=${cx} cy=${cy} r="6" />`;
  return html`<svg viewBox="-62 -62 232 124" role="img" aria-label=${say(words, 'card.drawing')}>
    <circle class="line" r="42" />
    <rect class="plate" x="-14" y="-14" width="28" height="28" />
    ${hours.map((hour) => {
      const [hx, hy] = at((Math.PI * (3 - hour)) / 6, 33);
      return svg`<text x=${hx} y=${hy}>${hour}</text>`;
    })}
    <line class="ray" x1="0" y1="0" x2=${x} y2=${y} />
    ${lamp(x, y)}
    <g transform="translate(88 30)">
      <line class="line" x1="-8" y1="0" x2="76" y2="0" />
      <rect class="plate" x="-8" y="-4" width="16" height="4" />
      <path class="line" d="M26 0A26 26 0 0 0 ${at(e, 26).join(' ')}" />
      <line class="ray" x1="0" y1="0" x2=${sx} y2=${sy} />
      ${lamp(sx, sy)}
      <text x=${at(e / 2, 38)[0]} y=${at(e / 2, 38)[1]}>${Math.round(elevation)}°</text>
    </g>
  </svg>`;
}

@customElement('sillon-lamp-card')
export class LampCard extends DialogElement {
  static override reads = ['plate', 'result'] as const;

  static override styles = css`
    h3 {
      color: var(--ink);
      font-size: var(--title);
      letter-spacing: normal;
      text-transform: none;
    }
    .facts {
      display: grid;
      gap: 2px;
    }
    .lamps {
      display: grid;
      gap: 14px;
    }
    .lamps > li {
      display: grid;
      grid-template-columns: minmax(0, 9rem) minmax(0, 1fr);
      gap: 6px 18px;
      align-items: center;
      padding-top: 14px;
      border-top: 1px solid var(--line);
      break-inside: avoid;
    }
    .lamps p {
      grid-column: 1 / -1;
    }
    img {
      width: 100%;
      aspect-ratio: 1;
      object-fit: contain;
    }
    .lamps svg {
      width: 100%;
      max-height: 11rem;
    }
    .line {
      fill: none;
      stroke: var(--edge);
    }
    .plate {
      fill: var(--soft);
    }
    .ray {
      stroke: var(--ink);
      stroke-dasharray: 3 3;
    }
    .lamp {
      fill: #f5b400;
      stroke: var(--ink);
    }
    .lamps text {
      fill: var(--ink);
      font-size: 10px;
      text-anchor: middle;
      dominant-baseline: central;
    }
    .take {
      justify-self: start;
    }
    @media (max-width: 560px) {
      .lamps > li {
        grid-template-columns: minmax(0, 1fr);
        justify-items: center;
      }
      img {
        width: 9rem;
      }
    }
    @media print {
      dialog {
        --surface: #fff;
        --ink: #000;
        --soft: #333;
        --line: #999;
        --edge: #666;
        position: absolute;
        inset: 0 0 auto;
        width: auto;
        max-width: none;
        max-height: none;
        margin: 0;
        border: 0;
        border-radius: 0;
        box-shadow: none;
        overflow: visible;
        print-color-adjust: exact;
      }
      dialog::backdrop,
      dialog sillon-notices,
      button {
        display: none !important;
      }
      dialog > .body {
        overflow: visible;
      }
      .lamps > li {
        grid-template-columns: 50mm minmax(0, 1fr);
      }
    }
  `;

  protected override heading = (): string => say(words, 'card.title');

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#forget();
  }

  #drawn: { of: PlateResult; urls: readonly string[] } | undefined;
  #asked: PlateResult | undefined;

  #forget(): void {
    for (const url of this.#drawn?.urls ?? []) URL.revokeObjectURL(url);
    this.#drawn = undefined;
  }

  /** Draws the plate under each lamp. @returns addresses of the pictures; empty until they are drawn */
  #pictures(result: PlateResult | undefined, lamps: readonly Standing[]): readonly string[] {
    if (result === undefined) return [];
    if (this.#drawn?.of === result) return this.#drawn.urls;
    if (this.#asked === result) return [];
    this.#asked = result;
    const { toolpath, plate } = result;
    void this.studio.attempt(async () => {
      const blobs = await Promise.all(
        lamps.map(({ light }) => miniature(toolpath, smallLook(plate, light), pictureSide)),
      );
      if (this.#asked !== result || !this.isConnected) return;
      this.#forget();
      this.#drawn = { of: result, urls: blobs.map((blob) => URL.createObjectURL(blob)) };
      this.requestUpdate();
    });
    return [];
  }

  protected override body(): TemplateResult {
    const { plate, result } = this.state;
    const made = result !== undefined && !result.coarse && isOf(result, plate) ? result : undefined;
    const lamps = standingLamps(plate, made?.toolpath.look);
    const urls = this.#pictures(made, lamps);
    const [width, height] = pageOf(plate);
    const size = { width, height, thickness: thicknessOf(plate) };
    const machine = [machineName(plate.printer), filamentName(plate)].filter((word) => word !== '').join(' · ');
    const solved = lamps.some(({ files }) => files.length > 0);
    return html`<h3>${plate.name || t('app.untitled')}</h3>
      <ul class="facts">
        <li>${say(words, 'card.size', size)}</li>
        <li>${machine}</li>
        ${solved ? this.#kind() : nothing}
      </ul>
      <p>${say(words, 'card.stand')} ${say(words, solved ? 'card.alone' : 'card.any')}</p>
      <ul class="lamps">
        ${lamps.map(({ light, files }, k) => {
          const url = urls[k];
          const names = files.map(({ name }) => name).join(', ');
          return html`<li>
            ${url === undefined ? html`<span></span>` : html`<img src=${url} alt=${names} />`} ${drawing(light)}
            <p>${names === '' ? nothing : html`<b>${names}</b><br />`}${lampText(light)}</p>
          </li>`;
        })}
      </ul>
      ${button('main take', html`${icon('print')} ${say(words, 'card.print')}`, () => print())}`;
  }

  /** Returns the kind of lamp, if its size is one of those with a name. */
  #kind(): TemplateResult | typeof nothing {
    const { lampSize } = this.state.plate.pictures;
    const names = Object.keys(lampSizes) as (keyof typeof lampSizes)[];
    const name = names.find((one) => lampSizes[one] === lampSize);
    return name === undefined ? nothing : html`<li>${t('lamp.size')}: ${t(`lamp.size.${name}`)}</li>`;
  }
}
