// All actions of the page, each with its name, its key and the words that people search for.
import { words } from '../i18n/en/help.js';
import { words as exportWords } from '../i18n/en/export.js';
import { words as printerWords } from '../i18n/en/printer.js';
import { words as synonyms } from '../i18n/en/synonyms.js';
import { l } from '../i18n/layers.js';
import { languages } from '../i18n/languages.js';
import { printerLabel, settingLabel } from '../i18n/say.js';
import { a } from '../i18n/shaping.js';
import { say, t } from '../i18n/text.js';
import type { IconName } from '../controls/icons.js';
import { addLayer } from '../layers/add-layer.js';
import { chooseFill } from '../layers/fill-cards.js';
import { fillIcons } from '../layers/icons.js';
import { filaments, withFilament } from '../model/filaments.js';
import { patternFills, pictureFills, type Fill } from '../model/fills.js';
import { sections } from '../model/guest.js';
import { layerKinds } from '../model/layer-list.js';
import { printers, printersByFile, withPrinter } from '../model/printers.js';
import { expertSettings, settings, type SettingId } from '../model/settings.js';
import { builtinShapes, withShape } from '../model/shapes.js';
import { filamentLabel } from '../print/filament-name.js';
import { products } from '../print/downloads.js';
import { pickPrinter } from '../print/machine-fields.js';
import type { Studio } from '../studio/studio.js';
import { pickSliced } from './pick-sliced.js';
import { showSetting } from '../controls/show-setting.js';

type Known = keyof typeof synonyms extends `also.${infer Name}` ? Name : never;
const also = (id: Known): string => say(synonyms, `also.${id}`);

const alsoFill = (fill: Fill): string =>
  fill === 'picture' || fill === 'brightness' || fill === 'edges' || fill === 'levels' || fill === 'colours'
    ? also(fill)
    : '';

export interface Action {
  /** Heading above the action; empty: none. */
  group: string;
  label: string;
  icon: IconName;
  keys?: string;
  disabled?: boolean;
  /** Synonyms by which the action is found. */
  also?: string;
  /** The action is listed only if a search finds it. */
  rare?: boolean;
  run: () => void;
}

const views = [
  ['appearance', 'look'],
  ['toolpath', 'beads'],
  ['quality', 'quality'],
  ['directions', 'flow'],
] as const;
/** Settings that people know by other names. */
const otherNames: Partial<Record<SettingId, Known>> = {
  'toolpath.spacing': 'spacing',
  'toolpath.perimeterMode': 'outline',
  'toolpath.perimeters': 'walls',
  'print.layers': 'top',
  'print.base': 'bottom',
};
const tools = [
  ['pan', 'hand', 'V'],
  ['comb', 'comb', 'B'],
  ['mode', 'mode', 'M'],
  ['erase', 'erase', 'E'],
] as const;
const action = (icon: IconName, label: string, more: Partial<Action>, run: () => void): Action => ({
  group: '',
  icon,
  label,
  ...more,
  run,
});

/** Returns the actions that are listed without a search. */
function usual(studio: Studio): Action[] {
  const { store } = studio;
  const { plate, compare } = store.state;
  const [files, view, light] = [t('verb.download'), t('view.title'), t('light.title')];
  return [
    action('open', t('verb.open'), { keys: 'Ctrl O', also: also('open') }, () => void studio.openPicked()),
    action('plus', t('verb.new'), {}, () => studio.services.newPlate()),
    action('gallery', t('verb.plates'), {}, studio.opens('plates')),
    action('gallery', t('section.gallery'), {}, studio.opens('gallery')),
    action('undo', t('verb.undo'), { also: also('undo'), keys: 'Ctrl Z', disabled: !store.canUndo }, () =>
      store.undo(),
    ),
    action('redo', t('verb.redo'), { keys: 'Ctrl Shift Z', disabled: !store.canRedo }, () => store.redo()),
    action('share', t('verb.share'), { also: also('share') }, studio.opens('share')),
    action('comb', t('verb.rebrush'), { also: also('rebrush') }, () => void pickSliced(studio)),
    action('print', t('verb.first'), { also: also('first') }, studio.opens('first')),
    action('tune', t('verb.calibrate'), { also: also('calibrate') }, studio.opens('calibrate')),
    action('print', say(printerWords, 'sheet.title'), { also: also('printer') }, studio.opens('printer')),
    action('sun', say(exportWords, 'card.title'), { keys: 'Ctrl P', also: also('card') }, studio.opens('card')),
    action('help', t('help.title'), { keys: '?' }, studio.opens('help')),
    ...products.map(([product, icon]) => {
      const known =
        product === 'gcode' || product === 'zones' || product === 'svg' || product === 'loop' || product === 'project';
      const disabled = product === 'body' && plate.print.base === 0;
      const keys = { gcode: 'Ctrl Shift S', project: 'Ctrl S' }[product as string] ?? '';
      const more = { group: files, keys, also: known ? also(product) : '', disabled };
      return action(icon, t(`export.${product}`), more, () => void studio.save(product));
    }),
    ...views.map(([name, known], k) =>
      action('light', t(`view.${name}`), { group: view, also: also(known), keys: String(k + 1) }, () =>
        studio.setView(name),
      ),
    ),
    ...sections.map((section) =>
      action(section, t(`section.${section}`), { group: t('app.settings'), also: also(section) }, () =>
        studio.setPanel(section),
      ),
    ),
    ...tools.map(([tool, icon, keys]) =>
      action(icon, t(`tool.${tool}`), { group: t('tool.title'), keys }, () => studio.setTool(tool)),
    ),
    action('fit', t('verb.fit'), { keys: '0' }, () => studio.stage?.fit()),
    action('plus', t('verb.zoomIn'), { keys: '+' }, () => studio.stage?.zoom(1.4)),
    action('minus', t('verb.zoomOut'), { keys: '-' }, () => studio.stage?.zoom(1 / 1.4)),
    action('compare', say(words, 'keys.compare'), { keys: 'C' }, () =>
      store.set({ compare: !compare, view: 'appearance' }),
    ),
    action('play', say(words, 'keys.play'), { keys: 'P' }, () => studio.togglePlay()),
    ...(['pointer', 'orbit', 'fixed'] as const).map((mode) =>
      action('sun', t(`light.${mode}`), { group: light, also: also('light') }, () => void studio.setLightMode(mode)),
    ),
    ...(['auto', 'light', 'dark'] as const).map((theme) =>
      action('half', t(`theme.${theme}`), { group: t('theme.title') }, () => studio.setTheme(theme)),
    ),
    ...Object.entries(languages).map(([key, { name }]) =>
      action('share', name, { group: t('language.title') }, () => void studio.setLanguage(key)),
    ),
  ];
}

/** Returns items of lists, such as printers and settings: a search finds them, but they are not listed otherwise. */
function rare(studio: Studio): Action[] {
  const change = (change: Parameters<Studio['change']>[0]) => (): void => {
    studio.settle();
    studio.change(change);
  };
  const choose = (change: Parameters<Studio['change']>[0]) => (): void => {
    studio.settle();
    studio.choosePrint(change);
  };
  return [
    ...layerKinds
      .filter((kind) => kind !== 'strokes')
      .map((kind) => {
        const known = kind === 'text' || kind === 'code' || kind === 'drawing' || kind === 'picture';
        const more = { group: l('add'), also: known ? also(kind) : '' };
        return action('layers', l(`kind.${kind}`), more, () => void addLayer(studio, kind));
      }),
    ...[...pictureFills, ...patternFills].map((fill) => {
      const more = { group: t('section.layers'), also: alsoFill(fill) };
      return action(fillIcons[fill], t(`source.${fill}`), more, () => void chooseFill(studio, fill));
    }),
    ...builtinShapes.map((shape) => {
      const choice = change((plate) => withShape(plate, shape));
      return action('shape', a(`kind.${shape}`), { group: t('section.shape') }, choice);
    }),
    ...printers.map((printer) => {
      const choice = choose((plate) => withPrinter(plate, printer.key));
      return action('print', printerLabel(printer), { group: t('section.printer') }, choice);
    }),
    ...printersByFile.map(({ label: name }) => {
      const label = say(printerWords, 'printer.byFile', { name });
      return action('print', label, { group: t('section.printer') }, () => void pickPrinter(studio));
    }),
    ...filaments.map((filament) => {
      const choice = choose((plate) => withFilament(plate, filament.key));
      return action('print', filamentLabel(filament), { group: t('section.filament') }, choice);
    }),
    ...settings
      .filter(({ id }) => !expertSettings.has(id))
      .map(({ id, section }) => {
        const { [id]: name } = otherNames;
        const place = section === 'pictures' ? 'layers' : section === 'printer' ? 'printer' : 'print';
        const more = { group: t(`section.${place}`), also: name === undefined ? id : `${id} ${also(name)}` };
        return action('tune', settingLabel({ id }), more, () => void showSetting(studio, id));
      }),
  ].map((one) => ({ ...one, rare: true }));
}

export const actionsOf = (studio: Studio): Action[] => [...usual(studio), ...rare(studio)];
