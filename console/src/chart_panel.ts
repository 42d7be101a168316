// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Figures of a mission over time: as the page saw them, and before that as the journal has them.
import { Series, drawChart, spanOf } from './charts.ts';
import type { Sample } from './charts.ts';
import { fill, h } from './dom.ts';
import { WHAT_COUNTS } from './mission_figures.ts';
import type { MissionFigure } from './mission_figures.ts';
import { figure, shortName } from './words.ts';

// Of one robot, or of the mission; times of `past` are since the mission began, of `now` since the page was opened.
type History = { past: Series; now: Series };
type Chart = { title: string; unit: string; lines: Map<string, History> };

export class ChartPanel {
  readonly element: HTMLElement;
  private readonly box = h('div', {}, h('p', { class: 'empty' }, 'Waiting for the map …'));
  private readonly began = performance.now();
  private readonly charts = new Map<string, Chart>();
  private opened_s = 0; // since the mission began, when the page was opened; 0: that is not known
  private readonly note = h('p', { class: 'quiet', role: 'status' }, 'Since this page was opened.');

  constructor(private readonly colourOf: (robot: string) => string) {
    this.element = h('div', {},
      h('details', { class: 'group' }, h('summary', {}, 'What counts'),
        h('dl', {}, ...WHAT_COUNTS.flatMap(([name, what]) => [h('dt', {}, name), h('dd', {}, what)]))),
      this.note, this.box);
  }

  // Of now.
  add(figure: MissionFigure): void {
    this.historyOf(figure).now.add((performance.now() - this.began) / 1000, figure.value);
  }
  // All that is known of what was before, in its order; times are since the mission began.
  setPast(moments: { t_s: number; figures: MissionFigure[] }[]): void {
    for (const { lines } of this.charts.values()) for (const history of lines.values()) history.past = new Series();
    for (const { t_s, figures } of moments) {
      for (const one of figures) this.historyOf(one).past.add(t_s, one.value);
    }
  }
  // So long after the mission's beginning the page was opened.
  beginAt(opened_s: number): void {
    this.opened_s = opened_s;
  }
  // Since when lines are drawn, in words; `again`: what is done if somebody wants it tried again.
  says(said: string, again: (() => void) | null = null): void {
    fill(this.note, said, again === null ? null : ' ', again === null ? null : h('button', { onclick: again }, 'Try again'));
  }

  private historyOf({ title, unit, robot: line }: MissionFigure): History {
    let chart = this.charts.get(title);
    if (chart === undefined) {
      chart = { title, unit, lines: new Map() };
      this.charts.set(title, chart);
    }
    let history = chart.lines.get(line);
    if (history === undefined) {
      history = { past: new Series(), now: new Series() };
      chart.lines.set(line, history);
    }
    return history;
  }

  // The mission's own account, as far as it goes, and what the page saw after it.
  private samplesOf({ past, now }: History): Sample[] {
    const known_s = past.samples.at(-1)?.t_s ?? -Infinity;
    const seen = now.samples.map(({ t_s, value }) => ({ t_s: t_s + this.opened_s, value }));
    return [...past.samples, ...seen.filter(({ t_s }) => t_s > known_s)];
  }

  // What is charted from now on is of something else.
  clear(): void {
    this.charts.clear();
  }

  draw(): void {
    if (this.charts.size === 0 || this.element.clientWidth === 0) return;
    const accent = getComputedStyle(this.element).getPropertyValue('--accent');
    const charts = [...this.charts.values()].map(({ title, unit, lines }) => ({ title, unit, lines: [...lines].map(
      ([name, history]) => ({ name, samples: this.samplesOf(history), colour: name === '' ? accent : this.colourOf(name) })) }));
    const span = spanOf(charts.flatMap(({ lines }) => lines)); // one for all: they are of the same time
    const drawn = charts.map(({ title, unit, lines }) => {
      const now = lines.map((line) => (line.name === '' ? '' : `${shortName(line.name)} `) +
        `${figure(line.samples.at(-1)?.value ?? NaN)} ${unit}`).join(', ');
      const canvas = h('canvas', { role: 'img', 'aria-label': `${title}: ${now}` });
      return { canvas, lines, unit, box: h('div', { class: 'chart' }, h('div', { class: 'head' },
        h('strong', {}, title), h('span', { class: 'now' }, now)), canvas) };
    });
    fill(this.box, ...drawn.map(({ box }) => box));
    for (const { canvas, lines, unit } of drawn) drawChart(canvas, lines, unit, span);
  }
}
