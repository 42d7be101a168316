// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Figures of a mission since the page was opened.
import { Series, drawChart } from './charts.ts';
import type { Line } from './charts.ts';
import { fill, h } from './dom.ts';
import { WHAT_COUNTS } from './mission_figures.ts';
import { figure, shortName } from './words.ts';

type Chart = { title: string; unit: string; lines: Map<string, Series> };

export class ChartPanel {
  readonly element: HTMLElement;
  private readonly box = h('div', {}, h('p', { class: 'empty' }, 'Waiting for the map …'));
  private readonly began = performance.now();
  private readonly charts = new Map<string, Chart>();

  constructor(private readonly colourOf: (robot: string) => string) {
    this.element = h('div', {},
      h('details', { class: 'group' }, h('summary', {}, 'What counts'),
        h('dl', {}, ...WHAT_COUNTS.flatMap(([name, what]) => [h('dt', {}, name), h('dd', {}, what)]))),
      this.box);
  }

  // `line`: of a robot, or ''.
  add(title: string, unit: string, line: string, value: number): void {
    let chart = this.charts.get(title);
    if (chart === undefined) {
      chart = { title, unit, lines: new Map() };
      this.charts.set(title, chart);
    }
    let series = chart.lines.get(line);
    if (series === undefined) {
      series = new Series();
      chart.lines.set(line, series);
    }
    series.add((performance.now() - this.began) / 1000, value);
  }

  draw(): void {
    if (this.charts.size === 0 || this.element.clientWidth === 0) return;
    const drawn: [HTMLCanvasElement, Line[], string][] = [];
    const boxes = [...this.charts.values()].map((chart) => {
      const lines = [...chart.lines].map(([name, series]) => ({
        name, series, colour: name === '' ? getComputedStyle(this.element).getPropertyValue('--accent')
                                          : this.colourOf(name),
      }));
      const now = lines.map((line) => (line.name === '' ? '' : `${shortName(line.name)} `) +
        `${figure(line.series.last)} ${chart.unit}`).join(', ');
      const canvas = h('canvas', { role: 'img', 'aria-label': `${chart.title}: ${now}` });
      drawn.push([canvas, lines, chart.unit]);
      return h('div', { class: 'chart' }, h('div', { class: 'head' },
        h('strong', {}, chart.title), h('span', { class: 'now' }, now)), canvas);
    });
    fill(this.box, h('p', { class: 'quiet' }, 'Since this page was opened.'), ...boxes);
    for (const [canvas, lines, unit] of drawn) drawChart(canvas, lines, unit);
  }
}
