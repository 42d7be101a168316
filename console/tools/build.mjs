// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Makes the pages in dist/: index.html, and script and style with a hash of their content in their
// names. `--watch` is not there on purpose: a build takes less than a second.
import { mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { basename } from 'node:path';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';

const MAX_GZIP_BYTES = 200_000;

rmSync('dist', { recursive: true, force: true });
mkdirSync('dist', { recursive: true });
const result = await build({
  entryPoints: ['src/main.ts', 'src/style.css'],
  outdir: 'dist/assets',
  entryNames: '[name]-[hash]',
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  legalComments: 'linked',
  metafile: true,
});
const outputs = Object.keys(result.metafile.outputs);
const find = (ending) => `/assets/${basename(outputs.find((name) => name.endsWith(ending)))}`;
const page = readFileSync('src/index.html', 'utf8')
  .replace('@script@', find('.js')).replace('@style@', find('.css'));
writeFileSync('dist/index.html', page);
let bytes = gzipSync(page).length;
for (const name of outputs) bytes += gzipSync(readFileSync(name)).length;
console.log(`dist: ${outputs.length + 1} files, ${bytes} bytes gzip`);
if (bytes > MAX_GZIP_BYTES || statSync('dist/index.html').size === 0) {
  console.error(`more than ${MAX_GZIP_BYTES} bytes`);
  process.exit(1);
}
