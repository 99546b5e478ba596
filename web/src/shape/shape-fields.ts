// Makes the fields for changes of a shape: its corners, an offset and holes.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import type { RoundHole } from 'sillon';
import { a } from '../i18n/shaping.js';
import { builtInFonts } from '../model/fonts.js';
import { pageOf, type ShapeSource } from '../model/plate.js';
import { shapeTable } from '../model/setting-table.js';
import { usualHoles, withHole, type HoleName } from '../model/shapes.js';
import { StudioElement } from '../controls/element.js';
import { numberField, numberInput, segments, select, textField, type NumberField } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import { panelStyle } from '../controls/panel-style.js';
import { lengthField } from './size-fields.js';
import { button } from '../controls/button.js';

const widest = 1000; // [mm], largest plate in these fields
const leastHole = 0.5; // [mm], the engine's own limit

/** Shapes with adjustable corners. */
const cornered: readonly ShapeSource['kind'][] = ['rounded', 'hexagon', 'shield', 'star', 'tag'];

@customElement('sillon-shape-fields')
export class ShapeFields extends StudioElement {
  static override reads = ['plate', 'units'] as const;

  static override styles = [
    panelStyle,
    css`
      .bare {
        padding: 0;
      }
      ul {
        display: grid;
        gap: 8px;
        margin: 8px 0;
      }
      li {
        display: grid;
        grid-template-columns: 1fr 1fr 1fr auto;
        align-items: end;
        gap: 6px;
      }
      li .measure {
        width: 100%;
        min-width: 0;
      }
      .error {
        grid-column: 1 / -1;
      }
    `,
  ];

  override render(): TemplateResult {
    const { shape } = this.state.plate;
    return html`${shape.kind === 'text' ? this.#letters(shape) : nothing}
    ${cornered.includes(shape.kind) ? this.#corners(shape) : nothing}
    ${
      shape.kind === 'star'
        ? numberField(this.#field('points', a('points'), { step: 1, usual: [3, 12], integer: true }))
        : nothing
    }
    ${
      shape.kind === 'ring' || shape.kind === 'tag'
        ? numberField(
            this.#length('inner', a('inner'), {
              max: widest,
              usual: [0, Math.min(this.state.plate.width, this.state.plate.height)],
              help: a(`inner.${shape.kind}.help`),
            }),
          )
        : nothing
    }
    ${numberField(this.#length('offset', a('offset'), { usual: [-5, 10], help: a('offset.help') }))}
    ${this.#holes(shape)}`;
  }

  #letters({ text, font }: ShapeSource): TemplateResult {
    return html`${textField({
      id: 'shape-text',
      label: a('text'),
      value: text,
      maxLength: 200,
      long: true,
      onInput: (value) => this.#change({ text: value }, 'shape.text'),
      onSettle: () => this.studio.settle(),
    })}
    ${select<string>({
      id: 'shape-font',
      label: a('font'),
      value: font,
      options: builtInFonts.map((name) => ({ value: name, label: name })),
      onChoose: (name) => this.#change({ font: name }),
    })}`;
  }

  #corners(shape: ShapeSource): TemplateResult {
    const { width, height } = this.state.plate;
    const most = Math.max(1, Math.floor(Math.min(width, height) / 2));
    return html`${numberField(this.#length('radius', a('radius'), { max: widest / 2, usual: [0, most] }))}
    ${segments({
      id: 'corners',
      label: a('corners'),
      value: shape.corners,
      options: shapeTable.corners.choices.map((value) => ({ value, label: a(`corners.${value}`) })),
      onChoose: (corners) => this.#change({ corners }),
    })}`;
  }

  #change(changed: Partial<ShapeSource>, gesture?: string): void {
    this.studio.change((plate) => ({ ...plate, shape: { ...plate.shape, ...changed } as ShapeSource }), gesture);
  }

  /** A field with the core's own range. */
  #field(key: 'radius' | 'points' | 'inner' | 'offset', label: string, more: Partial<NumberField>): NumberField {
    const { low, high } = shapeTable[key];
    return {
      id: key,
      label,
      value: this.state.plate.shape[key],
      min: low,
      max: high,
      step: 0.5,
      ...more,
      onInput: (value) => this.#change({ [key]: value }, key),
      onSettle: () => this.studio.settle(),
    };
  }

  #length(key: 'radius' | 'inner' | 'offset', label: string, more: Partial<NumberField>): NumberField {
    return lengthField(this.#field(key, label, more), this.state.units);
  }

  #holes({ holes }: ShapeSource): TemplateResult {
    const full = holes.length >= shapeTable.holes.most;
    return html`<section class="bare" aria-labelledby="holes-title">
      <h3 id="holes-title">${a('holes')}</h3>
      ${
        holes.length === 0
          ? nothing
          : html`<p class="note">${a('holes.help')}</p>
              <ul>
                ${holes.map((hole, k) => this.#hole(hole, k))}
              </ul>`
      }
      <div class="buttons">
        ${(Object.keys(usualHoles) as HoleName[]).map((name) =>
          button({ disabled: full }, html`${icon('plus', 16)} ${a(`hole.${name}`, { d: usualHoles[name] })}`, () =>
            this.studio.change((plate) => withHole(plate, name)),
          ),
        )}
      </div>
    </section>`;
  }

  #hole(hole: RoundHole, k: number): TemplateResult {
    const [width, height] = pageOf(this.state.plate);
    const ranges = { x: [0, width], y: [0, height], diameter: [leastHole, widest] } as const;
    const field = (key: keyof RoundHole): TemplateResult => {
      const [min, max] = ranges[key];
      const one = lengthField(
        {
          id: `hole-${k}-${key}`,
          label: a(`hole.${key}`),
          value: Math.round(hole[key] * 100) / 100,
          min,
          max,
          step: 0.1,
          onInput: (value) => this.#setHole(k, { [key]: value }),
          onSettle: () => this.studio.settle(),
        },
        this.state.units,
      );
      return html`<div class="field stacked">
        <label for=${one.id}>${one.label}</label>${numberInput(one)}
        <p class="error" id="${one.id}-error" role="status" hidden></p>
      </div>`;
    };
    return html`<li>
      ${field('x')} ${field('y')} ${field('diameter')}
      ${button({ look: 'square', name: a('hole.remove', { n: k + 1 }) }, icon('close', 16), () =>
        this.#change({ holes: this.state.plate.shape.holes.filter((_, other) => other !== k) }),
      )}
    </li>`;
  }

  #setHole(k: number, changed: Partial<RoundHole>): void {
    const { holes } = this.state.plate.shape;
    this.#change({ holes: holes.map((hole, other) => (other === k ? { ...hole, ...changed } : hole)) }, `hole ${k}`);
  }
}
