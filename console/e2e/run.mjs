// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Clicks through the whole console, in Debian's Chromium, against a server with simulated robots.
//
//   node e2e/run.mjs [--out DIR] [--scene DIR]
//
// Needs dist/ (npm run build) and, in PLUMESCOUT_BIN or ../build/release/bin, plumescout-server and
// plumescout-lab. Pictures of every view are in DIR (../out/console).
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { chromium } from 'playwright-core';

const { values: options } = parseArgs({ options: {
  out: { type: 'string', default: '../out/console' },
  scene: { type: 'string', default: '../build/scenes/industrial_16x20' },
  duration: { type: 'string', default: '600' },
} });
const BIN = resolve(process.env.PLUMESCOUT_BIN ?? '../build/release/bin');
const OUT = resolve(options.out);
const PATIENCE_MS = Number(process.env.PATIENCE_MS ?? 30_000);
const data = mkdtempSync(join(tmpdir(), 'plumescout-console-'));
const children = new Set();

// Starts a program; resolves with what `wanted` finds in its output.
function start(program, args, wanted) {
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

function end(child, signal = 'SIGTERM') {
  return new Promise((done) => {
    if (child.exitCode !== null || child.signalCode !== null) return done();
    child.on('exit', done);
    child.kill(signal);
  });
}

const serve = (listen, http) => start('plumescout-server',
  ['--listen', listen, '--http', http, '--http-root', resolve('dist'), '--data', data,
   '--set', 'observe.http_listen='],
  (text) => {
    const calls = /listening on (\S+)/.exec(text)?.[1], pages = /console on (\S+)/.exec(text)?.[1];
    return calls && pages ? { calls, pages } : null;
  });
const drive = (server, ...more) => start('plumescout-lab',
  ['robot', '--server', server, '--scene', resolve(options.scene), '--out', join(data, 'robot'),
   '--mission', 'hall', '--robots', '2', '--realtime', '--duration', options.duration, ...more],
  (text) => /simulated/.test(text));

let page;
let steps = 0;
async function step(name, task) {
  const began = Date.now();
  try {
    await task();
  } catch (error) {
    await page.screenshot({ path: join(OUT, 'failed.png') }).catch(() => {});
    throw new Error(`${name}: ${error.message}`, { cause: error });
  }
  ++steps;
  console.log(`ok  ${name} (${Date.now() - began} ms)`);
}
const picture = (name) => page.screenshot({ path: join(OUT, `${name}.png`) });
const button = (name, exact = true) => page.getByRole('button', { name, exact });
const tab = (name) => page.getByRole('tab', { name, exact: true });
const see = (text) => page.getByText(text).first().waitFor({ timeout: PATIENCE_MS });
const map = () => page.locator('.stage > canvas');
const revision = async () =>
  Number(/revision (\d+)/.exec(await page.locator('.time .quiet').innerText())?.[1] ?? -1);
const readout = () => page.locator('.readout').innerText();

// Until it holds.
async function until(what, holds) {
  const limit = Date.now() + PATIENCE_MS;
  while (!await holds()) {
    assert.ok(Date.now() < limit, `${what} did not come about`);
    await new Promise((done) => setTimeout(done, 50));
  }
}

async function missionsAndForms(origin) {
  await step('without missions it says what to do', async () => {
    await page.goto(`${origin}/`);
    await see('No mission yet.');
    await picture('empty');
  });
  await step('a mission is made; what is wrong is said', async () => {
    await page.getByRole('link', { name: 'New mission' }).first().click();
    await page.getByLabel('Name').fill('annex');
    await page.getByLabel('keep out').fill('1,1 3,1 3,x');
    await button('Create mission').click();
    await see('is not x,y in metres');
    await page.getByLabel('keep out').fill('1,1 3,1 3,2 1,2');
    await page.getByLabel('home', { exact: true }).fill('0.5,0.5');
    await page.getByText('planning', { exact: true }).click();
    await page.getByLabel('strategy', { exact: true }).selectOption('xit_gff');
    await picture('new');
    await button('Create mission').click();
    await see('No robot has registered yet.');
    assert.match(page.url(), /#\/missions\/annex$/);
  });
  await step('a map that is larger than the server takes is not sent', async () => {
    await page.goto(`${origin}/#/new`);
    await page.getByLabel('Name').fill('large');
    const file = (name, text, size) => ({ name, mimeType: 'text/plain', buffer: Buffer.alloc(size, text) });
    const yaml = 'image: a.pgm\n';
    await page.getByLabel('YAML file of a map').setInputFiles(file('a.yaml', yaml, yaml.length));
    await page.getByLabel('PGM image of a map').setInputFiles(file('a.pgm', 'x', 1 << 20));
    await until('the refusal', async () => { // once both files are read
      await button('Create mission').click();
      return await page.getByRole('alert').getByText(/^The request is 1\S* MiB, and the server takes/).count() > 0;
    });
  });
  await step('a name that is taken is refused in words', async () => {
    await page.goto(`${origin}/#/new`);
    await page.getByLabel('Name').fill('annex');
    await button('Create mission').click();
    await page.getByRole('alert').waitFor({ timeout: PATIENCE_MS });
  });
}

async function liveMap(origin) {
  await step('the map comes alive', async () => {
    await page.goto(`${origin}/#/`);
    await page.getByRole('link', { name: 'hall', exact: true }).click();
    await see('live, revision');
    const before = await revision();
    await until('a newer revision', async () => await revision() > before);
    await see('streaming');
    await see('robot-2');
    await until('a picture', async () => await map().evaluate((canvas) => {
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      return new Set(new Uint32Array(data.buffer)).size > 20;
    }));
  });
  await step('cells tell what they hold', async () => {
    const box = await map().boundingBox();
    await until('a reading', async () => {
      for (let i = 1; i < 20; ++i) {
        await page.mouse.move(box.x + box.width * (0.2 + 0.03 * i), box.y + box.height * (0.2 + 0.03 * i));
        if (/free\s+·\s+\S+ ± \S+ ppm/.test(await readout())) return true;
      }
      return false;
    });
  });
  await step('layers, scale and view follow buttons and keys', async () => {
    for (const name of ['Uncertainty', 'Walls', 'Gas']) {
      await button(name).click();
      assert.equal(await button(name).getAttribute('aria-pressed'), 'true');
    }
    await button('Log').click();
    assert.equal(await button('Log').getAttribute('aria-pressed'), 'false');
    await page.keyboard.press('g');
    assert.equal(await button('Log').getAttribute('aria-pressed'), 'true');
    await page.getByText('Layers', { exact: true }).click();
    for (const box of await page.locator('.tools input[type=checkbox]').all()) {
      await box.uncheck();
      await box.check();
    }
    await page.getByText('Layers', { exact: true }).click();
    for (const name of ['Zoom in', 'Zoom out', 'Follow', 'Fit']) await button(name).click();
    await map().focus();
    for (const key of ['ArrowLeft', '+', '-', 'c', 'f']) await page.keyboard.press(key);
    await page.mouse.wheel(0, -200);
    await page.keyboard.press('f');
    await page.keyboard.press('?');
    await see('show all of the map');
    await button('Close').click();
  });
}

async function reasons() {
  await step('why it drives there: all candidates with their terms', async () => {
    await tab('Why').click();
    await see('goals it could drive to');
    assert.ok(await page.locator('tr.pick').count() > 0);
    assert.equal(await page.locator('tr.chosen').count(), 1);
    await page.locator('tr.pick').nth(1).hover();
    await picture('why');
  });
  await step('why it does not drive there: a click answers', async () => {
    const box = await map().boundingBox();
    await map().click({ position: { x: box.width / 2, y: box.height / 2 } });
    await see(/straight way there|frontier of \d+ cells|where the robot drives/);
  });
}

async function charts() {
  await step('figures are drawn over time', async () => {
    await tab('Charts').click();
    await see('Largest gas mean');
    await until('two values', async () => !await page.locator('.chart').first().evaluate((chart) =>
      chart.querySelector('canvas').getContext('2d').getImageData(60, 8, 400, 80).data
        .every((value) => value === 0)));
    assert.ok(await page.locator('.chart canvas').count() >= 5);
  });
}

async function download(name) {
  const [file] = await Promise.all([page.waitForEvent('download'), button(name).click()]);
  return readFileSync(await file.path());
}

async function operation() {
  await step('a mission pauses and goes on', async () => {
    await tab('Operate').click();
    await button('Pause').click();
    await see(/^paused/);
    await button('Resume').click();
    await see(/^running/);
  });
  await step('robots are sent home and sent on', async () => {
    await button('Send robot-2 home').click();
    await button('robot-2 goes on').click();
    await button('Send robot-2 home').waitFor();
  });
  await step('what cannot be undone asks first', async () => {
    await button('Finish …').click();
    await see('This cannot be taken back.');
    await picture('ask');
    await button('Cancel').click();
    await button('Remove robot-1').click();
    await button('Cancel').click();
    assert.equal(await page.locator('dialog').count(), 0);
  });
  await step('maps and missions can be taken away', async () => {
    const npy = await download('Gas mean (npy)');
    assert.equal(npy.subarray(1, 6).toString(), 'NUMPY');
    const files = [];
    page.on('download', (file) => files.push(file.suggestedFilename()));
    await button('Map (map_server)').click();
    await until('both files', async () => files.length === 2);
    assert.deepEqual(files.sort(), ['hall.pgm', 'hall.yaml']);
    assert.ok((await download('Whole mission')).length > 1000);
  });
}

async function time(origin) {
  await step('what was can be looked at and compared', async () => {
    const head = await revision();
    const slider = page.getByLabel('Revision to look at');
    await slider.evaluate((input) => {
      input.value = String(Math.floor(Number(input.max) / 2));
      input.dispatchEvent(new Event('input'));
      input.dispatchEvent(new Event('change'));
    });
    await see('As it was at revision');
    assert.ok(await revision() < head);
    assert.match(page.url(), /@\d+$/);
    await picture('past');
    await button('Pin to compare').click();
    await button('Back to live').click();
    await see('live, revision');
    assert.equal(await button('Change').getAttribute('aria-pressed'), 'true');
    await see('Change of the gas mean');
    await picture('change');
    await button('Gas').click();
  });
  await step('what was can be played', async () => {
    await page.getByLabel('Speed').selectOption('30');
    await button('▶ Play').click();
    await see('What was, played');
    const before = await revision();
    await until('a later frame', async () => await revision() > before && before >= 0);
    await button('■ Stop').click();
    await see('As it was at revision');
    await page.keyboard.press('l');
    await see('live, revision');
  });
  await step('a link leads to the moment', async () => {
    const at = Math.floor(await revision() / 3);
    await page.goto(`${origin}/#/missions/hall@${at}`);
    await see(`As it was at revision ${at}`);
    await page.goto(`${origin}/#/missions/hall`);
    await see('live, revision');
  });
}

async function service(origin) {
  await step('the service tells of itself', async () => {
    await page.goto(`${origin}/#/service`);
    await see('memory promised to missions');
    await picture('service');
    await page.getByLabel(/Token/).fill('wrong');
    await button('Use').click();
    await page.getByRole('alert').waitFor({ timeout: PATIENCE_MS });
    await page.getByLabel(/Token/).fill('');
    await button('Use').click();
    await see('memory promised to missions');
  });
}

async function pictures(origin) {
  await step('pictures: list, map, dark, tablet', async () => {
    await page.goto(`${origin}/#/`);
    await page.getByRole('link', { name: 'hall', exact: true }).waitFor();
    await picture('missions');
    await page.goto(`${origin}/#/missions/hall`);
    await see('live, revision');
    await see('streaming');
    await until('a way', async () => await page.evaluate(() => document.fonts.status === 'loaded'));
    await new Promise((done) => setTimeout(done, 4000)); // for trails, and for the picture alone
    await picture('map');
    await button('Uncertainty').click();
    await page.keyboard.press('d');
    await tab('Charts').click();
    await new Promise((done) => setTimeout(done, 1500));
    await picture('dark');
    await page.keyboard.press('d');
    await page.setViewportSize({ width: 800, height: 1100 });
    await button('Gas').click();
    await tab('Operate').click();
    await new Promise((done) => setTimeout(done, 500));
    await picture('tablet');
    await page.setViewportSize({ width: 1280, height: 800 });
  });
}

async function trouble(origin, server) {
  await step('a mission that is deleted while it is open says so', async () => {
    await page.goto(`${origin}/#/missions/annex`);
    await see('No robot has registered yet.');
    const other = await page.context().newPage();
    await other.goto(`${origin}/#/`);
    await other.getByRole('button', { name: 'Delete annex' }).click();
    await other.getByRole('button', { name: 'Delete', exact: true }).last().click();
    await other.getByText('annex is deleted.').waitFor();
    await other.close();
    await page.getByRole('link', { name: 'All missions' }).waitFor({ timeout: PATIENCE_MS });
    await picture('deleted');
  });
  await step('a server that goes away comes back by itself', async () => {
    await page.goto(`${origin}/#/missions/hall`);
    await see('live, revision');
    await end(server.child, 'SIGKILL');
    await see(/connection lost/);
    await picture('lost');
    const again = await serve(server.found.calls, server.found.pages);
    await page.locator('.pill.good', { hasText: /^live$/ }).waitFor({ timeout: PATIENCE_MS });
    return again;
  });
}

mkdirSync(OUT, { recursive: true });
let browser;
try {
  const server = await serve('127.0.0.1:0', '127.0.0.1:0');
  const origin = `http://${server.found.pages}`;
  browser = await chromium.launch({ executablePath: '/usr/bin/chromium', headless: true, args: [
    '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
    '--disable-background-networking', '--disable-component-update', '--disable-sync'] });
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  page = await context.newPage();
  page.setDefaultTimeout(PATIENCE_MS);
  const errors = [];
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('console', (message) => {
    // Chromium itself tells of connections that fail.
    if (message.type() === 'error' && !/Failed to load resource/.test(message.text())) {
      errors.push(message.text());
    }
  });
  page.on('request', (request) => {
    const url = request.url();
    if (!url.startsWith(origin) && !/^(data|blob):/.test(url)) errors.push(`asks another host: ${url}`);
  });
  await missionsAndForms(origin);
  await drive(server.found.calls);
  await liveMap(origin);
  await reasons();
  await charts();
  await operation();
  await time(origin);
  await service(origin);
  await pictures(origin);
  await trouble(origin, server);
  assert.deepEqual(errors, []);
  console.log(`${steps} steps; pictures in ${OUT}`);
} catch (error) {
  console.error(error.message);
  process.exitCode = 1;
} finally {
  await browser?.close();
  await Promise.all([...children].map((child) => end(child, 'SIGKILL')));
  rmSync(data, { recursive: true, force: true });
}
