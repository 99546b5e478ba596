// The layers of an example, with their files.
import type { ExampleLayer } from '../model/example.js';
import { isFontFile, layerDefaults } from '../model/layer-list.js';
import type { PlateLayer, SourceFile } from '../model/plate.js';

/** @param fetched  a file that lies beside the page, by its name */
export const layersFor = (
  layers: readonly ExampleLayer[],
  fetched: (name: string) => Promise<SourceFile>,
): Promise<PlateLayer[]> => {
  const fileOf = (name: string | undefined): Promise<SourceFile | null> =>
    name === undefined ? Promise.resolve(null) : fetched(name);
  return Promise.all(
    layers.map(async (layer, k) => {
      const usual = layerDefaults();
      const [file, maskFile] = await Promise.all([fileOf(layer.file), fileOf(layer.maskFile)]);
      const own = layer.font !== undefined && isFontFile(layer.font) ? await fetched(layer.font) : layer.font;
      return { ...usual, ...layer, id: k + 1, file, maskFile, font: own ?? usual.font };
    }),
  );
};
