// Makes the fields that control how a drawing is read. They are loaded when the plate has one.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { d } from '../i18n/drawing.js';
import { usualPaint } from '../model/defaults.js';
import type { ShapeSource } from '../model/plate.js';
import { StudioElement } from '../controls/element.js';
import { flag, select } from '../controls/fields.js';
import { panelStyle } from '../controls/panel-style.js';

type Drawing = Extract<ShapeSource, { kind: 'file' }>;

@customElement('sillon-drawing-fields')
export class DrawingFields extends StudioElement {
  static override reads = ['plate'] as const;

  static override styles = [panelStyle, css``];

  override render(): TemplateResult | typeof nothing {
    const { shape } = this.state.plate;
    if (shape.kind !== 'file') return nothing;
    const change = (changed: Partial<Drawing>): void =>
      this.studio.change((plate) => ({ ...plate, shape: { ...shape, ...changed } }));
    return html`${/\.svg$/i.test(shape.file.name) ? this.#ofVectors(shape, change) : nothing}
    ${flag({
      id: 'keep-thin',
      label: d('keepThin'),
      help: d('keepThin.help'),
      value: shape.keepThin,
      onChange: (keepThin) => change({ keepThin }),
    })}`;
  }

  #ofVectors(shape: Drawing, change: (changed: Partial<Drawing>) => void): TemplateResult {
    return html`${select({
      id: 'paint',
      label: d('paint'),
      help: d('paint.help'),
      value: shape.paint,
      options: [
        { value: 'shown', label: d('paint.shown') },
        { value: 'ignore', label: d('paint.ignore') },
      ],
      onChoose: (paint) => change({ paint }),
    })}
    ${select({
      id: 'unitless',
      label: d('unitless'),
      value: shape.unitless,
      options: [
        { value: 'px', label: d('unitless.px') },
        { value: 'mm', label: d('unitless.mm') },
      ],
      onChoose: (unitless) =>
        change({ unitless, ...(shape.paint === usualPaint(shape.unitless) && { paint: usualPaint(unitless) }) }),
    })}`;
  }
}
