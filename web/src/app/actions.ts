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
import { pickPrinter } from '../print/machine-fields.js';
import type { Product, Studio } from '../studio/studio.js';
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
const products: readonly (readonly [Product, IconName, string?])[] = [
  ['gcode', 'print', 'Ctrl Shift S'],
  ['body', 'body'],
  ['zones', 'body'],
  ['svg', 'toolpath'],
  ['png', 'camera'],
  ['loop', 'video'],
  ['view', 'sun'],
  ['project', 'file', 'Ctrl S'],
];

/** Returns the actions that are listed without a search. */
function usual(studio: Studio): Action[] {
  const { store } = studio;
  const { plate, compare } = store.state;
  return [
    {
      group: '',
      label: t('verb.open'),
      icon: 'open',
      keys: 'Ctrl O',
      also: also('open'),
      run: () => void studio.pick().then((files) => studio.open(files)),
    },
    {
      group: '',
      label: t('verb.new'),
      icon: 'plus',
      run: () => {
        studio.services.newPlate();
      },
    },
    {
      group: '',
      label: t('verb.plates'),
      icon: 'gallery',
      run: studio.opens('plates'),
    },
    {
      group: '',
      label: t('section.gallery'),
      icon: 'gallery',
      run: studio.opens('gallery'),
    },
    {
      group: '',
      label: t('verb.undo'),
      icon: 'undo',
      also: also('undo'),
      keys: 'Ctrl Z',
      disabled: !store.canUndo,
      run: () => {
        store.undo();
      },
    },
    {
      group: '',
      label: t('verb.redo'),
      icon: 'redo',
      keys: 'Ctrl Shift Z',
      disabled: !store.canRedo,
      run: () => {
        store.redo();
      },
    },
    {
      group: '',
      label: t('verb.share'),
      icon: 'share',
      also: also('share'),
      run: studio.opens('share'),
    },
    {
      group: '',
      label: t('verb.rebrush'),
      icon: 'comb',
      also: also('rebrush'),
      run: () => void pickSliced(studio),
    },
    ...(['first', 'calibrate'] as const).map((dialog) => ({
      group: '',
      label: t(`verb.${dialog}`),
      icon: dialog === 'first' ? ('print' as const) : ('tune' as const),
      also: also(dialog),
      run: () => {
        studio.show(dialog);
      },
    })),
    {
      group: '',
      label: say(printerWords, 'sheet.title'),
      icon: 'print',
      also: also('printer'),
      run: studio.opens('printer'),
    },
    {
      group: '',
      label: say(exportWords, 'card.title'),
      icon: 'sun',
      keys: 'Ctrl P',
      also: also('card'),
      run: studio.opens('card'),
    },
    {
      group: '',
      label: t('help.title'),
      icon: 'help',
      keys: '?',
      run: studio.opens('help'),
    },
    ...products.map(([product, name, keys = '']) => ({
      group: t('verb.download'),
      label: t(`export.${product}`),
      icon: name,
      keys,
      also:
        product === 'gcode' || product === 'zones' || product === 'svg' || product === 'loop' || product === 'project'
          ? also(product)
          : '',
      disabled: product === 'body' && plate.print.base === 0,
      run: () => void studio.save(product),
    })),
    ...views.map(([view, name], k) => ({
      group: t('view.title'),
      label: t(`view.${view}`),
      icon: 'light' as const,
      also: also(name),
      keys: String(k + 1),
      run: () => {
        studio.setView(view);
      },
    })),
    ...sections.map((section) => ({
      group: t('app.settings'),
      label: t(`section.${section}`),
      icon: section,
      also: also(section),
      run: () => {
        studio.setPanel(section);
      },
    })),
    ...tools.map(([tool, name, keys]) => ({
      group: t('tool.title'),
      label: t(`tool.${tool}`),
      icon: name,
      keys,
      run: () => {
        studio.setTool(tool);
      },
    })),
    { group: '', label: t('verb.fit'), icon: 'fit', keys: '0', run: () => studio.stage?.fit() },
    { group: '', label: t('verb.zoomIn'), icon: 'plus', keys: '+', run: () => studio.stage?.zoom(1.4) },
    { group: '', label: t('verb.zoomOut'), icon: 'minus', keys: '-', run: () => studio.stage?.zoom(1 / 1.4) },
    {
      group: '',
      label: say(words, 'keys.compare'),
      icon: 'compare',
      keys: 'C',
      run: () => {
        store.set({ compare: !compare, view: 'appearance' });
      },
    },
    {
      group: '',
      label: say(words, 'keys.play'),
      icon: 'play',
      keys: 'P',
      run: () => {
        studio.togglePlay();
      },
    },
    ...(['pointer', 'orbit', 'fixed'] as const).map((mode) => ({
      group: t('light.title'),
      label: t(`light.${mode}`),
      icon: 'sun' as const,
      also: also('light'),
      run: () => void studio.setLightMode(mode),
    })),
    ...(['auto', 'light', 'dark'] as const).map((theme) => ({
      group: t('theme.title'),
      label: t(`theme.${theme}`),
      icon: 'half' as const,
      run: () => {
        studio.setTheme(theme);
      },
    })),
    ...Object.entries(languages).map(([key, { name }]) => ({
      group: t('language.title'),
      label: name,
      icon: 'share' as const,
      run: () => void studio.setLanguage(key),
    })),
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
      .map((kind) => ({
        group: l('add'),
        label: l(`kind.${kind}`),
        icon: 'layers' as const,
        also: kind === 'text' || kind === 'code' || kind === 'drawing' || kind === 'picture' ? also(kind) : '',
        run: () => void addLayer(studio, kind),
      })),
    ...[...pictureFills, ...patternFills].map((fill) => ({
      group: t('section.layers'),
      label: t(`source.${fill}`),
      icon: fillIcons[fill],
      also: alsoFill(fill),
      run: () => void chooseFill(studio, fill),
    })),
    ...builtinShapes.map((shape) => ({
      group: t('section.shape'),
      label: a(`kind.${shape}`),
      icon: 'shape' as const,
      run: change((plate) => withShape(plate, shape)),
    })),
    ...printers.map((printer) => ({
      group: t('section.printer'),
      label: printerLabel(printer),
      icon: 'print' as const,
      run: choose((plate) => withPrinter(plate, printer.key)),
    })),
    ...printersByFile.map(({ label }) => ({
      group: t('section.printer'),
      label: say(printerWords, 'printer.byFile', { name: label }),
      icon: 'print' as const,
      run: () => void pickPrinter(studio),
    })),
    ...filaments.map((filament) => ({
      group: t('section.filament'),
      label: filamentLabel(filament),
      icon: 'print' as const,
      run: choose((plate) => withFilament(plate, filament.key)),
    })),
    ...settings
      .filter(({ id }) => !expertSettings.has(id))
      .map(({ id, section }) => {
        const { [id]: name } = otherNames;
        return {
          group: t(
            section === 'pictures' ? 'section.layers' : section === 'printer' ? 'section.printer' : 'section.print',
          ),
          label: settingLabel({ id }),
          icon: 'tune' as const,
          also: name === undefined ? id : `${id} ${also(name)}`,
          run: () => void showSetting(studio, id),
        };
      }),
  ].map((action) => ({ ...action, rare: true }));
}

export const actionsOf = (studio: Studio): Action[] => [...usual(studio), ...rare(studio)];
