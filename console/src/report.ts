// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A mission after its end, without a server: the console's map with the truth beside it, and every
// plan with what it was chosen from. plumescout-lab writes what is drawn into the page.
import { create, fromBinary } from '@bufbuild/protobuf';
import type { Message } from '@bufbuild/protobuf';
import type { GenMessage } from '@bufbuild/protobuf/codegenv2';
import { Raster, figuresOf, geometryOf } from '@plumescout/client';
import type { GetMapResponse, LivePlan, Plan } from '@plumescout/client/wire';
import { GetMapResponseSchema, LivePlanSchema, PlanSchema } from '@plumescout/client/wire';
import { fill, h } from './dom.ts';
import { MapPanel } from './map_panel.ts';
import type { Scene } from './map_view.ts';
import { planContent } from './plan_content.ts';
import { duration, shortName } from './words.ts';

type Mission = {
  map: string; // GetMapResponse in base64, as the others
  truth: string;
  plans: { time_s: number; plan: string }[]; // robot by robot
  ways: { robot: string; points_m: [number, number][] }[];
  sources_m: [number, number][];
};

function decode<T extends Message>(schema: GenMessage<T>, base64: string): T {
  return fromBinary(schema, Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)));
}

function rasterOf(response: GetMapResponse): Raster | null {
  const geometry = geometryOf(response.tileGeometry);
  if (geometry === null) return null;
  const raster = new Raster(geometry);
  for (const tile of response.tiles) raster.apply(tile);
  return raster;
}

// The plan as a way on the map, while it was live.
function liveOf(plan: Plan): LivePlan {
  const goal = plan.candidates[plan.chosenIndex]?.path.at(-1);
  return create(LivePlanSchema, { robot: plan.robot, trajectory: plan.trajectory, goal });
}

class Report {
  private readonly estimate: Raster | null;
  private readonly truth: Raster | null;
  private readonly plans: { time_s: number; plan: Plan }[];
  private readonly scene: Scene;
  private readonly panel: MapPanel;
  private readonly details = h('div', { class: 'tab' });
  private readonly moment = h('span', { class: 'quiet', role: 'status' });
  private readonly slider: HTMLInputElement;
  private readonly shown: Record<'estimate' | 'truth', HTMLButtonElement>;

  constructor(mission: Mission) {
    const map = decode(GetMapResponseSchema, mission.map);
    this.estimate = rasterOf(map);
    this.truth = rasterOf(decode(GetMapResponseSchema, mission.truth));
    this.plans = mission.plans
      .map(({ time_s, plan }) => ({ time_s, plan: decode(PlanSchema, plan) }))
      .sort((a, b) => a.time_s - b.time_s);
    this.scene = {
      raster: this.estimate, then: this.truth, figures: null, threshold_ppm: map.status?.gasThresholdPpm ?? 0,
      status: map.status ?? null, plans: [], why: null, asksWhy: true, candidate: -1,
      trails: new Map(mission.ways.map(({ robot, points_m }) => [robot, { points: points_m }])),
      keepOut: map.status?.keepOut ?? [], draft: null, beside: null, home: undefined, robot: '', asked: null,
      sources: mission.sources_m.map(([x_m, y_m]) => ({ x_m, y_m })), judged: [] };
    this.panel = new MapPanel(this.scene, () => {}, () => {});
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
        h('div', { class: 'tabs' }, this.shown.estimate, this.shown.truth), this.details),
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
    this.moment.textContent = entry === undefined ? `end of the mission; ${this.plans.length} plans`
      : `plan ${Number(this.slider.value) + 1} of ${this.plans.length}, ` +
        `${shortName(entry.plan.robot)} after ${duration(entry.time_s)}`;
    fill(this.details, ...(plan === null
      ? [h('p', { class: 'quiet' }, 'The map when the mission ended, and the ways that were driven. Move the ' +
          'slider below for each plan and what it was chosen from. Point at a cell for its gas; drag to pan, scroll to zoom.')]
      : planContent(plan, (candidate) => {
        this.scene.candidate = candidate;
        this.panel.map.draw();
      })));
    this.panel.map.draw();
  }

  onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target === this.slider) return;
    if (this.panel.onKey(event.key, event.target as HTMLElement)) event.preventDefault();
  }
}

document.documentElement.dataset.theme = 'light';
const report = new Report(JSON.parse(document.getElementById('mission')!.textContent!) as Mission);
document.body.prepend(report.element());
document.addEventListener('keydown', (event) => report.onKey(event));
report.showMap('estimate');
report.showPlan();
