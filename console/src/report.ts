// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A mission after its end, without a server: the console's map with the truth beside it, and every
// plan with what it was chosen from. plumescout-lab writes what is drawn into the page.
import { create, fromBinary } from '@bufbuild/protobuf';
import type { Message } from '@bufbuild/protobuf';
import type { GenMessage } from '@bufbuild/protobuf/codegenv2';
import { figuresOf } from '@plumescout/client';
import type { Raster } from '@plumescout/client';
import type { LivePlan, MapStatus, ObjectiveOptions, ObjectiveVerdict, Plan } from '@plumescout/client/wire';
import {
  GetMapResponseSchema, LivePlanSchema, ObjectiveOptionsSchema, PlanSchema, Point2DSchema, QueryGasResponseSchema,
} from '@plumescout/client/wire';
import type { Place } from './area_draft.ts';
import { fill, h } from './dom.ts';
import { MapPanel } from './map_panel.ts';
import type { Scene } from './scene.ts';
import type { ObjectiveQuestion } from './objective_layer.ts';
import { objectiveSummary, verdictAreas } from './objective_words.ts';
import { planContent } from './plan_content.ts';
import { bytesOf, rasterOf } from './reported_mission.ts';
import type { ReportedMission } from './reported_mission.ts';
import { duration, figure, shortName } from './words.ts';

// Squares of the objective's layer: as many as are drawn without a pause.
const MOST_SQUARES = 65_536;

function decode<T extends Message>(schema: GenMessage<T>, base64: string): T {
  return fromBinary(schema, bytesOf(base64));
}

function missionFacts(raster: Raster, status: MapStatus): [string, string][] {
  const { known_m2, free_m2, max_ppm, plume_m2 } = figuresOf(raster, status.gasThresholdPpm);
  const observed = (100 * status.observedAreaM2) / status.reachableAreaM2;
  return [['known', `${figure(known_m2)} m²`], ['free', `${figure(free_m2)} m²`],
    ['completeness', `${figure(observed)} %`], ['largest gas mean', `${figure(max_ppm)} ppm`],
    ['plume', `${figure(plume_m2)} m² above ${figure(status.gasThresholdPpm)} ppm`],
    ['readings', String(status.gasCounters?.readingCount ?? 0n)], ['robots', String(status.robots.length)]];
}

// The plan as a way on the map, while it was live.
function liveOf(plan: Plan): LivePlan {
  const goal = plan.candidates[plan.chosenIndex]?.path.at(-1);
  return create(LivePlanSchema, { robot: plan.robot, trajectory: plan.trajectory, goal });
}

// How the objective stood, cell by cell of the estimate.
type Objective = { asked: ObjectiveOptions; verdicts: Uint8Array };

function questionOf(objective: Objective, estimate: Raster): ObjectiveQuestion {
  const at = ({ x_m, y_m }: Place) => {
    const cell = estimate.cellAt(x_m, y_m);
    return { verdict: (objective.verdicts[cell] ?? 0) as ObjectiveVerdict, meanPpm: estimate.mean_ppm[cell] };
  };
  return { ask: async (places) => create(QueryGasResponseSchema, { gas: places.map(at) }), goesOn: () => false,
           asked: () => objective.asked, mostPlaces: MOST_SQUARES };
}

class Report {
  private readonly estimate: Raster | null;
  private readonly truth: Raster | null;
  private readonly status: MapStatus | null;
  private readonly plans: { time_s?: number; plan: Plan }[];
  private readonly objective: Objective | null;
  private readonly scene: Scene;
  private readonly panel: MapPanel;
  private readonly details = h('div', { class: 'tab' });
  private readonly moment = h('span', { class: 'quiet', role: 'status' });
  private readonly slider: HTMLInputElement;
  private readonly shown: Record<'estimate' | 'truth', HTMLButtonElement>;

  constructor(private readonly mission: ReportedMission) {
    const map = decode(GetMapResponseSchema, mission.map);
    this.estimate = rasterOf(map);
    this.truth = mission.truth === undefined ? null : rasterOf(decode(GetMapResponseSchema, mission.truth));
    this.status = map.status ?? null;
    this.objective = mission.objective === null ? null : {
      asked: decode(ObjectiveOptionsSchema, mission.objective.asked), verdicts: bytesOf(mission.objective.verdicts) };
    this.plans = mission.plans
      .map(({ time_s, plan }) => ({ time_s, plan: decode(PlanSchema, plan) }))
      .sort((a, b) => (a.time_s ?? 0) - (b.time_s ?? 0));
    this.scene = {
      raster: this.estimate, then: this.truth, figures: null, threshold_ppm: map.status?.gasThresholdPpm ?? 0,
      status: this.status, plans: [], why: null, asksWhy: true, candidate: -1,
      trails: new Map(mission.ways.map(({ robot, points_m }) => [robot, { points: points_m }])),
      keepOut: map.status?.keepOut ?? [], draft: null, beside: null, homes: mission.homes_m.map(([xM, yM]) => create(Point2DSchema, { xM, yM })), gases: { names: [], looked: '' }, robot: '', asked: null,
      sources: mission.sources_m.map(([x_m, y_m]) => ({ x_m, y_m })), judged: [] };
    this.panel = new MapPanel(this.scene, () => {}, () => {}, null,
      this.objective === null || this.estimate === null ? null : questionOf(this.objective, this.estimate));
    this.panel.offerObjective(this.objective !== null);
    this.panel.offerChange(this.truth !== null);
    this.panel.callChange('Error', 'Estimated gas mean less the true one');
    this.slider = h('input', { type: 'range', min: 0, max: this.plans.length, value: this.plans.length,
                               'aria-label': 'Plan to look at', oninput: () => this.showPlan() });
    this.shown = {
      estimate: h('button', { onclick: () => this.showMap('estimate') }, 'Estimate'),
      truth: h('button', { onclick: () => this.showMap('truth') }, 'Truth') };
  }

  element(): HTMLElement {
    const step = (by: number) => () => {
      this.slider.value = String(Number(this.slider.value) + by);
      this.showPlan();
    };
    return h('main', { class: 'mission' },
      this.panel.element,
      h('aside', { class: 'side', 'aria-label': 'Plan' },
        this.truth === null ? null : h('div', { class: 'tabs' }, this.shown.estimate, this.shown.truth), this.details),
      h('footer', { class: 'time', 'aria-label': 'Plans' },
        h('button', { onclick: step(-1), 'aria-label': 'Plan before' }, '‹'), this.slider,
        h('button', { onclick: step(1), 'aria-label': 'Next plan' }, '›'), this.moment));
  }

  showMap(which: 'estimate' | 'truth'): void {
    const raster = this[which];
    this.scene.raster = raster;
    // Both on the scale of the estimate and of the truth, whichever has more gas.
    const figures = [this.estimate, this.truth].flatMap((one) =>
      one === null ? [] : [figuresOf(one, this.scene.threshold_ppm)]);
    this.scene.figures = raster === null ? null : {
      ...figuresOf(raster, this.scene.threshold_ppm),
      max_ppm: Math.max(...figures.map(({ max_ppm }) => max_ppm || 0)) };
    for (const name of ['estimate', 'truth'] as const) {
      this.shown[name].setAttribute('aria-pressed', String(name === which));
    }
    this.panel.map.replaced();
    this.panel.showLegend();
  }

  showPlan(): void {
    const entry = this.plans[Number(this.slider.value)];
    const plan = entry?.plan ?? null;
    this.scene.why = plan;
    this.scene.robot = plan?.robot ?? '';
    this.scene.plans = plan === null ? [] : [liveOf(plan)];
    this.scene.candidate = -1;
    this.moment.textContent = entry === undefined ? `${this.plans.length} plan${this.plans.length === 1 ? '' : 's'}`
      : `plan ${Number(this.slider.value) + 1} of ${this.plans.length}, ${shortName(entry.plan.robot)}` +
        (entry.time_s === undefined ? '' : ` after ${duration(entry.time_s)}`);
    fill(this.details, ...(plan === null ? this.overview()
      : planContent(plan, (candidate) => {
        this.scene.candidate = candidate;
        this.panel.map.draw();
      })));
    this.panel.map.draw();
  }

  // What there is to say of all of it.
  private overview(): HTMLElement[] {
    const { title } = this.mission;
    const parts: HTMLElement[] = [h('p', { class: 'quiet' }, title === undefined
      ? 'The map when the mission ended, and the ways that were driven. Move the slider below for each plan and ' +
        'what it was chosen from. Point at a cell for its gas; drag to pan, scroll to zoom.'
      : 'The map as it was then, with the ways of robots while a console looked on. Move the slider below for the ' +
        'latest plan of each robot. Point at a cell for its gas; drag to pan, scroll to zoom.')];
    if (title !== undefined) parts.unshift(h('h1', {}, title));
    const { estimate, objective, status } = this;
    if (objective !== null && estimate !== null && status?.objective !== undefined) {
      parts.push(objectiveSummary(objective.asked, status.objective,
                                  verdictAreas(objective.asked, objective.verdicts, estimate)));
    }
    if (title !== undefined && estimate !== null && status !== null) {
      parts.push(h('dl', { class: 'facts' }, ...missionFacts(estimate, status).flatMap(([name, value]) => [
        h('dt', {}, name), h('dd', {}, value)])));
    }
    return parts;
  }

  onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target === this.slider) return;
    if (this.panel.onKey(event.key, event.target as HTMLElement)) event.preventDefault();
  }
}

document.documentElement.dataset.theme = 'light';
const mission = JSON.parse(document.getElementById('mission')!.textContent!) as ReportedMission;
if (mission.title !== undefined) document.title = mission.title;
const report = new Report(mission);
document.body.prepend(report.element());
document.addEventListener('keydown', (event) => report.onKey(event));
report.showMap('estimate');
report.showPlan();
