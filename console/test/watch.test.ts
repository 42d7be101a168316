// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { WatchEvents } from '../src/watch.ts';

// A tab with timers that are run by hand, and a server that is not asked for real.
class Tab extends EventTarget {
  hidden = false;
  readonly timers = new Map<number, { task: () => void; delay_ms: number }>();
  readonly streams: AbortSignal[] = [];
  readonly states: string[] = [];
  refuses = false;
  private lastTimer = 0;

  readonly events: WatchEvents = {
    replaced: () => {}, changed: () => {}, status: () => {},
    link: (state) => { this.states.push(state); },
  };

  setTimeout = (task: () => void, delay_ms: number) => {
    this.timers.set(++this.lastTimer, { task, delay_ms });
    return this.lastTimer;
  };
  clearTimeout = (timer: number) => { this.timers.delete(timer); };

  fetch = (_: unknown, { signal }: { signal: AbortSignal }) => new Promise((_, fail) => {
    this.streams.push(signal);
    if (this.refuses) fail(new TypeError('fetch failed'));
    signal.addEventListener('abort', () => fail(signal.reason));
  });

  get open(): number {
    return this.streams.filter((signal) => !signal.aborted).length;
  }
  async show(visible: boolean): Promise<void> {
    this.hidden = !visible;
    this.dispatchEvent(new Event('visibilitychange'));
    await settle();
  }
  // Runs the timer of this delay.
  async pass(delay_ms: number): Promise<void> {
    const [id, timer] = [...this.timers].find(([, one]) => one.delay_ms === delay_ms)!;
    this.timers.delete(id);
    timer.task();
    await settle();
  }
}

// Until all that does not wait for timers has happened.
async function settle(): Promise<void> {
  for (let i = 0; i < 20; ++i) await new Promise(setImmediate);
}

async function watch(tab: Tab) {
  Object.assign(globalThis, {
    document: tab, window: tab, setTimeout: tab.setTimeout, clearTimeout: tab.clearTimeout, fetch: tab.fetch, location: { origin: 'http://localhost' },
    sessionStorage: { getItem: () => null },
  });
  const { Watch } = await import('../src/watch.ts');
  const made = new Watch('missions/hall', tab.events);
  await settle();
  return made;
}

test('a tab that is opened in the background holds no stream until it is seen', async () => {
  const tab = new Tab();
  tab.hidden = true;
  const made = await watch(tab);
  assert.equal(tab.streams.length, 0);
  assert.deepEqual(tab.states, ['hidden']);
  await tab.show(true);
  assert.equal(tab.open, 1);
  assert.equal(tab.states.at(-1), 'connecting');
  made.stop();
});

test('a hidden tab gives its stream up after a while, and takes it up when it is seen', async () => {
  const tab = new Tab();
  const made = await watch(tab);
  assert.equal(tab.open, 1);
  await tab.show(false);
  assert.equal(tab.open, 1);
  await tab.pass(5000);
  assert.equal(tab.open, 0);
  assert.equal(tab.states.at(-1), 'hidden');
  await tab.show(true);
  assert.equal(tab.open, 1);
  assert.equal(tab.streams.length, 2);
  made.stop();
  await settle();
  assert.equal(tab.open, 0);
});

test('a glance elsewhere costs nothing', async () => {
  const tab = new Tab();
  const made = await watch(tab);
  await tab.show(false);
  await tab.show(true);
  assert.equal(tab.timers.size, 0);
  assert.equal(tab.streams.length, 1);
  made.stop();
});

test('a tab that is hidden while it waits to try again does not try', async () => {
  const tab = new Tab();
  tab.refuses = true;
  const made = await watch(tab);
  assert.equal(tab.states.at(-1), 'waiting');
  await tab.show(false);
  await tab.pass(5000);
  assert.equal(tab.timers.size, 0);
  assert.equal(tab.streams.length, 1);
  assert.equal(tab.states.at(-1), 'hidden');
  tab.refuses = false;
  await tab.show(true);
  assert.equal(tab.streams.length, 2);
  assert.equal(tab.states.at(-1), 'connecting');
  made.stop();
});
