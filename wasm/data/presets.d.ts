import type { Preset, ToolpathParams } from '../sillon.js';

/** Named sets of toolpath parameters: what each changes from the defaults. As `toolpath.preset` of a project names them. */
declare const table: { version: 1; presets: Record<Preset, Partial<ToolpathParams>> };
export default table;
