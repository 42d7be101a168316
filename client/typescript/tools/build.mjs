// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Makes what is published, from src: dist/, modules with their types, and the licence beside it.
import { spawnSync } from 'node:child_process';
import { copyFileSync, rmSync } from 'node:fs';

rmSync('dist', { recursive: true, force: true });
const { status } = spawnSync('../../node_modules/.bin/tsc', ['-p', '.'], { stdio: 'inherit' });
if (status !== 0) process.exit(status ?? 1);
copyFileSync('../../LICENSE', 'LICENSE');
