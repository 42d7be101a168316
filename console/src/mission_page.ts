// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// One mission: the map, and beside it robots, reasons, figures and what can be done.
import { Code } from '@connectrpc/connect';
import { PATIENCE, inWords, maps, missions, planning, robots as robotCalls, sentence } from './client.ts';
import type { Trouble } from './client.ts';
import { ChartPanel } from './chart_panel.ts';
import { AreasPanel } from './areas_panel.ts';
import { fill, h, notice } from './dom.ts';
import { MapPanel } from './map_panel.ts';
import type { Place, Scene } from './map_view.ts';
import { missionFigures } from './mission_figures.ts';
import { OperatePanel } from './operate_panel.ts';
import { every, stateClass } from './pages.ts';
import { figuresOf } from '@plumescout/client';
import type { CellRect } from '@plumescout/client';
import { RobotsPanel } from './robots_panel.ts';
import { refreshSession, session } from './session.ts';
import { extendTrail } from './trails.ts';
import { Watch, fetchMap } from './watch.ts';
import type { LinkState } from './watch.ts';
import { MissionState } from '@plumescout/client/wire';
import type { MapStatus, Mission, Plan, Robot } from '@plumescout/client/wire';
import { linkWords, missionState, objectiveWords, phase } from './words.ts';
import { WhyPanel } from './why_panel.ts';

const TABS = ['Robots', 'Why', 'Charts', 'Operate'] as const;
type Tab = (typeof TABS)[number];

export class MissionPage {
  readonly element: HTMLElement;
  readonly head: HTMLElement[];
  private readonly scene: Scene = {
    raster: null, then: null, figures: null, threshold_ppm: 0, status: null, plans: [], why: null, asksWhy: false, candidate: -1,
    trails: new Map(), keepOut: [], draft: null, home: undefined, robot: '', asked: null, sources: [] };
  private readonly panel: MapPanel;
  private readonly robotsPanel: RobotsPanel;
  private readonly why: WhyPanel;
  private readonly charts: ChartPanel;
  private readonly areas: AreasPanel;
  private readonly operate: OperatePanel;
  private readonly statePill = h('span', { class: 'pill' }, '…');
  private readonly objectivePill = h('span');
  private readonly linkPill = h('span', { class: 'pill', role: 'status' }, 'connecting');
  private readonly slider = h('input', { type: 'range', min: 0, max: 1, value: 1, 'aria-label': 'Revision to look at' });
  private readonly moment = h('span', { class: 'quiet' }, 'live');
  private readonly speed = h('select', { 'aria-label': 'Speed' },
    ...[1, 5, 10, 30, 60].map((times) => h('option', { value: times, selected: times === 10 }, `${times}×`)));
  private readonly playButton = h('button', { onclick: () => this.togglePlay() }, '▶ Play');
  private readonly pinButton = h('button', { onclick: () => this.pin() }, 'Pin to compare');
  private readonly tabBar = h('div', { class: 'tabs', role: 'tablist' });
  private readonly tabBox = h('div', { class: 'tab', role: 'tabpanel', tabindex: 0 });

  private watch: Watch | null = null;
  private past: bigint | null = null; // the revision that is looked at; null: live
  private playing = false;
  private fetching: AbortController | null = null;
  private head_revision = 0n;
  private tab: Tab = 'Robots';
  private mission: Mission | null = null;
  private robots: Robot[] = [];
  // The latest plan of each robot with all its candidates; null: not asked for, as nothing shows it.
  private latest: Plan[] | null = null;
  private figuresDue = true;
  private readonly stops: (() => void)[] = [];

  constructor(private readonly name: string, revision: bigint | null) {
    this.head = [this.statePill, this.objectivePill, this.linkPill];
    this.panel = new MapPanel(this.scene, (robot) => this.choose(robot), (place) => this.ask(place), {
      ask: async ({ x_m, y_m }, signal) => this.playing ? null : maps.queryGas(
        { mission: name, points: [{ xM: x_m, yM: y_m }], revision: this.past ?? 0n }, { ...PATIENCE, signal }),
      goesOn: () => this.past === null });
    const colourOf = (robot: string) => this.panel.map.colourOf(robot);
    this.robotsPanel = new RobotsPanel((robot) => this.choose(robot), colourOf);
    this.charts = new ChartPanel(colourOf);
    this.element = h('main', { class: 'mission' },
      this.panel.element,
      h('aside', { class: 'side', 'aria-label': 'Details' }, this.tabBar, this.tabBox),
      h('footer', { class: 'time', 'aria-label': 'Time' }, this.playButton, this.speed, this.slider, this.moment,
        this.pinButton, h('button', { onclick: () => this.goLive() }, 'Live')));
    this.why = new WhyPanel((candidate) => {
      this.scene.candidate = candidate;
      this.panel.map.draw();
    });
    this.areas = new AreasPanel(name, this.panel, (areas) => {
      if (this.past === null) this.scene.keepOut = areas;
      this.panel.map.draw();
    });
    this.operate = new OperatePanel(name, this.areas.element, () => this.scene.raster, () => this.link());
    this.listen();
    this.showTab('Robots');
    fill(this.panel.banner, 'Waiting for the map …');
    if (revision === null || revision === 0n) this.goLive();
    else void this.goTo(revision);
    this.stops.push(every(1000, () => this.poll()));
  }

  leave(): void {
    this.watch?.stop();
    this.fetching?.abort();
    this.panel.leave();
    this.areas.leave();
    this.operate.leave();
    for (const stop of this.stops) stop();
  }

  private link(): string {
    return `${location.origin}/#/${this.name}@${this.past ?? this.head_revision}`;
  }

  // --- Where the map comes from: live, a moment, or a replay.

  private startWatch(replay: { fromRevision: bigint; speed: number } | null): void {
    this.watch?.stop();
    this.watch = new Watch(this.name, {
      replaced: (raster) => {
        this.scene.raster = raster;
        this.figuresDue = true;
        this.refreshFigures();
        this.panel.map.replaced();
        this.panel.showLegend();
        this.showSide();
      },
      changed: (rects) => this.changed(rects),
      status: (status, revision) => this.onStatus(status, revision),
      link: (state, trouble, again_s) => this.onLink(state, trouble, again_s),
    }, replay);
  }

  private changed(rects: CellRect[]): void {
    this.figuresDue = true;
    this.panel.map.cellsChanged(rects);
  }

  private onStatus(status: MapStatus, revision: bigint): void {
    this.scene.status = status;
    this.panel.map.revision = revision;
    this.scene.threshold_ppm = status.gasThresholdPpm;
    this.scene.keepOut = status.keepOut;
    if (this.past === null) {
      this.head_revision = revision;
      this.slider.max = String(revision);
      this.slider.value = String(revision);
      this.moment.textContent = `live, revision ${revision}`;
    } else {
      this.past = revision;
      this.slider.value = String(revision);
      this.moment.textContent = `revision ${revision} of ${this.head_revision}`;
    }
    const [text, look] = objectiveWords(status.objective);
    [this.objectivePill.textContent, this.objectivePill.className] = [text, look];
    this.objectivePill.title = status.objective?.explanation ?? '';
    for (const robot of status.robots) extendTrail(this.scene.trails, robot.robot, robot.pose);
    if (this.scene.robot === '' && status.robots.length > 0) this.choose(status.robots[0].robot);
    this.panel.map.draw();
  }

  private onLink(state: LinkState, trouble: Trouble | null, again_s: number): void {
    [this.linkPill.textContent, this.linkPill.className] = linkWords(state, this.past !== null, again_s);
    if (state === 'live') return this.showPastBanner();
    if (state === 'waiting' || state === 'ended') {
      fill(this.panel.banner, trouble === null ? 'The stream has ended.' : inWords(trouble),
        state === 'waiting' ? h('button', { onclick: () => this.watch?.retry() }, 'Try now')
          : trouble?.code === Code.Unauthenticated ? h('a', { href: '#/service' }, 'Enter a token')
            : h('a', { href: '#/' }, 'All missions'));
    }
  }

  private showPastBanner(): void {
    if (this.past === null) {
      const empty = this.scene.status !== null && this.scene.raster === null;
      return fill(this.panel.banner, empty ? 'No map yet: no robot has sent a scan.' : null);
    }
    fill(this.panel.banner, this.playing ? 'What was, played' : `As it was at revision ${this.past}`,
      h('button', { onclick: () => this.goLive() }, 'Back to live'));
  }

  private goLive(): void {
    this.fetching?.abort();
    this.past = null;
    this.setPlaying(false);
    this.scene.trails.clear();
    this.startWatch(null);
    this.showPastBanner();
    this.panel.hoverAgain();
    if (location.hash.includes('@')) history.replaceState(null, '', `#/${this.name}`);
  }

  private async goTo(revision: bigint): Promise<void> {
    this.watch?.stop();
    this.watch = null;
    this.setPlaying(false);
    this.fetching?.abort();
    const mine = this.fetching = new AbortController();
    this.past = revision;
    this.scene.plans = [];
    this.setLatest(null);
    this.scene.trails.clear();
    [this.linkPill.textContent, this.linkPill.className] = ['looking back', 'pill warn'];
    fill(this.panel.banner, `Making the map of revision ${revision} …`);
    try {
      const { raster, status } = await fetchMap(this.name, revision, mine.signal);
      if (mine.signal.aborted) return;
      this.scene.raster = raster;
      this.onStatus(status, revision);
      this.figuresDue = true;
      this.refreshFigures();
      this.panel.map.replaced();
      this.panel.showLegend();
      this.panel.hoverAgain();
      this.showPastBanner();
      history.replaceState(null, '', `#/${this.name}@${revision}`);
    } catch (error) {
      if (mine.signal.aborted) return;
      fill(this.panel.banner, sentence(error), h('button', { onclick: () => this.goLive() }, 'Back to live'));
    }
  }

  private setPlaying(playing: boolean): void {
    this.playing = playing;
    this.playButton.textContent = playing ? '■ Stop' : '▶ Play';
  }

  private togglePlay(): void {
    if (this.playing) return void this.goTo(this.past ?? this.head_revision);
    this.fetching?.abort();
    const from = this.past !== null && this.past < this.head_revision ? this.past : 0n;
    this.past = from;
    this.scene.plans = [];
    this.setLatest(null);
    this.scene.trails.clear();
    this.setPlaying(true);
    this.startWatch({ fromRevision: from, speed: Number(this.speed.value) });
    this.panel.hoverAgain();
  }

  private pin(): void {
    if (this.scene.raster === null) return;
    this.scene.then = this.scene.raster.copy();
    const revision = this.past ?? this.head_revision;
    this.panel.callChange('Change', `Change of the gas mean since revision ${revision}`);
    notice(`Revision ${revision} is pinned: “Change” shows what the gas mean did since.`);
    this.panel.setCells('change');
  }

  // --- What is polled.

  private async poll(): Promise<void> {
    this.refreshFigures();
    const withLatest = this.showsLatest();
    try {
      if (session.info === null) await refreshSession();
      const [got, listed, live] = await Promise.all([
        missions.getMission({ name: this.name }, PATIENCE),
        robotCalls.listRobots({ mission: this.name }, PATIENCE),
        planning.listPlans({ mission: this.name, withLatest }, PATIENCE)]);
      this.mission = got.mission ?? null;
      this.robots = listed.robots;
      if (this.mission !== null) {
        this.statePill.className = stateClass(this.mission.state);
        this.statePill.textContent = `${missionState(this.mission.state)} · ${phase(this.mission.phase)}`;
        this.scene.home = this.mission.options?.home;
        if (this.mission.revision > this.head_revision) this.head_revision = this.mission.revision;
        this.slider.max = String(this.head_revision);
        if (this.past === null) this.slider.value = this.slider.max;
      }
      if (this.past === null) {
        this.scene.plans = live.plans;
        if (withLatest && this.showsLatest()) this.setLatest(live.latest);
        for (const { title, unit, robot, value } of missionFigures(this.scene, this.robots, live.latest)) {
          this.charts.add(title, unit, robot, value);
        }
      }
    } catch {
      return; // the stream's banner says what is the matter
    }
    this.showSide();
    this.panel.map.draw();
  }

  private showsLatest(): boolean {
    return this.past === null && (this.tab === 'Why' || this.tab === 'Charts');
  }

  private setLatest(plans: Plan[] | null): void {
    this.latest = plans;
    this.scene.why = plans?.find((plan) => plan.robot === this.scene.robot) ?? null;
  }

  // The latest plan of the robot that is looked at, without waiting for the next poll.
  private async latestPlan(): Promise<Plan | null> {
    if (this.latest === null && this.showsLatest()) {
      const { latest } = await planning.listPlans({ mission: this.name, withLatest: true }, PATIENCE);
      if (this.showsLatest()) this.setLatest(latest);
      this.showSide();
      this.panel.map.draw();
    }
    return this.scene.why;
  }

  private refreshFigures(): void {
    if (!this.figuresDue || this.scene.raster === null) return;
    this.figuresDue = false;
    this.scene.figures = figuresOf(this.scene.raster, this.scene.status?.gasThresholdPpm ?? 0);
    this.panel.map.figuresChanged();
    this.panel.showLegend();
  }

  // --- The side.

  private showTab(tab: Tab): void {
    this.tab = tab;
    this.scene.asksWhy = tab === 'Why';
    if (!this.showsLatest()) this.setLatest(null);
    this.panel.map.draw();
    fill(this.tabBar, ...TABS.map((one) => h('button', { role: 'tab', 'aria-selected': String(one === tab),
      onclick: () => this.showTab(one) }, one)));
    fill(this.tabBox, { Robots: this.robotsPanel.element, Why: this.why.element, Charts: this.charts.element,
                        Operate: this.operate.element }[tab]);
    this.showSide();
    if (tab === 'Why') this.latestPlan().catch(() => {}); // the next poll asks again
  }

  private showSide(): void {
    if (this.tab === 'Robots') this.robotsPanel.show(this.mission, this.robots, this.scene);
    if (this.tab === 'Why') {
      this.why.show(this.scene.robot, this.scene.why, this.latest !== null || this.past !== null);
    }
    if (this.tab === 'Charts') this.charts.draw();
    if (this.mission !== null) {
      this.areas.show(this.mission.options?.keepOut ?? [], this.mission.state !== MissionState.FINISHED);
    }
    if (this.tab === 'Operate') this.operate.show(this.mission, this.robots);
  }

  private choose(robot: string): void {
    this.scene.robot = robot;
    this.setLatest(this.latest);
    this.scene.candidate = -1;
    this.why.clear();
    this.scene.asked = null;
    this.showSide();
    this.panel.map.draw();
  }

  private listen(): void {
    this.slider.addEventListener('input', () => { this.moment.textContent = `revision ${this.slider.value}`; });
    this.slider.addEventListener('change', () => {
      if (BigInt(this.slider.value) >= this.head_revision) this.goLive();
      else void this.goTo(BigInt(this.slider.value));
    });
    this.speed.addEventListener('change', () => {
      if (!this.playing) return;
      this.setPlaying(false);
      this.togglePlay();
    });
    const themed = () => this.panel.repaint();
    window.addEventListener('themechange', themed);
    this.stops.push(() => window.removeEventListener('themechange', themed));
  }

  // Why the robot does not go there.
  private ask(place: Place): void {
    this.scene.asked = place;
    this.panel.map.draw();
    this.showTab('Why');
    const pose = this.scene.status?.robots.find((one) => one.robot === this.scene.robot)?.pose;
    void this.why.ask(this.scene.robot, pose, place, () => this.latestPlan());
  }

  // Whether it was a key of ours.
  onKey(key: string, target: HTMLElement): boolean {
    if (key === 'l') {
      this.goLive();
      return true;
    }
    if (key === ' ') {
      if (target.closest('button, summary, a') !== null) return false;
      this.togglePlay();
      return true;
    }
    return this.panel.onKey(key, target);
  }
}
