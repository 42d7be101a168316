// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Figures of a mission over time: as the page saw them, and before that as the journal has them.
import { Series, drawChart } from './charts.ts';
import type { Line, Sample } from './charts.ts';
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
  private said = 'Since this page was opened.';

  constructor(private readonly colourOf: (robot: string) => string) {
    this.element = h('div', {},
      h('details', { class: 'group' }, h('summary', {}, 'What counts'),
        h('dl', {}, ...WHAT_COUNTS.flatMap(([name, what]) => [h('dt', {}, name), h('dd', {}, what)]))),
      this.box);
  }

  // Of now.
  add(figure: MissionFigure): void {
    this.historyOf(figure).now.add((performance.now() - this.began) / 1000, figure.value);
  }
  // Of so long after the mission began; one after the other.
  addPast(t_s: number, figure: MissionFigure): void {
    this.historyOf(figure).past.add(t_s, figure.value);
  }
  // Since when lines are drawn, in words; `opened_s`: so long after the mission's beginning the page was opened.
  says(said: string, opened_s = this.opened_s): void {
    [this.said, this.opened_s] = [said, opened_s];
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

  private samplesOf({ past, now }: History): Sample[] {
    const since_s = this.opened_s + (now.samples[0]?.t_s ?? Infinity);
    return [...past.samples.filter(({ t_s }) => t_s < since_s), ...now.samples.map(({ t_s, value }) => ({ t_s: t_s + this.opened_s, value }))];
  }

  // What is charted from now on is of something else.
  clear(): void {
    this.charts.clear();
  }

  draw(): void {
    if (this.charts.size === 0 || this.element.clientWidth === 0) return;
    const drawn: [HTMLCanvasElement, Line[], string][] = [];
    const boxes = [...this.charts.values()].map((chart) => {
      const lines = [...chart.lines].map(([name, history]) => ({
        name, samples: this.samplesOf(history), colour: name === '' ? getComputedStyle(this.element).getPropertyValue('--accent')
                                          : this.colourOf(name),
      }));
      const now = lines.map((line) => (line.name === '' ? '' : `${shortName(line.name)} `) +
        `${figure(line.samples.at(-1)?.value ?? NaN)} ${chart.unit}`).join(', ');
      const canvas = h('canvas', { role: 'img', 'aria-label': `${chart.title}: ${now}` });
      drawn.push([canvas, lines, chart.unit]);
      return h('div', { class: 'chart' }, h('div', { class: 'head' },
        h('strong', {}, chart.title), h('span', { class: 'now' }, now)), canvas);
    });
    fill(this.box, h('p', { class: 'quiet' }, this.said), ...boxes);
    for (const [canvas, lines, unit] of drawn) drawChart(canvas, lines, unit);
  }
}
