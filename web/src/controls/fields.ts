// Controls as functions of plain data. They call `onInput` while the user drags or types, and `onSettle` at the end.
import { html, nothing, type TemplateResult } from 'lit';
import { Directive, directive, type ElementPart } from 'lit/directive.js';
import { live } from 'lit/directives/live.js';
import { language, t } from '../i18n/text.js';
import { icon, type IconName } from './icons.js';

/** Fields whose text is not applied yet: undo in them belongs to the browser, everywhere else to the plate. */
export const typing = new WeakSet<EventTarget>();
export const isTyping = (event: Event): boolean => typing.has(event.composedPath()[0] as EventTarget);

type Content = TemplateResult | typeof nothing;

/** Formats a number for editing in the page's language, without thousands separators. */
const inputText = (value: number): string =>
  new Intl.NumberFormat(language(), { maximumFractionDigits: 10, useGrouping: false }).format(value);

/** Reads a number with a comma or a point, in any language, and
 * with the field's unit, or cm in a field of mm; otherwise NaN. */
function numberIn(text: string, unit = ''): number {
  const [, number, given = ''] = /^\s*([-+−]?(?:\d+[.,]?\d*|[.,]\d+))\s*(.*?)\s*$/.exec(text) ?? [];
  const scale = given === '' || given === unit ? 1 : given === 'cm' && unit === 'mm' ? 10 : Number.NaN;
  return Number((scale * Number(number?.replace('−', '-').replace(',', '.'))).toFixed(10));
}

/** Directive that shows a value, but keeps text that is being typed unless the value changes elsewhere. */
class Shows extends Directive {
  #shown: number | string | undefined;

  override render(_value: number | string, _unit?: string): typeof nothing {
    return nothing;
  }

  override update({ element }: ElementPart, [value, unit]: [number | string, string?]): typeof nothing {
    const input = element as HTMLInputElement;
    const typing = input.matches(':focus') && value === this.#shown;
    const read = typeof value === 'number' ? numberIn(input.value, unit) : input.value;
    if (!typing && read !== value) input.value = typeof value === 'number' ? inputText(value) : value;
    this.#shown = value;
    return nothing;
  }
}
const shows = directive(Shows);

/** Returns a slider's share as a style. Styles are set as properties,
 * since a strict Content-Security-Policy forbids attributes. */
const share = (value: number): string => `--share: ${Math.min(1, Math.max(0, value))}`;

function toggleHelp(event: Event): void {
  const button = event.currentTarget as HTMLElement;
  const help = button.closest('.field')?.querySelector<HTMLElement>('.help');
  if (help === null || help === undefined) return;
  help.hidden = !help.hidden;
  button.setAttribute('aria-expanded', String(!help.hidden));
}

/** Returns the button that unfolds a field's help; nothing without help. */
export const aboutButton = (id: string, label: string, help: string): Content =>
  help === ''
    ? nothing
    : html`<button
        class="about"
        aria-label="${t('verb.help')}: ${label}"
        aria-expanded="false"
        aria-controls="${id}-help"
        @click=${toggleHelp}
      >
        ${icon('info', 14)}
      </button>`;

export const helpText = (id: string, help: string): Content =>
  help === '' ? nothing : html`<p class="help" id="${id}-help" hidden>${help}</p>`;

/** Properties of every field: the id of its input, a name, and help that unfolds. */
interface Field {
  id: string;
  label: string;
  help?: string;
}

/** Returns a field with its name above or beside its content. @param name  nothing: the content names itself */
const named = (
  { id, label, help = '' }: Field,
  content: unknown,
  name: Content = html`<label for=${id}>${label}</label>`,
): TemplateResult =>
  html`<div class="field">
    ${name === nothing ? nothing : html`<span class="name">${name}${aboutButton(id, label, help)}</span>`} ${content}
    ${helpText(id, help)}
  </div>`;

/** Returns the place for a sentence about wrong input. */
export const errorText = (id: string): TemplateResult =>
  html`<p class="error" id="${id}-error" role="status" hidden></p>`;

export interface NumberField extends Field {
  value: number;
  min: number;
  max: number;
  step: number;
  /** Range of the slider; undefined: there is none. */
  usual?: readonly [number, number] | undefined;
  unit?: string;
  integer?: boolean;
  disabled?: boolean;
  onInput: (value: number) => void;
  onSettle?: () => void;
}

const digitsOf = (step: number): number => Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));

/** Rounds a number to one digit more than its step shows. */
const shortNumber = (value: number, step: number): number => Number(value.toFixed(digitsOf(step) + 1));

/** Marks a field as right or wrong. @param error  sentence about the typed text; empty: it is right */
function judge(input: HTMLElement, error: string): void {
  input.setAttribute('aria-invalid', String(error !== ''));
  const place = input.closest('.field')?.querySelector<HTMLElement>('.error');
  if (place === null || place === undefined) return;
  place.hidden = error === '';
  place.textContent = error;
}

/** Reads a number field and marks it; undefined if the text is no valid number. */
function readNumber(field: NumberField, input: HTMLInputElement): number | undefined {
  const value = numberIn(input.value, field.unit);
  const right = value >= field.min && value <= field.max && (!field.integer || Number.isInteger(value));
  judge(
    input,
    right
      ? ''
      : Number.isNaN(value) || (field.integer && !Number.isInteger(value))
        ? t('setting.notANumber', { name: field.label, example: field.value })
        : t('setting.outOfRange', { name: field.label, min: field.min, max: field.max }),
  );
  return right ? value : undefined;
}

let pause: ReturnType<typeof setTimeout> | undefined;

/** Settles after a pause of 1 s: no event tells that typing has ended before the focus goes, and the focus may stay. */
function settleSoon({ onSettle }: { onSettle?: () => void }): void {
  clearTimeout(pause);
  pause = setTimeout(() => onSettle?.(), 1000);
}

/** Returns the number's input with its unit, without a name. */
export function numberInput(field: NumberField, name = true): TemplateResult {
  const { id, label, unit = '', min, max, step } = field;
  const onInput = (event: Event): void => {
    const input = event.currentTarget as HTMLInputElement;
    if (event.type === 'input') typing.add(input);
    const value = readNumber(field, input);
    if (value === undefined) return;
    field.onInput(value);
    settleSoon(field);
  };
  const onChange = (event: Event): void => {
    const input = event.currentTarget as HTMLInputElement;
    typing.delete(input);
    const value = readNumber(field, input);
    // Invalid text does not stay; the sentence about it does, until the next change.
    input.value = inputText(value ?? shortNumber(field.value, step));
    input.setAttribute('aria-invalid', 'false');
    clearTimeout(pause); // a late pause could end the next drag
    field.onSettle?.();
  };
  /** Steps with the arrow keys. Spin buttons of number inputs do the same, but cannot write decimal commas. */
  const onKey = (event: KeyboardEvent): void => {
    const by = event.key === 'ArrowUp' ? step : event.key === 'ArrowDown' ? -step : 0;
    if (by === 0) return;
    event.preventDefault();
    const input = event.currentTarget as HTMLInputElement;
    const next = Math.min(max, Math.max(min, (numberIn(input.value, unit) || 0) + by));
    input.value = inputText(Number(next.toFixed(digitsOf(step))));
    onInput(event);
  };
  return html`<span class="measure">
    <input
      type="text"
      role="spinbutton"
      autocomplete="off"
      inputmode=${min < 0 ? 'text' : 'decimal'}
      id=${id}
      aria-label=${name ? nothing : label}
      aria-describedby="${id}-error"
      aria-valuemin=${min}
      aria-valuemax=${max}
      aria-valuenow=${field.value}
      ?disabled=${field.disabled ?? false}
      ${shows(shortNumber(field.value, step), unit)}
      @keydown=${onKey}
      @input=${onInput}
      @change=${onChange}
    />
    <span class="unit" aria-hidden="true">${unit}</span>
  </span>`;
}

/** Returns a number's name, input and slider; dragging the name changes the number. */
export function numberField(field: NumberField): TemplateResult {
  const { id, label, value, step, usual } = field;
  const [low, high] = usual ?? [0, 1];
  const onDown = (event: PointerEvent): void => {
    const name = event.currentTarget as HTMLElement;
    if (event.button !== 0 || event.pointerType === 'touch' || field.disabled) return;
    void import('./scrub.js').then(({ scrub }) => scrub(event, name, field));
  };
  const slider = html`<input
    type="range"
    tabindex="-1"
    aria-hidden="true"
    min=${low}
    max=${high}
    step=${step}
    ?disabled=${field.disabled ?? false}
    .value=${live(String(value))}
    .style=${share((value - low) / (high - low))}
    @input=${(event: Event) => field.onInput(Number((event.currentTarget as HTMLInputElement).value))}
    @change=${field.onSettle}
  />`;
  return named(
    field,
    html`${numberInput(field)} ${usual === undefined ? nothing : slider} ${errorText(id)}`,
    html`<label for=${id} class="scrubs" @pointerdown=${onDown}>${label}</label>`,
  );
}

export interface Option<Value extends string = string> {
  value: Value;
  label: string;
  icon?: IconName | undefined;
  /** Address of a picture that takes the icon's place. */
  picture?: string | undefined;
  disabled?: boolean;
  title?: string;
}

export interface ChoiceField<Value extends string = string> extends Field {
  value: Value | undefined;
  options: readonly Option<Value>[];
  onChoose: (value: Value) => void;
}

/** Returns the radio buttons of a choice. */
function radios<Value extends string>(field: ChoiceField<Value>, size: number): TemplateResult[] {
  return field.options.map(
    ({ value, label, icon: name, picture, disabled = false, title = '' }) =>
      html`<label title=${title || nothing}>
        <input
          type="radio"
          name=${field.id}
          value=${value}
          ?disabled=${disabled}
          .checked=${live(value === field.value)}
          @change=${() => field.onChoose(value)}
        />
        ${picture !== undefined ? html`<img src=${picture} alt="" />` : name === undefined ? nothing : icon(name, size)}<span
          >${label}</span
        >
      </label>`,
  );
}

/** Returns a few short options side by side; in two rows if they would not fit into one. */
export const segments = <Value extends string>(field: ChoiceField<Value>, legend = true): TemplateResult => {
  const { length: count } = field.options;
  const letters = field.options.reduce((sum, { label }) => sum + label.length, 0);
  const columns = count > 3 && letters > 24 ? Math.ceil(count / 2) : count;
  return named(
    field,
    html`<div
      class="segments wide"
      .style=${`--columns: ${columns}`}
      role="radiogroup"
      aria-label=${legend ? nothing : field.label}
      aria-labelledby=${legend ? `${field.id}-name` : nothing}
    >
      ${radios(field, 16)}
    </div>`,
    legend ? html`<span id="${field.id}-name">${field.label}</span>` : nothing,
  );
};

/** Moves the focus by arrow keys without choosing, as in toolbars,
 * because some cards ask for a file. Space and Enter choose. */
function onCardKey(event: KeyboardEvent): void {
  const cards = [...(event.currentTarget as HTMLElement).querySelectorAll<HTMLInputElement>('input:enabled')];
  const input = event.target as HTMLInputElement;
  const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
  if (by !== undefined) cards.at((cards.indexOf(input) + by) % cards.length)?.focus();
  else if (event.key === 'Enter') input.click();
  else return;
  event.preventDefault();
}

/** Returns options as cards, each with a picture or an icon. */
export const cards = <Value extends string>(field: ChoiceField<Value>): TemplateResult =>
  html`<div class="cards" role="radiogroup" aria-label=${field.label} @keydown=${onCardKey}>${radios(field, 22)}</div>`;

export const select = <Value extends string>(field: ChoiceField<Value>): TemplateResult =>
  named(
    field,
    html`<select
      id=${field.id}
      class="wide"
      .value=${live(field.value ?? '')}
      @change=${(event: Event) => field.onChoose((event.currentTarget as HTMLSelectElement).value as Value)}
    >
      ${field.options.map(
        ({ value, label, disabled = false }) =>
          html`<option value=${value} ?disabled=${disabled} ?selected=${value === field.value}>${label}</option>`,
      )}
    </select>`,
  );

export interface FlagField extends Field {
  value: boolean;
  onChange: (value: boolean) => void;
}

export const flag = (field: FlagField): TemplateResult =>
  named(
    field,
    html`<label class="switch"
      ><input
        type="checkbox"
        role="switch"
        id=${field.id}
        .checked=${live(field.value)}
        @change=${(event: Event) => field.onChange((event.currentTarget as HTMLInputElement).checked)}
    /></label>`,
  );

export interface TextField extends Field {
  value: string;
  maxLength: number;
  long?: boolean;
  onInput: (value: string) => void;
  onSettle?: () => void;
}

/** Returns a text's name and input, in one or several lines. */
export function textField(field: TextField): TemplateResult {
  const { id, label, value, maxLength } = field;
  /** Reads the text. `maxlength` is not used: it would cut pasted text without a message. */
  const read = (input: HTMLInputElement): boolean => {
    const { length } = input.value;
    const right = length <= maxLength;
    judge(input, right ? '' : t('setting.tooLong', { name: label, length, max: maxLength }));
    if (right) field.onInput(input.value);
    return right;
  };
  const onInput = (event: Event): void => {
    const input = event.currentTarget as HTMLInputElement;
    typing.add(input);
    if (read(input)) settleSoon(field);
  };
  const onChange = (event: Event): void => {
    const input = event.currentTarget as HTMLInputElement;
    typing.delete(input);
    if (input.value.length > maxLength) input.value = value; // the sentence about it stays, see `numberInput`
    input.setAttribute('aria-invalid', 'false');
    clearTimeout(pause); // a late pause could end the next drag
    field.onSettle?.();
  };
  const input = field.long
    ? html`<textarea
        class="wide"
        id=${id}
        rows="2"
        aria-describedby="${id}-error"
        ${shows(value)}
        @input=${onInput}
        @change=${onChange}
      ></textarea>`
    : html`<input
        type="text"
        class="wide"
        id=${id}
        spellcheck="false"
        aria-describedby="${id}-error"
        ${shows(value)}
        @input=${onInput}
        @change=${onChange}
      />`;
  return named(field, html`${input} ${errorText(id)}`);
}
