// The layers of an example, with their files.
import type { ExampleLayer } from '../model/example.js';
import { isFontFile, layerDefaults } from '../model/layer-list.js';
import type { PlateLayer, SourceFile } from '../model/plate.js';

/** @param fetched  a file that lies beside the page, by its name */
export const layersFor = (
  layers: readonly ExampleLayer[],
  fetched: (name: string) => Promise<SourceFile>,
): Promise<PlateLayer[]> => {
  const fileOf = (name: string | null = null): Promise<SourceFile | null> =>
    name === null ? Promise.resolve(null) : fetched(name);
  return Promise.all(
    layers.map(async (layer, k) => {
      const usual = layerDefaults();
      const held = {
        file: await fileOf(layer.file),
        maskFile: await fileOf(layer.maskFile),
        modeFile: await fileOf(layer.modeFile),
      };
      const more = layer.others ?? [];
      const others = await Promise.all(more.map(async ({ file, lamp }) => ({ file: await fetched(file), lamp })));
      const own = layer.font !== undefined && isFontFile(layer.font) ? await fetched(layer.font) : layer.font;
      return { ...usual, ...layer, id: k + 1, ...held, others, font: own ?? usual.font };
    }),
  );
};
