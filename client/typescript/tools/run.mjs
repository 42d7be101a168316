// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Runs a program in TypeScript, with the arguments that follow it. It finds the package as others do,
// so dist/ must be there.
//
//   node tools/run.mjs PROGRAM.ts [ARGUMENT ...]
import { basename } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';

const [program, ...more] = process.argv.slice(2);
const outfile = fileURLToPath(new URL(`../build/run/${basename(program, '.ts')}-${process.pid}.mjs`, import.meta.url));
await build({ entryPoints: [program], outfile, bundle: true, platform: 'node', format: 'esm', packages: 'external' });
process.argv = [process.argv[0], program, ...more];
await import(pathToFileURL(outfile).href);
