// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What browser tests and benches of the console run: the server, simulated robots, Debian's Chromium.
import assert from 'node:assert/strict';
import { execFile, spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { promisify } from 'node:util';
import { chromium } from 'playwright-core';

export const BIN = resolve(process.env.PLUMESCOUT_BIN ?? '../build/release/bin');
export const PATIENCE_MS = Number(process.env.PATIENCE_MS ?? 90_000);
export const data = mkdtempSync(join(tmpdir(), 'plumescout-console-'));
const children = new Set();
let browser = null;

// Starts a program; resolves with what `wanted` finds in its output.
export function start(program, args, wanted) {
  const child = spawn(join(BIN, program), args, { stdio: ['ignore', 'pipe', 'pipe'] });
  children.add(child);
  child.on('exit', () => children.delete(child));
  let text = '';
  return new Promise((done, fail) => {
    const hear = (part) => {
      text += part;
      const found = wanted(text);
      if (found) done({ child, found });
    };
    child.stdout.on('data', hear);
    child.stderr.on('data', hear);
    child.on('exit', (code) => fail(new Error(`${program} ended with ${code}:\n${text}`)));
  });
}

export function end(child, signal = 'SIGTERM') {
  return new Promise((done) => {
    if (child.exitCode !== null || child.signalCode !== null) return done();
    child.on('exit', done);
    child.kill(signal);
  });
}

// Resolves with the process and `found`: where it takes calls, and where its pages are.
export const serve = (listen, http, ...more) => start('plumescout-server',
  ['--listen', listen, '--http', http, '--http-root', resolve('dist'), '--set', 'observe.http_listen=', ...more],
  (text) => {
    const calls = /listening on (\S+)/.exec(text)?.[1], pages = /console on (\S+)/.exec(text)?.[1];
    return calls && pages ? { calls, pages } : null;
  });

export const drive = (server, scene, ...more) => start('plumescout-lab',
  ['robot', '--server', server, '--scene', resolve(scene), '--out', join(data, 'robot'), '--mission', 'hall',
   '--robots', '2', '--realtime', ...more],
  (text) => /simulated/.test(text));

// Drives a robot in lockstep to the end, in a mission of that name.
export function driveToEnd(server, scene, mission, ...more) {
  return promisify(execFile)(join(BIN, 'plumescout-lab'), ['robot', '--server', server, '--scene', resolve(scene),
    '--out', join(data, mission), '--mission', mission, ...more]);
}

export async function launch() {
  browser = await chromium.launch({ executablePath: '/usr/bin/chromium', headless: true, args: [
    '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
    '--disable-background-networking', '--disable-component-update', '--disable-sync'] });
  return browser;
}

// Until it holds.
export async function until(what, holds) {
  const limit = Date.now() + PATIENCE_MS;
  while (!await holds()) {
    assert.ok(Date.now() < limit, `${what} did not come about`);
    await new Promise((done) => setTimeout(done, 50));
  }
}

export async function cleanUp() {
  await browser?.close();
  await Promise.all([...children].map((child) => end(child, 'SIGKILL')));
  rmSync(data, { recursive: true, force: true });
}
