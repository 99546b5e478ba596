// A drawing written anew from what is cheap to draw. The browser's own renderer knows no limits: elements that show elements
// grow without end, filters and patterns multiply, and nothing stops it once it has begun. Only elements, attributes and styles
// that are listed here reach it, and only as many as their uses make of them.

/** Of what is drawn, uses counted in: an element is 1. */
const mostWeight = 40_000;
const weights = { character: 1 / 400, rule: 1 / 20, clip: 5, layer: 20, gradient: [8, 5] } as const;
const mostCharacters = 16e6;
const mostDepth = 200; // as in the engine
const mostLinks = 1000; // from element to element, by names and by nesting
const mostRules = 2000;
const mostParts = 4; // of a selector
const mostStops = 16; // of a gradient, each of which costs time in each pixel
/** In place of a pattern, which would be drawn again and again. */
const patternColour = '#808080';

const words = (text: string): ReadonlySet<string> => new Set(text.split(' '));
const gradients = words('linearGradient radialGradient');
const shapes = words('path rect circle ellipse polygon polyline line');
const containers = words('svg g a switch defs symbol clipPath mask');
const attributes = words(
  'id class d points x y width height cx cy r rx ry x1 y1 x2 y2 fx fy fr viewBox preserveAspectRatio gradientUnits ' +
    'gradientTransform spreadMethod offset clipPathUnits maskUnits maskContentUnits',
);
const properties = words(
  'fill fill-opacity fill-rule clip-rule stroke stroke-opacity stroke-width stroke-linecap stroke-linejoin ' +
    'stroke-miterlimit opacity stop-color stop-opacity color display visibility clip-path mask mask-type transform ' +
    'transform-origin transform-box overflow paint-order vector-effect',
);
const functions = words(
  'rgb rgba hsl hsla hwb lab lch oklab oklch color matrix translate translatex translatey scale scalex scaley rotate ' +
    'skewx skewy',
);
const paints = words('fill stroke');
const linked = words('clip-path mask');

interface Node {
  name: string;
  attributes: Map<string, string>;
  styles: Map<string, string>;
  children: Node[];
}

/** What an element asks for besides itself. */
interface Asked {
  rules: number;
  layers: number;
  clips: number;
  /** Ids. */
  links: string[];
}

const nothingAsked = (): Asked => ({ rules: 0, layers: 0, clips: 0, links: [] });

export class UnfitDrawing extends Error {}

const refuse = (why: string): never => {
  throw new UnfitDrawing(why);
};
const malformed = (): never => refuse('the drawing is not well-formed XML');
const tooMuch = (): never =>
  refuse(`the drawing has more than ${mostWeight} elements, or as much as those; draw it with fewer`);

// --- Styles ------------------------------------------------------------------------------------------------------------

/** @returns the value as it may be drawn; undefined: it is left out */
function plainValue(property: string, given: string, patterns: ReadonlySet<string>): string | undefined {
  if (!properties.has(property)) return undefined;
  // A custom property is not read, but what stands in for it is.
  const value = given.replace(/var\(\s*--[\w-]+\s*,([^()]*)\)/gi, '$1').trim();
  if (value === '' || /[\\@{}<>;]/.test(value)) return undefined;
  const [, id, rest = ''] = /^url\(\s*["']?#([^\s"'()]+)["']?\s*\)(.*)$/s.exec(value) ?? [];
  const after = id === undefined ? value : rest;
  for (const [, name = ''] of after.matchAll(/([\w-]*)\(/g)) if (!functions.has(name.toLowerCase())) return undefined;
  if (id === undefined)
    return linked.has(property) && !/^(?:none|initial|inherit|unset)$/i.test(value) ? undefined : value;
  if (paints.has(property)) return patterns.has(id) ? patternColour : `url(#${id})${rest}`;
  return linked.has(property) ? `url(#${id})` : undefined;
}

function plainStyles(text: string, patterns: ReadonlySet<string>): Map<string, string> {
  const styles = new Map<string, string>();
  for (const declaration of text.replace(/\/\*.*?\*\//gs, ' ').split(';')) {
    const colon = declaration.indexOf(':');
    const property = declaration.slice(0, Math.max(0, colon)).trim().toLowerCase();
    const value = plainValue(property, declaration.slice(colon + 1), patterns);
    if (value !== undefined) styles.set(property, value);
  }
  return styles;
}

const stylesText = (styles: ReadonlyMap<string, string>): string =>
  Array.from(styles, ([property, value]) => `${property}:${value}`).join(';');

/** What these ask for where they are used. */
function addAsked(asked: Asked, styles: ReadonlyMap<string, string>): void {
  for (const [property, value] of styles) {
    const id = /^url\(#([^)]*)\)/.exec(value)?.[1];
    if (id !== undefined) asked.links.push(id);
    if ((property === 'opacity' && Number(value) !== 1) || (property === 'mask' && id !== undefined)) ++asked.layers;
    if (property === 'clip-path' && id !== undefined) ++asked.clips;
  }
}

/** What every element that a selector names must have: '.class', '#id', 'tag' or '*'; undefined: the rule is left out. */
function keyOf(selector: string): string | undefined {
  const parts = selector.trim().split(/\s*>\s*|\s+/);
  const plain = /^(?:\*|[a-z][\w-]*)?(?:[.#][a-z_-][\w-]*)*$/i;
  if (parts.length > mostParts || parts.some((part) => part === '' || !plain.test(part))) return undefined;
  const last = parts.at(-1) ?? '';
  return /[.#][^.#]+/.exec(last)?.[0] ?? last;
}

interface Sheet {
  text: string;
  asked: Map<string, Asked>;
}

/** Rules that are no blocks of conditions, with selectors of names alone. */
function plainSheet(given: string, patterns: ReadonlySet<string>): Sheet {
  const text = given.replace(/\/\*.*?\*\//gs, ' ').replace(/<!--|-->/g, ' ');
  const asked = new Map<string, Asked>();
  const rules: string[] = [];
  for (let at = 0; ;) {
    const open = text.indexOf('{', at);
    if (open < 0) break;
    const prelude = text.slice(at, open).split(';').at(-1) ?? '';
    let end = open + 1;
    let nested = false;
    for (let depth = 1; depth > 0 && end < text.length; ++end) {
      if (text[end] === '{') {
        ++depth;
        nested = true;
      } else if (text[end] === '}') --depth;
    }
    at = end;
    if (nested || prelude.includes('@')) continue;
    const styles = plainStyles(text.slice(open + 1, end - 1), patterns);
    const selectors = prelude.split(',').flatMap((selector) => {
      const key = keyOf(selector);
      return key === undefined ? [] : [{ key, selector: selector.trim() }];
    });
    if (styles.size === 0 || selectors.length === 0) continue;
    for (const { key } of selectors) {
      const of = asked.get(key) ?? nothingAsked();
      ++of.rules;
      addAsked(of, styles);
      asked.set(key, of);
    }
    rules.push(`${selectors.map(({ selector }) => selector).join()}{${stylesText(styles)}}`);
    if (rules.length > mostRules) tooMuch();
  }
  return { text: rules.join('\n'), asked };
}

// --- Reading -----------------------------------------------------------------------------------------------------------

const predefined: Readonly<Record<string, string>> = { amp: '&', lt: '<', gt: '>', quot: '"', apos: "'" };

const decoded = (text: string, entities: ReadonlyMap<string, string>): string =>
  text.replace(/&(#x[\da-f]{1,6}|#\d{1,7}|[\w.:-]+);/gi, (whole, name: string) => {
    if (!name.startsWith('#')) return predefined[name] ?? entities.get(name) ?? '';
    const code = /^#x/i.test(name) ? Number.parseInt(name.slice(2), 16) : Number(name.slice(1));
    return code <= 0x10ffff ? String.fromCodePoint(code) : whole;
  });

/** Drawing programs shorten names and styles so; what entities hold of other entities is left out. */
function entitiesOf(doctype: string): Map<string, string> {
  const entities = new Map<string, string>();
  for (const [, name = '', double, single] of doctype.matchAll(
    /<!ENTITY\s+([\w.:-]+)\s+(?:"([^"]*)"|'([^']*)')\s*>/g,
  )) {
    entities.set(name, decoded(double ?? single ?? '', new Map()));
  }
  return entities;
}

interface Read {
  root: Node;
  sheets: string[];
  patterns: Set<string>;
}

class Reader {
  #at = 0;
  #entities: ReadonlyMap<string, string> = new Map();
  #characters = 0;

  constructor(private readonly text: string) {}

  /** Everything but what stands beside elements. */
  read(): Read {
    const { text } = this;
    const sheets: string[] = [];
    const patterns = new Set<string>();
    /** Elements that are open; those that are left out have no node. */
    const open: { name: string; node: Node | undefined; style: string | undefined }[] = [];
    let root: Node | undefined;
    let prefix = '';
    for (;;) {
      const before = this.#at;
      const next = text.indexOf('<', before);
      const inner = open.at(-1);
      const end = next < 0 ? text.length : next;
      if (inner?.style !== undefined) inner.style += decoded(text.slice(before, end), this.#entities);
      if (next < 0) break;
      this.#at = next;
      if (text.startsWith('<!--', next)) this.#past('-->', 4);
      else if (text.startsWith('<![CDATA[', next)) {
        const data = this.#past(']]>', 9);
        if (inner?.style !== undefined) inner.style += data;
      } else if (text.startsWith('<?', next)) this.#past('?>', 2);
      else if (text.startsWith('<!', next)) this.#doctype();
      else if (text.startsWith('</', next)) {
        const name = this.#past('>', 2).trim();
        const closed = open.pop();
        if (closed?.name !== name) malformed();
        if (closed?.style !== undefined) sheets.push(closed.style);
      } else {
        ++this.#at;
        const { name, given, closed } = this.#tag();
        const [space, local] = name.includes(':') ? name.split(':', 2) : ['', name];
        if (root === undefined) {
          prefix = space ?? '';
          if (local !== 'svg') refuse('this is not a drawing');
        }
        const ours = space === '' || space === prefix;
        const parent = inner?.node;
        const node = ours && (root === undefined || parent !== undefined) ? this.#node(local ?? '', given) : undefined;
        if (ours && local === 'pattern') patterns.add(decoded(given.get('id') ?? '', this.#entities));
        if (node !== undefined) parent?.children.push(node);
        root ??= node;
        if (!closed) {
          const styles = ours && local === 'style' && this.#isForScreens(given);
          open.push({ name, node, style: styles ? '' : undefined });
          if (open.length > mostDepth) refuse(`the drawing nests elements deeper than ${mostDepth} levels`);
        }
      }
    }
    if (root === undefined || open.length > 0) return malformed();
    return { root, sheets, patterns };
  }

  /** @returns what stands before `end`, which is left behind */
  #past(end: string, offset: number): string {
    const begin = this.#at + offset;
    const found = this.text.indexOf(end, begin);
    if (found < 0) malformed();
    this.#at = found + end.length;
    return this.text.slice(begin, found);
  }

  #doctype(): void {
    const begin = this.#at;
    const subset = this.text.indexOf('[', begin);
    const close = this.text.indexOf('>', begin);
    if (subset >= 0 && subset < close) {
      this.#at = subset;
      this.#past(']', 0);
    }
    this.#past('>', 0);
    this.#entities = entitiesOf(this.text.slice(begin, this.#at));
  }

  #matched(pattern: RegExp): string {
    pattern.lastIndex = this.#at;
    const found = pattern.exec(this.text)?.[0] ?? '';
    this.#at += found.length;
    return found;
  }

  #tag(): { name: string; given: Map<string, string>; closed: boolean } {
    const name = this.#matched(/[^\s=<>/"']+/y);
    if (name === '') malformed();
    const given = new Map<string, string>();
    for (;;) {
      this.#matched(/\s+/y);
      const attribute = this.#matched(/[^\s=<>/"']+/y);
      if (attribute === '') break;
      this.#matched(/\s*=\s*/y);
      const quote = this.text[this.#at];
      if (quote !== '"' && quote !== "'") malformed();
      given.set(attribute, this.#past(quote ?? '', 1));
    }
    const end = this.#matched(/\/?>/y);
    if (end === '') malformed();
    return { name, given, closed: end === '/>' };
  }

  #isForScreens(given: ReadonlyMap<string, string>): boolean {
    return /^(?:text\/css)?$/i.test(given.get('type') ?? '') && /^(?:all|screen)?$/i.test(given.get('media') ?? '');
  }

  /** @returns undefined for what is left out, with all that is in it */
  #node(name: string, given: ReadonlyMap<string, string>): Node | undefined {
    if (!containers.has(name) && !shapes.has(name) && !gradients.has(name) && name !== 'use' && name !== 'stop') {
      return undefined;
    }
    // As the engine reads a <switch>: in English, and without extensions.
    if (given.has('requiredExtensions') || !/(?:^|[\s,])en\b|^$/i.test(given.get('systemLanguage') ?? ''))
      return undefined;
    const node: Node = { name, attributes: new Map(), styles: new Map(), children: [] };
    for (const [attribute, raw] of given) {
      const local = /:href$/.test(attribute) ? 'href' : attribute;
      const kept = attributes.has(local) || properties.has(local) || local === 'style';
      const links = local === 'href' && (name === 'use' || gradients.has(name));
      if (!kept && !links) continue;
      const value = decoded(raw, this.#entities);
      this.#characters += value.length;
      if (this.#characters > mostCharacters) tooMuch();
      if (!links || value.trim().startsWith('#')) node.attributes.set(local, links ? value.trim() : value);
    }
    return node;
  }
}

/** Styles of attributes are read, and long gradients thinned, once all patterns are known. */
function tidy(node: Node, patterns: ReadonlySet<string>): void {
  node.styles = plainStyles(node.attributes.get('style') ?? '', patterns);
  node.attributes.delete('style');
  for (const [name, value] of node.attributes) {
    if (!properties.has(name)) continue;
    const plain = plainValue(name, value, patterns);
    if (plain === undefined) node.attributes.delete(name);
    else node.attributes.set(name, plain);
  }
  if (gradients.has(node.name) && node.children.length > mostStops) {
    const step = node.children.length / mostStops;
    node.children = Array.from({ length: mostStops }, (_, k) => node.children[Math.floor(k * step)] as Node);
  }
  for (const child of node.children) tidy(child, patterns);
}

// --- Weighing ----------------------------------------------------------------------------------------------------------

/** As often as it is shown. @throws UnfitDrawing where that is too much, or shows itself */
function weigh(root: Node, sheet: Sheet): number {
  const byId = new Map<string, Node>();
  const collect = (node: Node): void => {
    const id = node.attributes.get('id');
    if (id !== undefined && !byId.has(id)) byId.set(id, node);
    node.children.forEach(collect);
  };
  collect(root);

  const known = new Map<Node, number>();
  const going = new Set<Node>();
  const weightOf = (node: Node): number => {
    const before = known.get(node);
    if (before !== undefined) return before;
    if (going.has(node)) return refuse('the drawing shows an element in itself');
    if (going.size > mostLinks) return tooMuch();
    going.add(node);
    const asked = nothingAsked();
    addAsked(asked, node.styles);
    addAsked(asked, node.attributes);
    const { attributes: given } = node;
    const link = given.get('href');
    if (link !== undefined) asked.links.push(link.slice(1));
    const classes = (given.get('class') ?? '').split(/\s+/).filter((name) => name !== '');
    for (const key of new Set(['*', node.name, `#${given.get('id') ?? ''}`, ...classes.map((name) => `.${name}`)])) {
      const more = sheet.asked.get(key);
      if (more === undefined) continue;
      asked.rules += more.rules;
      asked.layers += more.layers;
      asked.clips += more.clips;
      asked.links.push(...more.links);
    }
    let characters = 0;
    for (const value of given.values()) characters += value.length;
    let weight =
      1 +
      characters * weights.character +
      asked.rules * weights.rule +
      asked.clips * weights.clip +
      asked.layers * weights.layer;
    const shown = asked.links.flatMap((id) => byId.get(id) ?? []);
    for (const one of [...node.children, ...shown]) {
      weight += weightOf(one);
      if (weight > mostWeight) return tooMuch();
    }
    going.delete(node);
    known.set(node, weight);
    return weight;
  };
  return weightOf(root);
}

const hasGradients = ({ name, children }: Node): boolean => gradients.has(name) || children.some(hasGradients);

// --- Writing -----------------------------------------------------------------------------------------------------------

const escaped = (text: string): string =>
  text.replace(/[&<>"]/g, (letter) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;' })[letter] ?? '&quot;');

function write(node: Node, out: string[], head = ''): void {
  out.push('<', node.name);
  for (const [name, value] of node.attributes) out.push(' ', name, '="', escaped(value), '"');
  if (node.styles.size > 0) out.push(' style="', escaped(stylesText(node.styles)), '"');
  out.push('>', head);
  for (const child of node.children) write(child, out);
  out.push('</', node.name, '>');
}

export interface PlainDrawing {
  text: string;
  /** An element is 1, uses counted in; at most 40,000. */
  weight: number;
  /** What each pixel may cost: all elements may cover it, and 1 is one of one colour. */
  pixel: number;
}

/** Text, pictures, filters, markers, patterns and animation are left out, as the engine leaves them out.
 * @throws UnfitDrawing where it is no drawing, or too much of one */
export function plainDrawing(text: string): PlainDrawing {
  if (text.length > mostCharacters) return tooMuch();
  const { root, sheets, patterns } = new Reader(text).read();
  tidy(root, patterns);
  const sheet = plainSheet(sheets.join('\n'), patterns);
  // Any of its elements may be painted with a gradient, which each has to build anew.
  const [built, drawn] = hasGradients(root) ? weights.gradient : [1, 1];
  const weight = weigh(root, sheet) * built;
  if (weight > mostWeight) return tooMuch();
  const out: string[] = [];
  root.attributes.set('xmlns', 'http://www.w3.org/2000/svg');
  write(root, out, sheet.text === '' ? '' : `<style>${escaped(sheet.text)}</style>`);
  return { text: out.join(''), weight, pixel: weight * drawn };
}
