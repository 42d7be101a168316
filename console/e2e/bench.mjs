// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// How fast the console is, in Debian's Chromium without a GPU, on the machine that the server runs on.
//
//   node e2e/bench.mjs [--summary FILE] [--scene DIR] [--seconds S]
//
// Needs what run.mjs needs. Prints a figure a line, with its bar if it has one, and ends with 1 if one
// is missed; --summary writes the figures as one flat JSON object. Takes two minutes.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { cpus, loadavg } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { deflateSync, gzipSync } from 'node:zlib';
import { RobotSession, connect } from '@plumescout/client';
import { cleanUp, data, drive, end, launch, serve, until } from './harness.mjs';

const { values: options } = parseArgs({ options: {
  summary: { type: 'string' },
  scene: { type: 'string', default: '../build/scenes/industrial_16x20' },
  seconds: { type: 'string', default: '30' },
} });
const SECONDS = Number(options.seconds);
const PAGES = 16;
const WIDE = 1000; // cells of the large map along either side
const figures = {};
let missed = 0;
// `bar`: what the figure may be at most, or has to be at least; without one it is for information.
const told = (name, value, digits = 1, bar = {}) => {
  figures[name] = Number(value.toFixed(digits));
  const [limit] = Object.values(bar);
  const met = limit === undefined || (bar.atMost === undefined ? value >= limit : value <= limit);
  if (!met) ++missed;
  console.log(`${name.padEnd(40)} ${String(figures[name]).padEnd(8)}` + (limit === undefined ? ''
    : ` ${bar.atMost === undefined ? 'at least' : 'at most'} ${limit}${met ? '' : '  MISSED'}`));
};
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
const quantile = (values, share) => {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? NaN;
};

// --- Just so much of protobuf and gRPC-Web as the calls below need.

function varint(value) {
  const bytes = [];
  for (; value > 127; value = Math.floor(value / 128)) bytes.push(value % 128 + 128);
  return Buffer.from([...bytes, value]);
}
const number = (field, value) => Buffer.concat([varint(field * 8), varint(value)]);
const real = (field, value) => {
  const bytes = Buffer.alloc(8);
  bytes.writeDoubleLE(value);
  return Buffer.concat([varint(field * 8 + 1), bytes]);
};
const part = (field, ...parts) => {
  const bytes = Buffer.concat(parts.map((one) => (typeof one === 'string' ? Buffer.from(one) : one)));
  return Buffer.concat([varint(field * 8 + 2), varint(bytes.length), bytes]);
};

async function call(origin, method, ...parts) {
  const body = Buffer.concat([Buffer.alloc(5), ...parts]);
  body.writeUInt32BE(body.length - 5, 1);
  const response = await fetch(`${origin}/plumescout.v1.${method}`, { method: 'POST', body,
    headers: { 'content-type': 'application/grpc-web+proto', 'x-grpc-web': '1' } });
  assert.equal(response.status, 200);
  return response;
}
async function message(origin, method, ...parts) {
  const bytes = Buffer.from(await (await call(origin, method, ...parts)).arrayBuffer());
  assert.equal(bytes[0], 0, `${method}: ${bytes.subarray(5)}`);
  return bytes.subarray(5, 5 + bytes.readUInt32BE(1));
}

// --- In the page: when which revision came, and when it was drawn.

function observe() {
  const times = window.consoleTimes = { came: [], drawn: [] };
  const revisionOf = (bytes) => { // field 3, a varint; fields of other kinds than that have a length
    let at = 0;
    const next = () => {
      let value = 0, scale = 1;
      for (; bytes[at] > 127; scale *= 128) value += (bytes[at++] - 128) * scale;
      return value + bytes[at++] * scale;
    };
    while (at < bytes.length) {
      const tag = next();
      const value = next();
      if (tag === 24) return value;
      if (tag % 8 === 2) at += value;
    }
    return -1;
  };
  const plain = window.fetch;
  window.fetch = async (input, init) => {
    const response = await plain(input, init);
    if (!String(input.url ?? input).endsWith('/WatchMap') || response.body === null) return response;
    let rest = new Uint8Array(0);
    const watched = response.body.pipeThrough(new TransformStream({ transform(chunk, out) {
      const now = performance.now();
      const all = new Uint8Array(rest.length + chunk.length);
      all.set(rest);
      all.set(chunk, rest.length);
      rest = all;
      while (rest.length >= 5) {
        const size = new DataView(rest.buffer, rest.byteOffset).getUint32(1);
        if (rest.length < 5 + size) break;
        if (rest[0] === 0) times.came.push([revisionOf(rest.subarray(5, 5 + size)), now]);
        rest = rest.subarray(5 + size);
      }
      out.enqueue(chunk);
    } }));
    return new Response(watched, { status: response.status, headers: response.headers });
  };
  document.addEventListener('DOMContentLoaded', () => {
    new MutationObserver((changes) => {
      const now = performance.now();
      for (const { target } of changes) {
        const revision = Number(target.dataset?.revision ?? -1);
        if (revision >= 0) times.drawn.push([revision, now]);
      }
    }).observe(document.body, { attributes: true, attributeFilter: ['data-revision'], subtree: true });
  });
}

// --- The figures.

// Frames at five a second: from the bytes' arrival in the page until they are drawn; and from the
// server's answer that names a revision.
async function latency(page, origin) {
  await page.goto(`${origin}/#/missions/hall`);
  await page.reload();
  await until('a picture', async () => await page.evaluate(() => window.consoleTimes.drawn.length > 0));
  told('first picture, ms', await page.evaluate(() => window.consoleTimes.drawn[0][1]), 0, { atMost: 1000 });
  await wait(3000);
  await page.evaluate(() => { window.consoleTimes.came = []; window.consoleTimes.drawn = []; });
  await message(origin, 'RobotService/RegisterRobot', part(1, 'missions/hall'), part(2, 'bench'), real(3, 0.2));
  const ordered = [];
  const limit = Date.now() + 1000 * SECONDS;
  for (let home = 1; Date.now() < limit; home = 1 - home) {
    const answer = await message(origin, 'RobotService/OrderHome', part(1, 'missions/hall/robots/bench'),
                                 ...(home ? [number(3, 1)] : []));
    let revision = 0, scale = 1, at = 1; // its only field
    for (; answer[at] > 127; scale *= 128) revision += (answer[at++] - 128) * scale;
    ordered.push([revision + answer[at] * scale, Date.now()]);
    await wait(230);
  }
  await wait(1000);
  const { came, drawn, origin_ms } = await page.evaluate(() =>
    ({ ...window.consoleTimes, origin_ms: performance.timeOrigin }));
  const whenDrawn = (revision, from) => drawn.find(([one, at]) => one >= revision && at >= from);
  const latencies = [], skipped = [];
  for (const [revision, at] of came) {
    assert.ok(revision > 0, 'a frame without a revision');
    const done = whenDrawn(revision, at);
    assert.ok(done !== undefined, `revision ${revision} was never drawn`);
    latencies.push(done[1] - at);
    if (done[0] > revision) skipped.push(revision);
  }
  const behind = ordered.map(([revision, at]) => whenDrawn(revision, -Infinity)?.[1] + origin_ms - at);
  told('frames', came.length, 0);
  told('frames a second', came.length / SECONDS);
  told('bytes to pixels, median, ms', quantile(latencies, 0.5), 1, { atMost: 10 });
  told('bytes to pixels, p99, ms', quantile(latencies, 0.99), 1, { atMost: 50 });
  told('drawn with a later frame', skipped.length, 0);
  told('event to pixels, median, ms', quantile(behind, 0.5), 0);
  told('event to pixels, p99, ms', quantile(behind, 0.99), 0);
}

function cpu_s(child) {
  const words = readFileSync(`/proc/${child.pid}/stat`, 'utf8').split(') ')[1].split(' ');
  return (Number(words[11]) + Number(words[12])) / 100;
}

// What sixteen pages cost the server, less what it does anyway: real ones, each of a browser's profile of
// its own, which are all drawn.
async function manyPages(server, browser, origin) {
  const measure = async () => {
    const before = cpu_s(server.child);
    await wait(10_000);
    return (cpu_s(server.child) - before) / 10;
  };
  const alone = await measure();
  const pages = await Promise.all(Array.from({ length: PAGES }, async () => {
    const page = await (await browser.newContext({ viewport: { width: 1280, height: 800 } })).newPage();
    await page.addInitScript(observe);
    await page.goto(`${origin}/#/missions/hall`);
    return page;
  }));
  const drawn = () => Promise.all(pages.map((page) => page.evaluate(() => window.consoleTimes.drawn.length)));
  await until('a picture on each', async () => (await drawn()).every((count) => count > 0));
  await wait(3000);
  const before = await drawn();
  const cores = await measure() - alone;
  const frames = (await drawn()).map((count, i) => (count - before[i]) / 10);
  told('16 pages, cores', cores, 2, { atMost: 0.3 });
  told('frames a second that each draws, mean', mean(frames));
  told('... the fewest', Math.min(...frames));
  assert.ok(Math.min(...frames) > 1, 'a page stands still');
  await Promise.all(pages.map((page) => page.context().close()));
}

// What the charts of sixteen pages cost the server that are opened at once: the figures of the past.
async function manyCharts(server) {
  await wait(2000);
  const before = [Date.now(), cpu_s(server.child)];
  await wait(5000);
  const alone = (cpu_s(server.child) - before[1]) / ((Date.now() - before[0]) / 1000);
  const began = [Date.now(), cpu_s(server.child)];
  const revisions = await Promise.all(Array.from({ length: PAGES }, async () => {
    const client = connect(server.found.calls);
    for (;; await wait(1000)) {
      const { figures, moreFollow } = await client.snapshots.getMissionFigures({ mission: 'missions/hall' });
      if (moreFollow) continue;
      client.close();
      return figures.at(-1).revision;
    }
  }));
  assert.ok(Math.min(...revisions.map(Number)) > 1000, `figures up to ${revisions}`);
  const took_s = (Date.now() - began[0]) / 1000;
  told('charts of 16 pages at once, s', took_s);
  told('... of the server, s of CPU', cpu_s(server.child) - began[1] - alone * took_s);
}

// What a page takes through a front that compresses.
function bundle() {
  const files = readdirSync('dist', { recursive: true }).filter((name) => /\.(js|css)$|^index\.html$/.test(name));
  const bytes = files.reduce((sum, name) => sum + gzipSync(readFileSync(join('dist', name))).length, 0);
  told('pages, kB gzip', bytes / 1000, 0, { atMost: 200 });
}

// A robot walks along the edge of what is known, and reveals as far as it sees, once a second.
async function explore(calls, mission) {
  const robot = await RobotSession.register(connect(calls), { mission: `missions/${mission}`, robotId: 'walker', radius_m: 0.2,
    clock_ns: null, takeOver: true });
  const beams = 720, ranges_m = new Float64Array(beams).fill(Infinity);
  let time_ns = 1_000_000_000_000n, x_m = 10;
  const timer = setInterval(() => {
    for (let k = 0; k < 4; ++k) { // a cell is free once it was seen more than once
      robot.addScan({ time_ns: time_ns += 250_000_000n, pose: { x_m, y_m: 49, yaw_rad: 0 }, ranges_m,
        startAngle_rad: 0, angleStep_rad: 2 * Math.PI / beams, maxRange_m: 15 });
    }
    x_m += 2;
  }, 1000);
  return () => { clearInterval(timer); robot.close(); };
}

// The southern half of it is known.
async function panning(page, origin, calls) {
  const cells = Buffer.alloc(WIDE * WIDE);
  for (let i = 0; i < cells.length / 2; ++i) cells[i] = 1;
  const prior = part(1, part(1, part(1, real(1, 0), real(2, 0)), real(2, 0.1), number(3, WIDE), number(4, WIDE)),
                     part(2, deflateSync(cells)));
  await message(origin, 'MissionService/CreateMission', part(1, 'field'), part(2, part(13, prior)));
  await page.goto(`${origin}/#/missions/field`);
  await until('the large map', async () => await page.evaluate(() =>
    Number(document.querySelector('.stage > canvas')?.dataset.revision ?? -1) >= 0));
  await wait(2000);
  const still = await dragging(page, 180);
  told('panning 1000 x 1000, frames a second', 1000 / mean(still), 1, { atLeast: 30 });
  told('panning, longest frame, ms', Math.max(...still));
  const stop = await explore(calls, 'field');
  await wait(2000);
  const known = () => page.evaluate(() => new Set(window.consoleTimes.drawn.map(([revision]) => revision)).size);
  const before = await known();
  const changing = await dragging(page, 900);
  const seconds = changing.reduce((a, b) => a + b, 0) / 1000;
  const changes = await known() - before;
  stop();
  assert.ok(changes > seconds / 2, `the map changed ${changes} times in ${seconds} s`);
  told('while it changes, frames a second', 1000 / mean(changing), 1, { atLeast: 30 });
  told('while it changes, p99 frame, ms', quantile(changing, 0.99), 1, { atMost: 50 });
  told('while it changes, longest frame, ms', Math.max(...changing));
}

const mean = (values) => values.reduce((a, b) => a + b, 0) / values.length;

// Times between frames while the map is dragged to and fro.
function dragging(page, frames) {
  return page.evaluate((count) => new Promise((done) => {
    const canvas = document.querySelector('.stage > canvas');
    const box = canvas.getBoundingClientRect();
    canvas.setPointerCapture = () => {}; // of a pointer that is there
    const send = (type, x) => canvas.dispatchEvent(new PointerEvent(type, { pointerId: 1, bubbles: true,
      clientX: box.left + x, clientY: box.top + 200 }));
    send('pointerdown', 300);
    const times = [];
    const turn = (now) => {
      times.push(now);
      if (times.length > count) {
        send('pointerup', 300);
        return done(times.slice(1).map((time, i) => time - times[i]));
      }
      send('pointermove', 300 + 100 * Math.sin(times.length / 15));
      requestAnimationFrame(turn);
    };
    requestAnimationFrame(turn);
  }), frames);
}

try {
  console.log(`${cpus()[0].model}, ${cpus().length} cores, load ${loadavg()[0].toFixed(1)}`);
  const server = await serve('127.0.0.1:0', '127.0.0.1:0', '--data', data, '--set', 'maps.publish_period_s=0.2',
                             '--set', 'maps.gas_wait_s=0.2', '--set', 'limits.max_receive_bytes=4194304');
  const origin = `http://${server.found.pages}`;
  await drive(server.found.calls, options.scene, '--known-map', '--duration', '600');
  const browser = await launch();
  const page = await (await browser.newContext({ viewport: { width: 1280, height: 800 } })).newPage();
  await page.addInitScript(observe);
  bundle();
  await latency(page, origin);
  await panning(page, origin, server.found.calls);
  await page.close();
  await manyPages(server, browser, origin);
  await manyCharts(server);
  await end(server.child);
  console.log(missed === 0 ? 'every bar is met' : `${missed} missed`);
  if (missed > 0) process.exitCode = 1;
  if (options.summary) writeFileSync(options.summary, `${JSON.stringify(figures, null, 2)}\n`);
} catch (error) {
  console.error(error.message);
  process.exitCode = 1;
} finally {
  await cleanUp();
}
