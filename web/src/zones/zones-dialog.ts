// Dialog for a body that is not sliced yet: it lists the body's level top faces, and the chosen one becomes the plate.
import { css, html, nothing, svg, type PropertyValues, type TemplateResult } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { DialogElement } from '../controls/dialog.js';
import { icon } from '../controls/icons.js';
import { cleanName, sourceFile, stemOf } from '../files/source-file.js';
import { words } from '../i18n/en/zones.js';
import { exactWords } from '../i18n/say-problem.js';
import { problemWords } from '../i18n/say.js';
import { formatNumber, say } from '../i18n/text.js';
import { newFileShape } from '../model/defaults.js';
import { problemOf, type Problem } from '../model/problem.js';
import { readBody, stlOf, type Mesh } from './mesh.js';
import { drawingOf, pathOf, topFaces, type TopFace } from './top-faces.js';
import { button } from '../controls/button.js';

interface Known {
  file: File;
  mesh: Mesh;
  faces: readonly TopFace[];
}

@customElement('sillon-zones')
export class Zones extends DialogElement {
  static override reads = ['sliced'] as const;

  static override styles = css`
    dialog {
      width: min(640px, calc(100vw - 24px));
    }
    .none {
      display: grid;
      gap: 14px;
    }
    .faces {
      display: grid;
      grid-template-columns: repeat(auto-fill, minmax(150px, 1fr));
      gap: 10px;
    }
    .faces button {
      display: grid;
      justify-items: start;
      gap: 4px;
      width: 100%;
      height: 100%;
      padding: 8px;
      text-align: start;
    }
    svg.face {
      width: 100%;
      height: 96px;
    }
    .others {
      fill: var(--line);
    }
    .own {
      fill: var(--accent);
    }
  `;

  @state() private known: Known | undefined;
  @state() private problem: Problem | undefined;
  #file: File | undefined;

  protected override heading = (): string => say(words, 'zones.title', { name: this.state.sliced?.name ?? '' });

  override updated(changed: PropertyValues): void {
    super.updated(changed);
    const { sliced } = this.state;
    if (sliced === undefined || sliced === this.#file) return;
    this.#file = sliced;
    void this.#read(sliced);
  }

  async #read(file: File): Promise<void> {
    this.known = undefined;
    this.problem = undefined;
    try {
      const mesh = await readBody(file);
      if (file !== this.#file) return;
      this.known = { file, mesh, faces: topFaces(mesh) };
      await this.updateComplete;
      this.renderRoot.querySelector<HTMLElement>('.faces button')?.focus(); // they appear only now
    } catch (error) {
      if (file === this.#file) this.problem = problemOf(error);
    }
  }

  protected override body(): TemplateResult {
    const { known, problem } = this;
    const name = this.state.sliced?.name ?? '';
    if (problem !== undefined) return this.#failed(problem, name);
    if (known === undefined) return html`<p role="status">${say(words, 'zones.reading', { name })}</p>`;
    if (known.faces.length === 0)
      return html`<div class="none" role="alert">
        <p><b>${say(words, 'zones.none', { name })}</b></p>
        <p>${say(words, 'zones.none.help')}</p>
      </div>`;
    return html`<p>${say(words, 'zones.help')}</p>
      <ul class="faces">
        ${known.faces.map((face) => html`<li>${this.#card(face, known)}</li>`)}
      </ul>`;
  }

  #failed(problem: Problem, name: string): TemplateResult {
    const { message, hint } = { ...problemWords(problem), ...exactWords(problem) };
    const tooLarge = problem.code === 'TooLarge';
    return html`<div class="none" role="alert">
      <p>${icon('warn')} <b>${tooLarge ? say(words, 'zones.tooLarge', { name }) : message}</b></p>
      ${tooLarge ? nothing : html`<p>${hint}</p>`}
    </div>`;
  }

  #card(face: TopFace, known: Known): TemplateResult {
    const [width, height] = face.size.map((length) => formatNumber(length, 1)) as [string, string];
    return button(
      '',
      html`${picture(face, known.faces)}
        <span>${say(words, 'zones.face', { width, height, z: formatNumber(face.z, 2) })}</span>
        <span class="note">${say(words, 'zones.area', { area: formatNumber(face.areaMm2, 0) })}</span>`,
      () => void this.studio.attempt(() => this.#choose(face, known)),
    );
  }

  async #choose(face: TopFace, { file, mesh }: Known): Promise<void> {
    const name = cleanName(file.name);
    const isStl = /\.stl$/i.test(name);
    const stl = new Uint8Array(await (isStl ? file : stlOf(mesh)).arrayBuffer());
    const solid = await sourceFile(isStl ? name : `${stemOf(name)}.stl`, stl);
    const drawing = new TextEncoder().encode(drawingOf(face));
    const outline = await sourceFile(`${stemOf(name)}.svg`, drawing);
    const [width, height] = face.size;
    this.studio.services.openMade((plate) => ({
      ...plate,
      name: stemOf(name),
      shape: newFileShape(outline, 'mm'),
      width,
      height,
      body: { file: solid, face: [...face.corner, face.z], size: [width, height], outline: outline.id },
    }));
    this.close(() => {
      this.studio.store.set({ sliced: undefined });
      this.studio.notify(say(words, 'zones.opened', { name }), {
        label: say(words, 'zones.download'),
        run: () => void this.studio.save('zones'),
      });
    });
  }
}

/** The face among the others, seen from above. */
function picture(face: TopFace, faces: readonly TopFace[]): TemplateResult {
  const least = (k: 0 | 1): number => Math.min(...faces.map(({ corner }) => corner[k]));
  const most = (k: 0 | 1): number => Math.max(...faces.map(({ corner, size }) => corner[k] + size[k]));
  const [left, bottom, right, top] = [least(0), least(1), most(0), most(1)];
  const place = ({ corner, size }: TopFace): [number, number] => [corner[0] - left, top - corner[1] - size[1]];
  const lowFirst = faces.filter((one) => one !== face).sort((a, b) => a.z - b.z);
  return html`<svg class="face" viewBox="0 0 ${right - left} ${top - bottom}" aria-hidden="true">
    ${lowFirst.map((one) => svg`<path class="others" fill-rule="evenodd" d=${pathOf(one, place(one))} />`)}
    ${svg`<path class="own" fill-rule="evenodd" d=${pathOf(face, place(face))} />`}
  </svg>`;
}
