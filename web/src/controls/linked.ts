// Turns names of settings in sentences into buttons that lead to their fields.
import type { TemplateResult } from 'lit';
import { showSetting, type FieldId } from './show-setting.js';
import { settingLabel } from '../i18n/say.js';
import { words as presets } from '../i18n/en/presets.js';
import { language, say } from '../i18n/text.js';
import { expertSettings, settings } from '../model/settings.js';
import { offers } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';
import { button } from './button.js';

/** A name between the quotation marks of any language; French ones have inner spaces. */
const quoted = /([“„]|«[\u00a0\u202f])([^“”„«»]+)([”“]|[\u00a0\u202f]»)/;

let labels: { of: string; fields: ReadonlyMap<string, FieldId> } | undefined;

/** Returns the fields by their names in the page's language. */
function fieldsByLabel(): ReadonlyMap<string, FieldId> {
  if (labels?.of !== language()) {
    const named = settings
      .filter(({ id }) => !expertSettings.has(id))
      .map(({ id }) => [settingLabel({ id }), id] as const);
    labels = {
      of: language(),
      fields: new Map<string, FieldId>([...named, [say(presets, 'preset.title'), 'quality']]),
    };
  }
  return labels.fields;
}

/** Plain text, or a field that the sentence names in quotation marks. */
type Piece = string | { label: string; field: FieldId };

/** Splits a sentence into plain text and named fields. */
export function piecesOf(text: string): Piece[] {
  const pieces = text.split(new RegExp(quoted, 'g'));
  return pieces.flatMap((piece, k): Piece[] => {
    const field = k % 4 === 2 ? fieldsByLabel().get(piece) : undefined;
    return field === undefined ? (piece === '' ? [] : [piece]) : [{ label: piece, field }];
  });
}

/** Returns the sentence with a button for each setting that it names. */
export const linked = (studio: Studio, text: string): (string | TemplateResult)[] =>
  piecesOf(text).map((piece) => {
    if (typeof piece === 'string') return piece;
    const { label, field } = piece;
    if (!offers(studio.store.state, 'print')) return label;
    return button('link', label, () => void showSetting(studio, field));
  });
