// The tiles of a new plate, one for each thing that people bring.
import { css, html, type TemplateResult } from 'lit';
import { icon } from '../controls/icons.js';
import { t } from '../i18n/text.js';
import { groundFill, isPictureFill } from '../model/fills.js';
import type { LayerKind } from '../model/layers.js';
import type { Studio } from '../studio/studio.js';
import { drawingFiles, pictureFiles } from './add-layer.js';
import { chooseFill } from './fill-cards.js';
import { tile } from './tiles.js';
import { button } from '../controls/button.js';

const begins = {
  photo: 'picture',
  logo: 'drawing',
  text: 'text',
  code: 'code',
  pattern: 'pattern',
} as const satisfies Record<string, LayerKind>;
type Begin = keyof typeof begins;

/** Kinds that these tiles put on top. */
export const startKinds: ReadonlySet<LayerKind> = new Set(['text', 'code']);

export const startStyle = css`
  .start {
    display: grid;
    grid-template-columns: repeat(3, 1fr);
    gap: 8px;
  }
  .start button {
    flex-direction: column;
    gap: 8px;
    min-height: 92px;
    padding: 10px 4px 8px;
    border-radius: var(--radius-large);
  }
  .start .icon {
    height: 44px;
  }
`;

/** The tiles.
 * @param add  puts a layer on top
 * @param more  unfolds or folds all other ways to begin
 * @param unfolded  tells whether those are unfolded */
export function startTiles(
  studio: Studio,
  add: (kind: LayerKind) => void,
  more: () => void,
  unfolded: boolean,
): TemplateResult {
  return html`<div class="start" role="group" aria-labelledby="layers-title">
    ${Object.entries(begins).map(([name, kind]) =>
      button('', html`${tile(kind)}<span>${t(`start.${name as Begin}`)}</span>`, () => {
        if (startKinds.has(kind)) add(kind);
        else void begin(studio, name as Begin);
      }),
    )}
    <button aria-expanded=${String(unfolded)} @click=${more}>${icon('more', 22)}<span>${t('start.more')}</span></button>
  </div>`;
}

/** Fills the plate with a pattern, or with a file that the visitor chooses. */
async function begin(studio: Studio, name: Begin): Promise<void> {
  if (name === 'pattern') {
    const fill = groundFill(studio.store.state.plate);
    if (fill === undefined || isPictureFill(fill)) await chooseFill(studio, 'waves');
  } else {
    await studio.open(
      await studio.pick(name === 'photo' ? pictureFiles : drawingFiles),
      name === 'photo' ? 'lamp' : undefined,
    );
  }
}
