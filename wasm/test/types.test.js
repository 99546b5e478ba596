// The declarations in sillon.d.ts: what they allow and refuse, and that the package has what they name. That the sources
// keep to them is checked when they are compiled.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import * as node from 'sillon';
import ts from 'typescript';

import * as browser from '../dist/index.js';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
const declarations = at('../sillon.d.ts');
let engine;

before(async () => {
  engine = await node.createEngine({ threads: 'off' });
});
after(() => engine.dispose());

/** @param options  besides those of strict projects */
function compile(file, options) {
  return ts.createProgram([at(file)], {
    strict: true,
    noEmit: true,
    types: [],
    lib: ['lib.es2022.d.ts', 'lib.dom.d.ts'],
    ...options,
  });
}
const es2022 = ts.ScriptTarget.ES2022;
const bundler = { target: es2022, module: ts.ModuleKind.ESNext, moduleResolution: ts.ModuleResolutionKind.Bundler };
const nodeNext = { target: es2022, module: ts.ModuleKind.NodeNext, moduleResolution: ts.ModuleResolutionKind.NodeNext };

for (const [name, options] of Object.entries({
  'a bundler': bundler,
  Node: nodeNext,
  'exact optional fields': { ...bundler, exactOptionalPropertyTypes: true, noUncheckedIndexedAccess: true },
})) {
  test(`projects for ${name} may do what is right, and nothing that is wrong`, () => {
    const problems = ts.getPreEmitDiagnostics(compile('./types/use.ts', options));
    assert.deepEqual(
      problems.map(({ file, start, messageText }) => {
        const line = file && start !== undefined ? file.getLineAndCharacterOfPosition(start).line + 1 : 0;
        return `${line}: ${ts.flattenDiagnosticMessageText(messageText, ' ')}`;
      }),
      [],
    );
  });
}

/** Names of a module's values, and of an interface's members. */
function declared() {
  const program = compile('../sillon.d.ts', bundler);
  const checker = program.getTypeChecker();
  const symbols = checker.getExportsOfModule(checker.getSymbolAtLocation(program.getSourceFile(declarations)));
  const isValue = (symbol) => (symbol.flags & ts.SymbolFlags.Value) !== 0;
  const membersOf = (name) =>
    checker
      .getDeclaredTypeOfSymbol(symbols.find((symbol) => symbol.name === name))
      .getProperties()
      .map((member) => member.name);
  return { values: symbols.filter(isValue).map((symbol) => symbol.name), membersOf };
}

test('both entries export what is declared, and nothing else', () => {
  const values = declared().values.sort();
  assert.deepEqual(values, ['SillonError', 'createEngine', 'preparePlate']);
  assert.deepEqual(Object.keys(node).sort(), values);
  assert.deepEqual(Object.keys(browser).sort(), values);
});

test('an engine has the declared members, and no others', () => {
  assert.deepEqual(Object.keys(engine).sort(), declared().membersOf('Engine').sort());
  assert.deepEqual(Object.keys(engine.info).sort(), declared().membersOf('EngineInfo').sort());
});

test('sections of projects have the declared fields, and no others', async () => {
  const project = await engine.readProject(
    '{ "sillon": 1, "layers": [{ "kind": "direction" }], "studio": { "version": 1 } }',
  );
  const { membersOf } = declared();
  assert.deepEqual(Object.keys(project).sort(), membersOf('Project').sort());
  assert.deepEqual(Object.keys(project.toolpath).sort(), membersOf('ToolpathParams').sort());
  assert.deepEqual(Object.keys(project.printer).sort(), membersOf('Printer').sort());
  const inFile = membersOf('PrintParams').filter((name) => name !== 'date');
  assert.deepEqual(Object.keys(project.print).sort(), inFile.sort());
});

test('reports and summaries have the declared fields, and no others', async () => {
  const file = { width: 2, height: 1, channels: 1, samples: Uint8Array.of(9, 200) };
  const { toolpath, report } = await engine.generateToolpath({
    shape: { builtin: 'disc', size: [10, 10] },
    layers: [
      { kind: 'picture', pictures: [{ file }] },
      { kind: 'picture', pictures: [{ file }], size: [4, 4] },
    ],
  });
  const { summary } = await engine.writeGcode(toolpath);
  const { membersOf } = declared();
  assert.deepEqual(Object.keys(report).sort(), membersOf('Report').sort());
  assert.deepEqual(Object.keys(summary).sort(), membersOf('GcodeSummary').sort());
  assert.deepEqual(Object.keys(toolpath).sort(), membersOf('Toolpath').sort());
  assert.deepEqual(Object.keys(toolpath.look).sort(), membersOf('Look').sort());
  assert.deepEqual(Object.keys(report.pictures[0]).sort(), membersOf('PictureReport').sort());
  const two = await engine.generateToolpath({
    shape: { builtin: 'disc', size: [10, 10] },
    layers: [{ kind: 'picture', pictures: [{ file }, { file }] }],
  });
  assert.deepEqual(Object.keys(two).sort(), membersOf('ToolpathResult').sort());
  assert.deepEqual(Object.keys(two.conflict).sort(), membersOf('Conflict').sort());
});
