// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// One mission: the map, and beside it robots, reasons, figures and what can be done.
import { PATIENCE, maps, missions, planning, robots as robotCalls, sentence, snapshots } from './client.ts';
import { ChartPanel } from './chart_panel.ts';
import { Comparison } from './comparison.ts';
import { hashOf } from './address.ts';
import { AreasPanel } from './areas_panel.ts';
import { fill, h, refill, tabOfKey } from './dom.ts';
import { MapPanel } from './map_panel.ts';
import type { Place, Scene } from './scene.ts';
import { figuresThen, missionFigures } from './mission_figures.ts';
import { pastFigures } from './past_figures.ts';
import { OperatePanel } from './operate_panel.ts';
import { every, stateClass } from './pages.ts';
import { isFirst, ofPlans } from './gases.ts';
import { MOST_PLACES } from './objective_layer.ts';
import { figuresOf } from '@plumescout/client';
import { reportOf } from './report_file.ts';
import { RobotsPanel, homesOf } from './robots_panel.ts';
import { refreshSession, session } from './session.ts';
import { TimeBar } from './time_bar.ts';
import type { MomentEvents } from './time_bar.ts';
import { extendTrail } from './trails.ts';
import { MissionState } from '@plumescout/client/wire';
import type { MapStatus, Mission, Plan, QueryGasResponse, Robot } from '@plumescout/client/wire';
import { missionState, noPlanWords, objectiveWords, phase } from './words.ts';
import { WhyPanel } from './why_panel.ts';

const TABS = ['Robots', 'Why', 'Charts', 'Operate'] as const;
type Tab = (typeof TABS)[number];

export class MissionPage {
  readonly element: HTMLElement;
  readonly head: HTMLElement[];
  private readonly scene: Scene = {
    raster: null, then: null, figures: null, threshold_ppm: 0, status: null, plans: [], why: null, asksWhy: false, candidate: -1,
    trails: new Map(), keepOut: [], draft: null, beside: null, homes: [], gases: { names: [], looked: '' }, robot: '', asked: null, sources: [], judged: [] };
  private readonly panel: MapPanel;
  private readonly time: TimeBar;
  private readonly comparison: Comparison;
  private readonly robotsPanel: RobotsPanel;
  private readonly why: WhyPanel;
  private readonly charts: ChartPanel;
  private readonly areas: AreasPanel;
  private readonly operate: OperatePanel;
  private readonly statePill = h('span', { class: 'pill' }, '…');
  private readonly objectivePill = h('span');
  private readonly tabBar = h('div', { class: 'tabs', role: 'tablist',
    onkeydown: (event: KeyboardEvent) => this.onTabKey(event) });
  private readonly tabBox = h('div', { class: 'tab', role: 'tabpanel', tabindex: 0 });

  private tab: Tab = 'Robots';
  private mission: Mission | null = null;
  private robots: Robot[] = [];
  // The latest plan of each robot with all its candidates; null: not asked for, as nothing shows it.
  private latest: Plan[] | null = null;
  private answers = true; // the server, when it was last asked
  private figuresDue = true;
  private chartsPast: AbortController | null = null; // while they are asked for, and after
  private readonly opened_s = performance.now() / 1000;
  private readonly stops: (() => void)[] = [];

  constructor(private readonly name: string, revision: bigint | null, gas: string) {
    this.panel = new MapPanel(this.scene, (robot) => this.choose(robot), (place) => this.ask(place), {
      ask: (place, signal) => this.askGas([place], signal, false), goesOn: () => this.time.isLive }, {
      ask: (places, signal) => this.askGas(places, signal, true),
      goesOn: () => this.time.isLive,
      asked: () => this.mission?.options?.objective,
      mostPlaces: MOST_PLACES });
    this.panel.onGas = (chosen) => this.lookAt(chosen);
    this.time = new TimeBar(name, gas, this.panel.banner, this.momentEvents());
    this.scene.gases.looked = gas;
    this.head = [this.statePill, this.objectivePill, this.time.linkPill];
    this.comparison = new Comparison(this.scene, this.panel);
    const colourOf = (robot: string) => this.panel.map.colourOf(robot);
    this.robotsPanel = new RobotsPanel((robot) => this.choose(robot), colourOf);
    this.charts = new ChartPanel(colourOf);
    this.element = h('main', { class: 'mission' },
      this.panel.element,
      h('aside', { class: 'side', 'aria-label': 'Details' }, this.tabBar, this.tabBox),
      this.time.element);
    this.why = new WhyPanel((candidate) => {
      this.scene.candidate = candidate;
      this.panel.map.draw();
    });
    this.areas = new AreasPanel(name, this.panel, (areas) => {
      if (this.time.isLive) this.scene.keepOut = areas;
      this.panel.map.draw();
    });
    this.operate = new OperatePanel(name, this.areas.element, () => this.scene.raster, () => ({ revision: this.time.past ?? 0n, gas: this.time.gas }),
      () => this.link(), () => this.report());
    this.listen();
    this.showTab('Robots');
    if (revision === null || revision === 0n) this.time.goLive();
    else void this.time.goTo(revision);
    this.stops.push(every(1000, () => this.poll()));
  }

  leave(): void {
    this.time.leave();
    this.panel.leave();
    this.areas.leave();
    this.operate.leave();
    this.chartsPast?.abort();
    for (const stop of this.stops) stop();
  }

  // Null while the past is played: there is no one moment then.
  private async askGas(places: Place[], signal: AbortSignal, withVerdicts: boolean): Promise<QueryGasResponse | null> {
    if (this.time.playing) return null;
    return maps.queryGas({ mission: this.name, points: places.map(({ x_m, y_m }) => ({ xM: x_m, yM: y_m })), withVerdicts,
                           revision: this.time.past ?? 0n,
                           species: withVerdicts ? '' : this.time.gas }, { ...PATIENCE, signal });
  }

  private async report(): Promise<string> {
    const { mission, scene: { raster, trails, gases, homes } } = this;
    if (mission === null || raster === null) throw new Error('there is no map yet');
    return reportOf({ mission, raster, trails, gases, homes, revision: this.time.past ?? 0n });
  }

  private link(): string {
    return `${location.origin}/${hashOf({ path: this.name, revision: this.time.revision, gas: this.time.gas })}`;
  }

  // --- What is looked at.

  private momentEvents(): MomentEvents {
    return {
      leaves: () => {
        this.scene.trails.clear();
        this.scene.asked = null;
        this.why.clear();
        if (this.time.isLive) return;
        this.scene.plans = [];
        this.setLatest(null);
      },
      arrived: () => this.panel.anotherMoment(),
      status: (status, revision) => this.onStatus(status, revision),
      replaced: (raster) => {
        this.scene.raster = raster;
        this.figuresDue = true;
        this.refreshFigures();
        this.panel.map.replaced();
        this.panel.showLegend();
        this.showSide();
      },
      changed: (rects) => {
        this.figuresDue = true;
        this.panel.map.cellsChanged(rects);
      },
      pin: (revision) => this.comparison.pin(revision),
    };
  }

  private onStatus(status: MapStatus, revision: bigint): void {
    this.scene.status = status;
    this.panel.map.revision = revision;
    this.panel.offerGases(status.gases.map(({ species }) => species), this.time.gas);
    this.scene.threshold_ppm = isFirst(this.scene.gases) ? status.gasThresholdPpm : 0;
    this.scene.keepOut = status.keepOut;
    this.comparison.now(this.time.words);
    this.panel.offerObjective(status.objective !== undefined);
    const [text, look] = objectiveWords(status.objective);
    [this.objectivePill.textContent, this.objectivePill.className] = [text, look];
    this.objectivePill.title = status.objective?.explanation ?? '';
    for (const robot of status.robots) extendTrail(this.scene.trails, robot.robot, robot.pose);
    if (this.scene.robot === '' && status.robots.length > 0) this.choose(status.robots[0].robot);
    this.panel.map.draw();
  }

  private lookAt(gas: string): void {
    this.comparison.drop();
    // Nothing of the gas before is shown under the name of another.
    this.scene.raster = this.scene.figures = null;
    this.panel.map.replaced();
    this.charts.clear();
    this.chartsPast?.abort();
    this.chartsPast = null;
    this.time.lookAt(gas);
    this.panel.offerGases(this.scene.gases.names, gas);
    this.showSide();
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
      this.answers = true;
      this.mission = got.mission ?? null;
      this.robots = listed.robots;
      this.scene.homes = homesOf(this.robots, got.mission?.options?.home);
      this.panel.showLegend();
      if (this.mission !== null) {
        this.statePill.className = stateClass(this.mission.state);
        this.statePill.textContent = `${missionState(this.mission.state)} · ${phase(this.mission.phase)}`;
        this.time.reached(this.mission.revision);
      }
      if (this.time.isLive) {
        this.scene.plans = live.plans;
        if (withLatest && this.showsLatest()) this.setLatest(live.latest);
        for (const one of missionFigures(this.scene, this.robots, live.latest)) this.charts.add(one);
      }
    } catch {
      this.answers = false; // the stream's banner says what is the matter
      this.statePill.className = 'pill';
    }
    this.showSide();
    this.panel.map.draw();
  }

  private showsLatest(): boolean {
    return this.time.isLive && (this.tab === 'Why' || this.tab === 'Charts');
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
    this.scene.figures = figuresOf(this.scene.raster, this.scene.threshold_ppm);
    this.panel.map.figuresChanged();
    this.panel.showLegend();
  }

  // --- The side.

  private showTab(tab: Tab): void {
    this.tab = tab;
    this.scene.asksWhy = tab === 'Why';
    if (!this.showsLatest()) this.setLatest(null);
    this.panel.map.draw();
    refill(this.tabBar, ...TABS.map((one) => h('button', { role: 'tab', 'aria-selected': String(one === tab),
      tabindex: one === tab ? 0 : -1, onclick: () => this.showTab(one) }, one)));
    fill(this.tabBox, { Robots: this.robotsPanel.element, Why: this.why.element, Charts: this.charts.element,
                        Operate: this.operate.element }[tab]);
    this.showSide();
    if (tab === 'Why') this.latestPlan().catch(() => {}); // the next poll asks again
  }

  // What was before the page was opened, once somebody asks for charts.
  private async chartPast(): Promise<void> {
    if (this.chartsPast !== null || this.mission === null) return;
    const { signal } = this.chartsPast = new AbortController();
    const { charts, scene: { gases } } = this;
    charts.says('Since this page was opened; what was before is on its way …');
    try {
      const now_s = await this.time.clock.elapsed_s(this.mission.revision);
      charts.beginAt(now_s === null ? 0 : now_s - (performance.now() / 1000 - this.opened_s));
      const ask = () => snapshots.getMissionFigures({ mission: this.name }, { ...PATIENCE, signal });
      for await (const found of pastFigures(ask, signal)) {
        const threshold_ppm = this.scene.status?.gasThresholdPpm ?? 0;
        charts.setPast(found.map((one) => ({ t_s: one.elapsedS, figures: figuresThen(one, threshold_ppm, gases) })));
      }
      if (!signal.aborted) charts.says('Since the mission began.');
    } catch (error) {
      if (signal.aborted) return;
      charts.says(`Since this page was opened. What was before is not known: ${sentence(error).replace(/[.!?]?$/, '.')}`, () => {
        this.chartsPast = null;
        void this.chartPast();
      });
    }
  }

  private onTabKey(event: KeyboardEvent): void {
    const next = tabOfKey(event.key, TABS.indexOf(this.tab), TABS.length);
    if (next === null) return;
    event.preventDefault();
    this.showTab(TABS[next]);
    this.tabBar.querySelector<HTMLElement>('[aria-selected=true]')?.focus();
  }

  private showSide(): void {
    if (this.tab === 'Robots') {
      this.robotsPanel.show(this.mission, this.robots, this.scene, this.time.past, this.answers);
    }
    if (this.tab === 'Why') {
      const { robot, why } = this.scene;
      this.why.show(robot, why, noPlanWords(robot, this.time.isLive, this.latest !== null),
                    ofPlans(this.scene.gases));
    }
    if (this.tab === 'Charts') {
      void this.chartPast();
      this.charts.draw();
    }
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
    const themed = () => {
      this.panel.repaint();
      this.showSide(); // charts have colours, too
    };
    window.addEventListener('themechange', themed);
    this.stops.push(() => window.removeEventListener('themechange', themed));
  }

  // Why the robot does not go there. Of the past nobody answers.
  private ask(place: Place): void {
    this.showTab('Why');
    if (!this.time.isLive) return;
    this.scene.asked = place;
    this.panel.map.draw();
    const pose = this.scene.status?.robots.find((one) => one.robot === this.scene.robot)?.pose;
    void this.why.ask(this.scene.robot, pose, place, () => this.latestPlan());
  }

  // Whether it was a key of ours.
  onKey(key: string, target: HTMLElement): boolean {
    if (key === 'l') {
      this.time.goLive();
      return true;
    }
    if (key === ' ') {
      if (target.closest('button, summary, a') !== null) return false;
      this.time.togglePlay();
      return true;
    }
    return this.panel.onKey(key, target);
  }
}
