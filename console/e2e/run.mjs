// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Clicks through the whole console, in Debian's Chromium, against a server with simulated robots.
//
//   node e2e/run.mjs [--out DIR] [--scene DIR]
//
// Needs dist/ (npm run build) and, in PLUMESCOUT_BIN or ../build/release/bin, plumescout-server and
// plumescout-lab. Pictures of every view are in DIR (../out/console).
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, readdirSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { deflateSync } from 'node:zlib';
import { connect, errorOf } from '@plumescout/client';
import { checkAccess } from './axe.mjs';
import { checkMoves, checkScales, checkSwitches, frontierMark, robotMark } from './effects.mjs';
import { measureTwoGases } from './gases.mjs';
import { BIN, PATIENCE_MS, cleanUp, data, drive, driveToEnd, end, launch, serve, until } from './harness.mjs';
import { readStream, readWhole } from '../test/mcap_file.mjs';
import { lookAround, openSaved } from './report.mjs';

const { values: options } = parseArgs({ options: {
  out: { type: 'string', default: '../out/console' },
  scene: { type: 'string', default: '../build/scenes/industrial_16x20' },
  duration: { type: 'string', default: '600' },
} });
const OUT = resolve(options.out);
const TOKENS = join(data, 'tokens');
const RECORDED = join(data, 'recorded');

let page;
let steps = 0;
async function step(name, task) {
  const began = Date.now();
  try {
    await task();
  } catch (error) {
    await page.screenshot({ path: join(OUT, 'failed.png') }).catch(() => {});
    const said = await page.locator('main').innerText({ timeout: 5000 }).catch(() => '');
    throw new Error(`${name}: ${error.message}\nThe page said:\n${said}`, { cause: error });
  }
  ++steps;
  console.log(`ok  ${name} (${Date.now() - began} ms)`);
}
// Without what passes by itself.
async function picture(name) {
  await page.locator('#notice').evaluate((notice) => { notice.className = notice.textContent = ''; });
  await page.screenshot({ path: join(OUT, `${name}.png`) });
}
const button = (name, exact = true) => page.getByRole('button', { name, exact });
const tab = (name) => page.getByRole('tab', { name, exact: true });
const see = (text) => page.getByText(text).first().waitFor({ timeout: PATIENCE_MS });
const map = () => page.locator('.stage > canvas');
const revision = async () =>
  Number(/revision (\d+)/.exec(await page.locator('.time .quiet').innerText())?.[1] ?? -1);
// Of what takes the server too long it is asked again, as people do.
const seePast = () => until('the map as it was', async () => {
  if (await page.getByText('As it was at revision').first().isVisible()) return true;
  if (await button('Try again').isVisible()) await button('Try again').click();
  return false;
});
const NEAREST = /nearest reading \d+\.\d m away, (just now|.* ago)$/;
const readout = () => page.locator('.readout').innerText();

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
    const help = await page.locator('.field small').allTextContents();
    assert.deepEqual(help.filter((text) => text.trim() === ''), [], 'every option says what it means');
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
    await page.getByLabel('PGM image of a map').setInputFiles(file('a.pgm', 'P5\n', 1 << 20));
    await button('Create mission').click();
    await page.getByRole('alert').getByText(/^The request is 1\S* MiB, and the server takes/).waitFor();
  });
  await step('a file of another format is refused in words', async () => {
    await page.goto(`${origin}/#/new`);
    await page.getByLabel('Name').fill('photo');
    const file = (name, text) => ({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });
    const refuses = async (yaml, pgm, words) => {
      await page.getByLabel('YAML file of a map').setInputFiles(file('a.yaml', yaml));
      await page.getByLabel('PGM image of a map').setInputFiles(file('a.pgm', pgm));
      await button('Create mission').click();
      await page.getByRole('alert').getByText(words).waitFor();
    };
    await refuses('{"image": 7}', 'P5 1 1 255 x', 'names no image');
    await refuses('image: a.pgm\n', '\x89PNG\r\n', 'not a binary PGM');
    await refuses('image: a.pgm\n', 'P5 1 1 255 x', 'options.prior_map.files.yaml'); // in the server's words
    await picture('format');
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
    for (const fact of ['last heard', 'newest sample', 'log applied']) await see(fact);
    await until('a picture', async () => await map().evaluate((canvas) => {
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      return new Set(new Uint32Array(data.buffer)).size > 20;
    }));
  });
  await step('a robot is looked at by its button, and by a click on it', async () => {
    await button('look at: robot-2').click();
    await button('looked at: robot-2').waitFor();
    const colour = await page.locator('.robot', { hasText: 'robot-1' }).locator('.swatch')
      .evaluate((swatch) => getComputedStyle(swatch).backgroundColor);
    await until('robot-1 is looked at', async () => {
      const mark = await robotMark(page, colour);
      if (mark === null) return false;
      await page.mouse.click(...mark);
      if (await button('looked at: robot-1').isVisible()) return true;
      await tab('Robots').click(); // it has moved on meanwhile: that was a click on a place
      return false;
    });
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
    await until('how near and how old', async () => NEAREST.test(await readout()));
    await picture('hover');
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
  await step('nothing of the table is cut, on tablets and on large screens', async () => {
    const size = page.viewportSize();
    for (const width of [1024, 1280, 1600]) {
      await page.setViewportSize({ width, height: 800 });
      const box = page.locator('.scroll', { has: page.locator('.candidates') });
      const [inner, outer] = await box.evaluate((element) => [element.scrollWidth, element.clientWidth]);
      assert.ok(inner <= outer, `${inner} of ${outer} pixels at ${width}`);
      let heights = [];
      await until('rows that no new plan has just replaced', async () => {
        heights = await page.locator('tr.pick').evaluateAll((rows) => rows.map((row) => row.offsetHeight));
        return heights.length > 0 && heights.every((height) => height > 0);
      });
      assert.ok(Math.max(...heights) < 1.5 * Math.min(...heights), `rows of ${heights} pixels at ${width}`);
      await picture(`why_${width}`);
    }
    await page.setViewportSize(size);
  });
  await step('why it does not drive there: a click answers', async () => {
    const box = await map().boundingBox();
    await map().click({ position: { x: box.width / 2, y: box.height / 2 } });
    await see(/straight way there|frontier of \d+ cells|where the robot drives/);
  });
  await step('why it does not drive to a frontier: a click on its mark answers', async () => {
    await until('an answer', async () => { // the mark may have moved on meanwhile
      const mark = await frontierMark(page);
      if (mark === null) return false;
      await page.mouse.click(...mark);
      const answer = page.getByText(/^A (map|gas) frontier of \d+ cells; /);
      return await answer.waitFor({ timeout: 2000 }).then(() => true, () => false);
    });
    await see(/It is (no goal now|candidate|where the robot drives)|It could be a goal/);
    await see(/goals left out/);
    await see(/search ended: /);
  });
}

async function charts() {
  await step('a server that has nothing to spare for the past is not pressed, and asked again when somebody wants it', async () => {
    const call = '**/plumescout.v1.SnapshotService/GetMissionFigures';
    let asked = 0;
    await page.route(call, (route) => {
      ++asked;
      return route.fulfill({ headers: { 'content-type': 'application/grpc-web+proto', 'grpc-status': '9',
                                        'grpc-message': 'this server keeps no journal of its missions' } });
    });
    await tab('Charts').click();
    await see('What was before is not known: this server keeps no journal of its missions');
    await picture('charts_refused');
    assert.equal(asked, 1);
    await page.unroute(call);
    await button('Try again').click();
    await see('Since the mission began.');
  });
  await step('figures are drawn over time', async () => {
    await see('Largest gas mean');
    await see('Since the mission began.');
    await page.locator('.chart', { hasText: /^Completeness/ }).getByText(/^\d\S* %$/).waitFor();
    await page.getByText('What counts', { exact: true }).click();
    await see(/the share of the mapped ground whose gas counts as observed/);
    await picture('charts');
    await page.getByText('What counts', { exact: true }).click();
    await until('two values', async () => !await page.locator('.chart').first().evaluate((chart) =>
      chart.querySelector('canvas').getContext('2d').getImageData(60, 8, 400, 80).data
        .every((value) => value === 0)));
    // What no frame has told yet has no chart: of plans, until one is made while the page looks on.
    for (const title of ['Completeness', 'Open frontiers of the map', 'Known area', 'Largest gas mean',
      'Mean entropy of the gas field', 'Observations', 'CPU time of the latest plan', 'Age of the newest sample',
      /^Plume \(above \S+ ppm\)$/]) {
      await page.locator('.chart strong').getByText(title, { exact: true }).first().waitFor();
    }
  });
}

async function download(name) {
  const [file] = await Promise.all([page.waitForEvent('download'), button(name).click()]);
  return readFileSync(await file.path());
}

async function operation(origin) {
  let known;
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
    await button('All home').click();
    await button('robot-1 goes on').waitFor();
    await button('Not home any more').click();
    await button('Send robot-1 home').waitFor();
  });
  await step('what cannot be undone asks first', async () => {
    await button('Finish …').click();
    await see('This cannot be taken back.');
    await picture('ask');
    await button('Cancel').click();
    await button('Remove robot-1').click();
    await button('Cancel').click();
    await button('Release the lease of robot-1').click();
    await button('Cancel').click();
    assert.equal(await page.locator('dialog').count(), 0);
  });
  await step('maps and missions can be taken away', async () => {
    for (const layer of ['Gas mean (npy)', 'Gas variance (npy)']) {
      assert.equal((await download(layer)).subarray(1, 6).toString(), 'NUMPY');
    }
    const files = new Map();
    const keep = async (file) => files.set(file.suggestedFilename(), readFileSync(await file.path()));
    page.on('download', keep);
    await button('Map (map_server)').click();
    await until('both files', async () => files.size === 2);
    page.off('download', keep);
    assert.deepEqual([...files.keys()].sort(), ['hall.pgm', 'hall.yaml']);
    known = files;
    assert.ok((await download('Whole mission')).length > 1000);
    const { counts } = await readWhole(await download('MCAP (Foxglove)'));
    for (const topic of ['/journal', '/map/gas/mean', '/robots/robot-1/scan']) assert.ok(counts.has(topic), topic);
  });
  await step('a mission is made with the map that another one saved', async () => {
    await page.goto(`${origin}/#/new`);
    await page.getByLabel('Name').fill('known');
    for (const [label, name] of [['YAML file of a map', 'hall.yaml'], ['PGM image of a map', 'hall.pgm']]) {
      await page.getByLabel(label).setInputFiles({ name, mimeType: 'text/plain', buffer: known.get(name) });
    }
    await button('Create mission').click();
    await until('the mission', async () => /#\/missions\/known$/.test(page.url()));
    await see('live, revision');
    await until('free ground', async () => {
      const box = await map().boundingBox();
      for (let i = 1; i < 20; ++i) {
        await page.mouse.move(box.x + box.width * (0.3 + 0.02 * i), box.y + box.height * (0.3 + 0.02 * i));
        if (/ free/.test(await readout())) return true;
      }
      return false;
    });
    await page.goto(`${origin}/#/missions/hall`);
    await see('live, revision');
  });
}

// By the share of the map's width and height.
async function pointTo(x, y) {
  const box = await map().boundingBox();
  await page.mouse.move(box.x + x * box.width, box.y + y * box.height);
}
async function clickAt(x, y) {
  await pointTo(x, y);
  await page.mouse.down();
  await page.mouse.up();
}
const draft = () => page.getByRole('form', { name: 'New keep-out area' });

async function areas() {
  await step('a rectangle is drawn, and robots keep out of it', async () => {
    await tab('Operate').click();
    await see('Robots may drive everywhere.');
    await button('Draw a rectangle').click();
    await draft().waitFor();
    assert.ok(await button('Keep robots out').isDisabled());
    await pointTo(0.72, 0.30);
    await page.mouse.down();
    await pointTo(0.80, 0.42);
    await page.mouse.up();
    await page.getByLabel('Name of the area').fill('spill');
    await picture('draw');
    await button('Keep robots out').click();
    await button('Delete spill').waitFor();
    assert.equal(await draft().count(), 0);
  });
  await step('a polygon is drawn by corners; a name that is taken is refused in words', async () => {
    await button('Draw a polygon').click();
    const corners = [[0.5, 0.55], [0.6, 0.55], [0.55, 0.68], [0.5, 0.55]];
    for (const [x, y] of corners.slice(0, 3)) await clickAt(x, y);
    // The window changes under the drawing: the map stays where it is.
    const size = page.viewportSize();
    const heights = () => map().evaluate((canvas) => [canvas.height, canvas.clientHeight]);
    const [height] = await heights();
    for (const more of [1, 0]) {
      await page.setViewportSize({ width: size.width, height: size.height + more });
      await until('a map of that size', async () => (await heights()).every((now) => now === height + more));
    }
    await clickAt(0.65, 0.6);
    await button('Undo').click();
    for (const [x, y] of corners.slice(3)) await clickAt(x, y);
    await see('Robots will keep out of it:');
    await page.getByLabel('Name of the area').fill('spill');
    await button('Keep robots out').click();
    await draft().getByText('keep-out area "spill"').waitFor();
    await page.getByLabel('Name of the area').fill('ramp');
    await page.getByLabel('Name of the area').press('Enter');
    await button('Delete ramp').waitFor();
    await picture('areas');
  });
  await step('options in force tell of the areas, whose corners were three', async () => {
    await page.getByText('Options in force', { exact: true }).click();
    await until('both areas', async () => {
      const text = await page.locator('details', { hasText: 'Options in force' }).locator('pre').textContent();
      const { keepOut } = JSON.parse(text);
      return keepOut.length === 2 && keepOut.find(({ name }) => name === 'ramp')?.vertices.length === 3;
    });
    if (!await page.locator('details[open] pre').isVisible()) await page.getByText('Options in force', { exact: true }).click();
    await page.locator('details[open] pre').waitFor();
    await page.getByText('Options in force', { exact: true }).click();
  });
  await step('drawing ends with Escape, and touches draw', async () => {
    await button('Draw a polygon').click();
    await clickAt(0.4, 0.4);
    await page.keyboard.press('Escape');
    assert.equal(await draft().count(), 0);
    await button('Draw a rectangle').click();
    await map().evaluate((canvas) => {
      const box = canvas.getBoundingClientRect();
      const touch = (type, x, y) => canvas.dispatchEvent(new PointerEvent(type, { pointerId: 1, pointerType: 'touch',
        isPrimary: true, bubbles: true, clientX: box.left + x * box.width, clientY: box.top + y * box.height }));
      canvas.setPointerCapture = () => {}; // of a finger that is there
      touch('pointerdown', 0.5, 0.5);
      touch('pointermove', 0.55, 0.55);
      touch('pointerup', 0.6, 0.6);
      delete canvas.setPointerCapture;
    });
    await see('Robots will keep out of it:');
    await button('Cancel').click();
    assert.equal(await draft().count(), 0);
  });
  await step('an area is opened again', async () => {
    await button('Delete spill').click();
    await see('Robots may drive through it from then on.');
    await button('Delete').click();
    await until('no spill', async () => await button('Delete spill').count() === 0);
    await button('Delete ramp').waitFor();
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
    await seePast();
    await see(/^revision \d+ of \d+ · .* in$/);
    assert.ok(await revision() < head);
    assert.match(page.url(), /@\d+$/);
    await picture('past');
    await pointTo(0.5, 0.45);
    await until('how near and how old it was', async () => NEAREST.test(await readout()));
    await button('Pin to compare').click();
    await button('Back to live').click();
    await see('live, revision');
    assert.equal(await button('Change').getAttribute('aria-pressed'), 'true');
    await see('Change of the gas mean');
    await picture('change');
  });
  await step('two moments are looked at side by side, and move together', async () => {
    await button('Side by side').click();
    await see(/^then: revision \d+$/);
    await see(/^now: live, revision \d+$/);
    const [then, now] = [page.locator('.pinned > canvas'), map()];
    assert.ok(Math.abs((await then.boundingBox()).width - (await now.boundingBox()).width) < 3);
    await picture('beside_change'); // what was, and what the mean did since
    await button('Gas').click();
    const placeOn = async (canvas) => {
      const box = await canvas.boundingBox();
      await page.mouse.move(box.x + box.width / 2 + 30, box.y + box.height / 2);
      return (await readout()).split(' m · ')[0].split(', ').map(Number);
    };
    // To a pixel or two.
    const isThere = ([x, y], [x2, y2]) => Math.hypot(x - x2, y - y2) < 0.12;
    // Nobody has moved the maps yet, so they are fitted again: beside another legend, to more that is known.
    let before = [NaN, NaN];
    await until('the same place in both', async () => {
      before = await placeOn(then);
      assert.match(await readout(), /then .* · now .*/);
      return isThere(await placeOn(now), before);
    });
    await until('a change where both have gas', async () => {
      const box = await now.boundingBox();
      for (let i = 1; i < 20; ++i) {
        await page.mouse.move(box.x + box.width * (0.2 + 0.03 * i), box.y + box.height * (0.3 + 0.02 * i));
        if (/then \S+ ± \S+ ppm · now \S+ ± \S+ ppm · change \S+ ppm/.test(await readout())) return true;
      }
      return false;
    });
    await picture('beside');
    await placeOn(then);
    const { x, y } = await then.boundingBox(); // what is done to one of them, happens to both
    await page.mouse.down();
    await page.mouse.move(x + 60, y + 300);
    await page.mouse.up();
    await page.mouse.wheel(0, -400);
    const after = await placeOn(then);
    assert.ok(!isThere(after, before), `${after} after ${before}`);
    const besideAfter = await placeOn(now);
    assert.ok(isThere(besideAfter, after), `${besideAfter} beside ${after}`);
    await page.keyboard.press('f');
    await page.keyboard.press('s');
    assert.equal(await then.isVisible(), false);
  });
  await step('what was can be played', async () => {
    await button('▶ Play').click();
    await see('What was, played');
    for (const speed of ['30', '1', '60', '5', '10']) {
      await page.getByLabel('Speed').selectOption(speed);
      const before = await revision();
      await until(`a later frame at ${speed}×`, async () => await revision() > before && before >= 0);
    }
    await button('■ Stop').click();
    await seePast();
    await page.keyboard.press('l');
    await see('live, revision');
  });
  await step('a link leads to the moment', async () => {
    const at = Math.floor(await revision() / 3);
    await page.goto(`${origin}/#/missions/hall@${at}`);
    await see(`As it was at revision ${at}`);
    await tab('Operate').click();
    await button('Link to this moment').click();
    await see('The link to this moment is copied.');
    assert.equal(await page.evaluate(() => navigator.clipboard.readText()), `${origin}/#/missions/hall@${at}`);
    await page.goto(`${origin}/#/missions/hall`);
    await see('live, revision');
  });
  await step('every layer, scale and move does something to the map', async () => {
    await page.goto(`${origin}/#/missions/hall@${await revision()}`); // it stands still
    await seePast();
    await checkScales(page);
    await checkSwitches(page, ['frontiers', 'names', 'keep-out and homes']);
    await checkMoves(page);
    await page.keyboard.press('l');
    await see('live, revision');
  });
}

async function objective(origin, server, browser) {
  await step('how an objective stands is seen on the map', async () => {
    await page.goto(`${origin}/#/new`);
    await page.getByLabel('Name').fill('leak');
    await page.getByText('objective', { exact: true }).click();
    const group = page.locator('details', { has: page.locator('summary', { hasText: /^objective$/ }) }).last();
    await group.getByLabel('kind', { exact: true }).selectOption({ label: 'map above threshold' });
    await group.getByLabel('threshold ppm', { exact: true }).fill('10');
    await button('Create mission').click();
    await see('No robot has registered yet.');
    await driveToEnd(server.found.calls, options.scene, 'leak', '--duration', '40');
    await see(/^objective: \S+ m² undecided$/);
    await button('Objective').click();
    for (const outlook of ['below', 'unmeasured']) await page.locator(`.legend .m-${outlook}`).waitFor();
    await tab('Charts').click();
    await page.locator('.chart', { hasText: /^Undecided area/ }).waitFor();
    await see('Since the mission began.');
    await picture('objective');
    await tab('Operate').click();
    const report = (await download('Report (HTML)')).toString();
    await openSaved(browser, report, OUT, [/^leak, revision \d+$/, 'map where there is more than 10 ppm, 95 % sure', 'still open']);
  });
  await step('a robot is removed, and a mission is finished', async () => {
    await button('Remove robot-1').click();
    await button('Remove').click();
    await until('no robot', async () => await button('Remove robot-1').count() === 0);
    await button('Finish …').click();
    await button('Finish').click();
    await see(/^finished/);
    assert.ok(await button('Pause').isDisabled());
    assert.equal(await button('Draw a polygon').count(), 0);
    await page.goto(`${origin}/#/missions/hall`);
    await see('live, revision');
    assert.equal(await button('Objective').count(), 0);
    await page.keyboard.press('5');
    await see('This mission has no objective');
  });
}

async function gases(origin, server) {
  const client = connect(server.found.calls);
  const robot = await measureTwoGases(client, 'plant');
  await step('of several gases the first is looked at, and the page says so', async () => {
    await page.goto(`${origin}/#/missions/plant`);
    await see('Gas mean of methane, ppm (logarithmic)');
    await see('Plans, gas frontiers and the objective go by methane.');
    await see('largest gas mean of methane');
  });
  await step('another one is chosen: map, figures, files, address', async () => {
    const kept = new URL(page.url()).hash;
    await page.getByLabel('Gas to look at').selectOption('ammonia');
    await see('Gas mean of ammonia, ppm (logarithmic)');
    await see('largest gas mean of ammonia');
    assert.equal(new URL(page.url()).hash, `${kept}?gas=ammonia`);
    const largest = async () => Number((await page.locator('dt', { hasText: 'largest gas mean of ammonia' })
      .locator('+ dd').innerText()).split(' ')[0]);
    await until('ammonia on the map', async () => {
      const ppm = await largest();
      assert.ok(!(ppm >= 10), `${ppm} ppm are of methane`); // none, until ammonia comes
      return ppm > 3;
    });
    await picture('gases');
    const [file] = await Promise.all([page.waitForEvent('download'),
      (async () => { await tab('Operate').click(); await button('Gas mean (npy)').click(); })()]);
    assert.equal(file.suggestedFilename(), 'plant-ammonia-gas-mean.npy');
    const report = (await download('Report (HTML)')).toString();
    assert.match(report, /plant, gas of ammonia, revision \d+/);
    await tab('Why').click();
    await page.locator('.side').getByText('go by methane.').waitFor();
    await tab('Charts').click();
    await page.locator('.chart', { hasText: /^Largest gas mean of ammonia/ }).waitFor();
  });
  await step('a link keeps the gas, and one that the mission does not have is refused with a way on', async () => {
    await page.reload();
    await see('Gas mean of ammonia, ppm (logarithmic)');
    assert.equal(await page.getByLabel('Gas to look at').inputValue(), 'ammonia');
    await page.goto(`${origin}/#/missions/plant?gas=neon`);
    await page.getByRole('link', { name: 'The first gas' }).click();
    await see('Gas mean of methane, ppm (logarithmic)');
  });
  await step('a lease is released once it was asked for, and another client has the robot at once', async () => {
    const takeOver = () => client.robots.registerRobot({ mission: 'missions/plant', robotId: 'sniffer', radiusM: 0.2 });
    await assert.rejects(takeOver, (error) => errorOf(error).reason === 'LEASE_HELD');
    await tab('Operate').click();
    await button('Release the lease of sniffer').click();
    await see('Whoever drives it now is sent away');
    await button('Release').click();
    await see('The lease of sniffer is free.');
    await until('no lease', async () => await button('Release the lease of sniffer').count() === 0);
    await takeOver();
  });
  robot.close();
  client.close();
}

async function service(origin) {
  await step('the service tells of itself', async () => {
    await page.goto(`${origin}/#/service`);
    await see('memory promised to missions');
    await see('in files of the server (SQLite)');
    await see('takes data');
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
    await tab('Why').click();
    await see('goals it could drive to');
    await page.locator('tr.pick').nth(1).hover();
    await picture('why');
    await tab('Operate').click();
    await picture('operate');
    await tab('Charts').click();
    await see('Since the mission began.');
    await new Promise((done) => setTimeout(done, 3000)); // for lines, and for the picture alone
    await picture('charts');
    await button('Uncertainty').click();
    await page.keyboard.press('d');
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

async function everybody(origin) {
  await step('every view, light and dark, is for everybody (axe-core)', async () => {
    for (const theme of ['light', 'dark']) {
      assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), theme);
      for (const [path, sign] of [['', 'Missions'], ['new', 'keep out'], ['service', 'memory promised to missions']]) {
        await page.goto(`${origin}/#/${path}`);
        await see(sign);
        await checkAccess(page, `${path}, ${theme}`);
      }
      await page.goto(`${origin}/#/missions/hall`);
      await see('live, revision');
      for (const name of ['Robots', 'Why', 'Charts', 'Operate']) {
        await tab(name).click();
        await new Promise((done) => setTimeout(done, 500)); // for what the server has to say
        await checkAccess(page, `${name}, ${theme}`);
      }
      await button('Draw a polygon').click();
      await checkAccess(page, `drawing, ${theme}`);
      await page.keyboard.press('Escape');
      await page.keyboard.press('d');
    }
  });
}

async function trouble(origin, server) {
  let again;
  await step('a map that is too large for a page is shown in squares, and the page says so', async () => {
    const client = connect(server.found.calls);
    const [columnCount, rowCount] = [2200, 2000];
    const cells = Buffer.alloc(columnCount * rowCount);
    for (let row = 400; row < 600; ++row) cells.fill(1, row * columnCount + 500, row * columnCount + 900);
    await client.missions.createMission({ missionId: 'wide', options: { occupancy: { maxExtentM: 250, maxCellCount: 6_000_000n }, priorMap: { map: { case: 'cells', value: {
      geometry: { origin: { xM: 0, yM: 0 }, resolutionM: 0.1, columnCount, rowCount }, deflatedData: deflateSync(cells) } } } } });
    client.close();
    await page.goto(`${origin}/#/missions/wide`);
    await see('squares of 2 × 2 cells');
    await picture('wide');
  });
  await step('a browser that does not know the language of the page is told which do', async () => {
    const old = await (await page.context().browser().newContext()).newPage();
    await old.route('**/*.js', (route) => route.fulfill({ contentType: 'text/javascript', body: 'no ?.. such language' }));
    await old.goto(`${origin}/`);
    await old.getByText(/^Nothing comes\? The console needs Chrome/).waitFor({ timeout: PATIENCE_MS });
    await old.context().close();
  });
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
    await see('There is no mission of this name. It may have been deleted.');
    await picture('deleted');
  });
  await step('a server that goes away comes back by itself', async () => {
    await page.goto(`${origin}/#/missions/hall`);
    await see('live, revision');
    // A page whose clock will stand still does not come back by itself, but by Try now.
    const still = await (await page.context().browser().newContext()).newPage();
    await still.clock.install();
    await still.goto(`${origin}/#/missions/hall`);
    const live = (of) => of.locator('.pill.good', { hasText: /^live$/ }).waitFor({ timeout: PATIENCE_MS });
    await live(still);
    await end(server.child, 'SIGKILL');
    const tryNow = still.getByRole('button', { name: 'Try now' });
    await tryNow.waitFor({ timeout: PATIENCE_MS });
    await still.clock.pauseAt(Date.now() + 60_000);
    await see(/connection lost/);
    await page.locator('.side .stale').waitFor();
    await picture('lost');
    again = await serve(server.found.calls, server.found.pages, '--data', data, '--record', RECORDED);
    await live(page);
    assert.equal(await still.locator('.pill.good', { hasText: /^live$/ }).count(), 0);
    await tryNow.click();
    await live(still);
    await still.context().close();
  });
  await step('what servers have recorded of a mission while it ran is read by others (@mcap/core)', async () => {
    const files = () => readdirSync(RECORDED).filter((name) => name.startsWith('hall.')).sort();
    await until('a second recording', async () => files().length === 2);
    await end(again.child);
    const bytes = files().map((name) => readFileSync(join(RECORDED, name)));
    const killed = bytes.map(readStream).filter(({ isWhole }) => !isWhole);
    assert.equal(killed.length, 1, 'the one of the server that was killed has no end');
    assert.ok(killed[0].counts.get('/journal') > 100);
    for (const whole of bytes.filter((file) => readStream(file).isWhole)) {
      const { counts } = await readWhole(whole);
      for (const topic of ['/journal', '/map/occupancy', '/map/gas/stddev']) assert.ok(counts.has(topic), topic);
    }
  });
}

function tokens(...args) {
  const messages = join(BIN, '..', 'python'); // of the wire, of the same build
  return execFileSync('../client/python/plumescoutctl', ['tokens', ...args], {
    encoding: 'utf8', env: { ...process.env, PYTHONPATH: messages } }).trim().split(/\s+/).at(-1);
}

async function useToken(origin, token) {
  await page.goto(`${origin}/#/service`);
  await page.getByLabel(/Token/).fill(token);
  await button('Use').click();
  await see('memory promised to missions');
}

async function access() {
  const secret = Object.fromEntries(['operator', 'viewer'].map((role) =>
    [role, tokens('create', TOKENS, role, '--role', role)]));
  const server = await serve('127.0.0.1:0', '127.0.0.1:0', '--set', `access.tokens_file=${TOKENS}`,
                             '--set', 'access.allow_plaintext=true', '--set', 'store.engine=none');
  const origin = `http://${server.found.pages}`;
  await step('without a token it says where to enter one', async () => {
    await page.goto(`${origin}/#/`);
    await see('Enter a token under Service.');
  });
  await step('viewers look on', async () => {
    await useToken(origin, secret.operator);
    await page.goto(`${origin}/#/new`);
    await page.getByLabel('Name').fill('hall');
    await button('Create mission').click();
    await tab('Operate').click();
    await button('Draw a polygon').waitFor();
    await useToken(origin, secret.viewer);
    await page.goto(`${origin}/#/missions/hall`);
    await tab('Operate').click();
    await see('You look on');
    await see('Robots may drive everywhere.');
    assert.equal(await button('Draw a polygon').count(), 0);
    assert.equal(await button('Pause').count(), 0);
  });
  await step('a token that is revoked while the page is open is told of', async () => {
    await page.locator('.pill.good', { hasText: /^live$/ }).waitFor({ timeout: PATIENCE_MS });
    tokens('revoke', TOKENS, 'viewer');
    await page.getByRole('link', { name: 'Enter a token' }).waitFor({ timeout: PATIENCE_MS });
    await picture('revoked');
    await page.getByRole('link', { name: 'Enter a token' }).click();
    await page.getByLabel(/Token/).fill(secret.operator);
    await button('Use').click();
    await see('memory promised to missions');
    await page.goBack();
    await page.locator('.pill.good', { hasText: /^live$/ }).waitFor({ timeout: PATIENCE_MS });
  });
  await end(server.child);
}

mkdirSync(OUT, { recursive: true });
try {
  const server = await serve('127.0.0.1:0', '127.0.0.1:0', '--data', data, '--record', RECORDED);
  const origin = `http://${server.found.pages}`;
  const browser = await launch();
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 },
    permissions: ['clipboard-read', 'clipboard-write'] });
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
    if (!/^http:\/\/127\.0\.0\.1:/.test(url) && !/^(data|blob):/.test(url)) errors.push(`asks another host: ${url}`);
  });
  await missionsAndForms(origin);
  await drive(server.found.calls, options.scene, '--duration', options.duration);
  await liveMap(origin);
  await reasons();
  await charts();
  await operation(origin);
  await areas();
  await time(origin);
  await objective(origin, server, browser);
  await gases(origin, server);
  await service(origin);
  await pictures(origin);
  await everybody(origin);
  await trouble(origin, server);
  await access();
  await step('a report is looked around in, and printed', () => lookAround(browser, options.scene, OUT));
  assert.deepEqual(errors, []);
  console.log(`${steps} steps; pictures in ${OUT}`);
} catch (error) {
  console.error(error.message);
  process.exitCode = 1;
} finally {
  await cleanUp();
}
