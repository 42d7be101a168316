// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Which moment of a mission is looked at: live, past, or played. The bar below the map chooses it, and
// says which one it is.
import { Code } from '@connectrpc/connect';
import type { CellRect, Raster } from '@plumescout/client';
import type { MapStatus } from '@plumescout/client/wire';
import { hashOf } from './address.ts';
import { PATIENCE, inWords, sentence, snapshots } from './client.ts';
import type { Trouble } from './client.ts';
import { fill, h } from './dom.ts';
import { MissionClock } from './mission_clock.ts';
import { Watch, fetchMap } from './watch.ts';
import type { LinkState } from './watch.ts';
import { duration, linkWords } from './words.ts';

export type MomentEvents = {
  // Another moment is on its way: what was drawn of the last one does not hold any more.
  leaves(): void;
  // It is looked at from now on, though its map may still come.
  arrived(): void;
  status(status: MapStatus, revision: bigint): void;
  // The map is another one, or cells of it have changed; its status was told before.
  replaced(raster: Raster): void;
  changed(rects: CellRect[]): void;
  pin(revision: bigint): void;
};

export class TimeBar {
  readonly element: HTMLElement;
  readonly linkPill = h('span', { class: 'pill', role: 'status' }, 'connecting');
  playing = false;
  past: bigint | null = null; // the revision that is looked at; null: live
  private head = 0n;
  private when = ''; // that was, after the mission's beginning; in words, if it is known
  readonly clock: MissionClock;

  private readonly slider = h('input', { type: 'range', min: 0, max: 1, value: 1, 'aria-label': 'Revision to look at' });
  private readonly moment = h('span', { class: 'quiet' }, 'live');
  private readonly speed = h('select', { 'aria-label': 'Speed' },
    ...[1, 5, 10, 30, 60].map((times) => h('option', { value: times, selected: times === 10 }, `${times}×`)));
  private readonly playButton = h('button', { onclick: () => this.togglePlay() }, '▶ Play');

  private watch: Watch | null = null;
  private fetching: AbortController | null = null;
  private hasStatus = false;
  private hasMap = false;
  private countdown = 0; // timer, while the stream waits to try again

  // `banner`: where it is said that this is not the present, or what is the matter.
  // `gas`: of which the map is; empty: the first.
  constructor(private readonly mission: string, public gas: string, private readonly banner: HTMLElement,
              private readonly events: MomentEvents) {
    this.clock = new MissionClock((request) => snapshots.getMissionHistory({ mission, ...request }, PATIENCE));
    this.element = h('footer', { class: 'time', 'aria-label': 'Time' }, this.playButton, this.speed, this.slider,
      this.moment, h('button', { onclick: () => events.pin(this.revision) }, 'Pin to compare'),
      h('button', { onclick: () => this.goLive() }, 'Live'));
    this.slider.addEventListener('input', () => this.tellPast(BigInt(this.slider.value)));
    this.slider.addEventListener('change', () => {
      if (BigInt(this.slider.value) >= this.head) this.goLive();
      else void this.goTo(BigInt(this.slider.value));
    });
    this.speed.addEventListener('change', () => {
      if (!this.playing) return;
      this.setPlaying(false);
      this.togglePlay();
    });
  }

  leave(): void {
    this.watch?.stop();
    this.fetching?.abort();
    clearInterval(this.countdown);
  }

  get isLive(): boolean {
    return this.past === null;
  }
  get revision(): bigint {
    return this.past ?? this.head;
  }
  // Of the moment that is looked at.
  get words(): string {
    return this.moment.textContent ?? '';
  }
  // The mission is at least at this revision.
  reached(head: bigint): void {
    if (head > this.head) this.head = head;
    this.slider.max = String(this.head);
    if (this.isLive) this.slider.value = this.slider.max;
  }

  // The same moment, of another gas.
  lookAt(gas: string): void {
    this.gas = gas;
    if (this.isLive) this.goLive();
    else void this.goTo(this.revision);
  }
  get hash(): string {
    return hashOf({ path: this.mission, revision: this.past, gas: this.gas });
  }

  goLive(): void {
    this.fetching?.abort();
    this.past = null;
    this.setPlaying(false);
    this.events.leaves();
    this.startWatch(null);
    this.showMoment();
    this.events.arrived();
    history.replaceState(null, '', this.hash);
  }

  async goTo(revision: bigint): Promise<void> {
    this.watch?.stop();
    this.watch = null;
    this.setPlaying(false);
    this.fetching?.abort();
    const mine = this.fetching = new AbortController();
    this.past = revision;
    this.events.leaves();
    clearInterval(this.countdown);
    [this.linkPill.textContent, this.linkPill.className] = ['looking back', 'pill warn'];
    fill(this.banner, `Making the map of revision ${revision} …`);
    try {
      const { raster, status } = await fetchMap(this.mission, { revision, gas: this.gas }, mine.signal);
      if (mine.signal.aborted) return;
      this.onStatus(status, revision);
      this.onMap(raster);
      this.events.arrived();
      this.showMoment();
      history.replaceState(null, '', this.hash);
    } catch (error) {
      if (mine.signal.aborted) return;
      fill(this.banner, sentence(error), h('button', { onclick: () => void this.goTo(revision) }, 'Try again'), this.backToLive());
    }
  }

  togglePlay(): void {
    if (this.playing) return void this.goTo(this.revision);
    this.fetching?.abort();
    const from = this.past !== null && this.past < this.head ? this.past : 0n;
    this.past = from;
    this.events.leaves();
    this.setPlaying(true);
    this.startWatch({ fromRevision: from, speed: Number(this.speed.value) });
    this.events.arrived();
  }
  private setPlaying(playing: boolean): void {
    this.playing = playing;
    this.playButton.textContent = playing ? '■ Stop' : '▶ Play';
  }

  private startWatch(replay: { fromRevision: bigint; speed: number } | null): void {
    this.watch?.stop();
    this.watch = new Watch(this.mission, {
      replaced: (raster) => this.onMap(raster),
      changed: (rects) => this.events.changed(rects),
      status: (status, revision) => this.onStatus(status, revision),
      link: (state, trouble, again_s) => this.onLink(state, trouble, again_s),
    }, this.gas, replay);
  }

  private onMap(raster: Raster): void {
    this.hasMap = true;
    this.events.replaced(raster);
  }

  private onStatus(status: MapStatus, revision: bigint): void {
    this.hasStatus = true;
    if (this.isLive) {
      this.head = revision;
      this.slider.max = String(revision);
      this.moment.textContent = `live, revision ${revision}`;
    } else {
      this.past = revision;
      this.tellPast(revision);
    }
    this.slider.value = String(revision);
    this.events.status(status, revision);
  }

  private tellPast(revision: bigint): void {
    const show = () => { this.moment.textContent = `revision ${revision} of ${this.head}${this.when}`; };
    if (!this.playing) this.when = ''; // while it is played, that of the frame before stands a moment
    show();
    this.clock.tell(revision, (elapsed_s) => {
      const isShown = this.moment.textContent.startsWith(`revision ${revision} of`);
      if (!isShown && !this.playing) return;
      this.when = elapsed_s === null ? '' : ` · ${duration(Math.round(elapsed_s))} in`;
      if (isShown) show();
    });
  }

  private onLink(state: LinkState, trouble: Trouble | null, again_s: number): void {
    clearInterval(this.countdown);
    const tell = (left_s: number) => {
      [this.linkPill.textContent, this.linkPill.className] = linkWords(state, !this.isLive, left_s);
    };
    this.linkPill.setAttribute('aria-live', state === 'waiting' ? 'off' : 'polite'); // the banner speaks, once
    tell(again_s);
    if (state === 'live') return this.showMoment();
    // What came last stands there until more comes.
    if (this.isLive && this.hasStatus) this.moment.textContent = `revision ${this.head}, the last that came`;
    if (state === 'waiting') {
      const begin_ms = performance.now();
      this.countdown = window.setInterval(() => tell(again_s - (performance.now() - begin_ms) / 1000), 1000);
    }
    if (state === 'waiting' || state === 'ended') {
      fill(this.banner, trouble === null ? 'The stream has ended.' : inWords(trouble),
        state === 'waiting' ? h('button', { onclick: () => this.watch?.retry() }, 'Try now')
          : trouble?.code === Code.Unauthenticated ? h('a', { href: '#/service' }, 'Enter a token')
            : this.gas !== '' && trouble?.code === Code.InvalidArgument
              ? h('a', { href: hashOf({ path: this.mission, revision: null, gas: '' }) }, 'The first gas')
              : h('a', { href: '#/' }, 'All missions'));
    }
  }

  private showMoment(): void {
    if (this.isLive) {
      return fill(this.banner, !this.hasStatus ? 'Waiting for the map …'
        : !this.hasMap ? 'No map yet: no robot has sent a scan.' : null);
    }
    fill(this.banner, this.playing ? 'What was, played' : `As it was at revision ${this.past}`, this.backToLive());
  }
  private backToLive(): HTMLElement {
    return h('button', { onclick: () => this.goLive() }, 'Back to live');
  }
}
