// Makes the layers of an example, with their files.
import type { ExampleLayer } from '../model/example.js';
import { isFontFile, layerDefaults } from '../model/layer-list.js';
import type { PlateLayer, SourceFile } from '../model/plate.js';

/** Returns the layers of an example. @param fetched  loads a file of the page by its name */
export const layersFor = (
  layers: readonly ExampleLayer[],
  fetched: (name: string) => Promise<SourceFile>,
): Promise<PlateLayer[]> => {
  const fileOf = async (name?: string): Promise<SourceFile | null> => (name === undefined ? null : fetched(name));
  return Promise.all(
    layers.map(async (layer, k) => {
      const usual = layerDefaults();
      const { pictures = [], font } = layer;
      return {
        ...usual,
        ...layer,
        id: k + 1,
        file: await fileOf(layer.file),
        pictures: await Promise.all(
          pictures.map(async ({ file, lamp = null }) => ({ file: await fetched(file), lamp })),
        ),
        maskFile: await fileOf(layer.maskFile),
        modeFile: await fileOf(layer.modeFile),
        font: font !== undefined && isFontFile(font) ? await fetched(font) : (font ?? usual.font),
      };
    }),
  );
};
