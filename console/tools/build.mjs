// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Makes the pages in dist/: index.html, and script and style with a hash of their content in their
// names; report.html, all in one, for what plumescout-lab writes; and third-party.json, which packages
// of others both are bundled from, and their licences. `--watch` is not there on purpose: a build takes
// less than a second.
import { mkdirSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { basename } from 'node:path';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';

const MAX_GZIP_BYTES = 200_000;

const OPTIONS = {
  bundle: true, minify: true, format: 'esm', target: 'es2022', legalComments: 'linked', metafile: true };

rmSync('dist', { recursive: true, force: true });
mkdirSync('dist', { recursive: true });
const result = await build({
  ...OPTIONS,
  entryPoints: ['src/main.ts', 'src/style.css'],
  outdir: 'dist/assets',
  entryNames: '[name]-[hash]',
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

// The page of reports, where plumescout-lab writes a mission in place of @mission@.
const parts = await build({
  ...OPTIONS,
  entryPoints: ['src/report.ts', 'src/style.css'],
  outdir: 'dist',
  legalComments: 'inline',
  write: false,
});
const textOf = (ending) => parts.outputFiles.find(({ path }) => path.endsWith(ending)).text.trim();
writeFileSync('dist/report.html', readFileSync('src/report.html', 'utf8')
  .replace('@style@', () => textOf('.css')).replace('@script@', () => textOf('.js')));

// The folder of each package that something was taken from.
const folders = [result, parts]
  .flatMap(({ metafile }) => Object.values(metafile.outputs))
  .flatMap(({ inputs }) => Object.entries(inputs))
  .filter(([, { bytesInOutput }]) => bytesInOutput > 0)
  .map(([path]) => path.match(/^.*node_modules\/(?:@[^/]+\/)?[^/]+/)?.[0])
  .filter((folder) => folder !== undefined);
const thirdParty = [...new Set(folders)].sort().map((folder) => {
  const { name, version, license } = JSON.parse(readFileSync(`${folder}/package.json`, 'utf8'));
  const files = readdirSync(folder).filter((file) => /^(licen[cs]e|notice|copying)/i.test(file)).sort();
  const notice = files.map((file) => readFileSync(`${folder}/${file}`, 'utf8')).join('\n');
  return { name, version, license, notice: notice || `Licence: ${license}` };
});
writeFileSync('dist/third-party.json', JSON.stringify(thirdParty, null, 1));
