// Lines of prose in Markdown are as long as .editorconfig says. Tables, code, headings and pictures are not prose.
//   node tests/check_markdown.mjs
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { pages, root } from '../site/pages.mjs';

const most = Number(/\[\*\.md\]\s+max_line_length = (\d+)/.exec(readFileSync(join(root, '.editorconfig'), 'utf8'))[1]);

for (const page of pages()) {
  let inCode = false;
  readFileSync(join(root, page), 'utf8')
    .split('\n')
    .forEach((line, k) => {
      if (/^\s*```/.test(line)) inCode = !inCode;
      if (inCode || /^\s*(\||#|!\[|<!--|```)/.test(line) || line.length <= most) return;
      console.log(`${page}:${k + 1}: ${line.length} letters, at most ${most}`);
      process.exitCode = 1;
    });
}
