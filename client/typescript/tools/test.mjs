// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Runs the unit tests of the package in whose folder it is called: bundles each of test/ for Node, and
// hands them to node --test. Arguments are conditions of imports: browser.
import { spawnSync } from 'node:child_process';
import { readdirSync, rmSync } from 'node:fs';
import { build } from 'esbuild';

const out = 'build/test';
rmSync(out, { recursive: true, force: true });
const tests = readdirSync('test').filter((name) => name.endsWith('.test.ts'));
await build({
  entryPoints: tests.map((name) => `test/${name}`),
  outdir: out,
  outExtension: { '.js': '.mjs' },
  bundle: true,
  platform: 'node',
  conditions: process.argv.slice(2),
  format: 'esm',
  sourcemap: 'inline',
});
const files = tests.map((name) => `${out}/${name.replace(/\.ts$/, '.mjs')}`);
process.exit(spawnSync('node', ['--enable-source-maps', '--test', ...files],
                       { stdio: 'inherit' }).status ?? 1);
