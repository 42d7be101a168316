// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Keep-out areas of a mission: a list, and what draws one on the map.
import { AreaDraft, freeName } from './area_draft.ts';
import type { Shape } from './area_draft.ts';
import { PATIENCE, missions, requestId, sentence } from './client.ts';
import { ask, fillIfChanged, h, notice } from './dom.ts';
import type { MapPanel } from './map_panel.ts';
import { mayOperate } from './session.ts';
import type { Polygon } from '@plumescout/client/wire';

const HOW: Record<Shape, string> = {
  rectangle: 'Drag from corner to corner, or click both.',
  polygon: 'Click the corners; on the first one again to end.' };
const centimetres = (metres: number) => Math.round(100 * metres) / 100;

export class AreasPanel {
  readonly element = h('section', { class: 'card' });
  private readonly bar = h('form', { class: 'draft', 'aria-label': 'New keep-out area',
    onsubmit: (event: Event) => { event.preventDefault(); void this.close(); },
    onkeydown: (event: KeyboardEvent) => { if (event.key === 'Escape') this.cancel(); } });
  private readonly how = h('span', {});
  private readonly name = h('input', { 'aria-label': 'Name of the area', required: true, size: 12,
    pattern: '[a-z]([a-z0-9\\-]{0,61}[a-z0-9])?', title: 'small letters, digits and dashes' });
  private readonly refusal = h('p', { role: 'alert' }); // why the server did not take it
  private readonly submit = h('button', { class: 'primary' }, 'Keep robots out');
  private draft: AreaDraft | null = null;
  private areas: Polygon[] = [];
  private takesChanges = false;

  constructor(private readonly mission: string, private readonly panel: MapPanel,
              private readonly changed: (areas: Polygon[]) => void) {
    this.bar.append(this.how, this.name, this.submit,
      h('button', { type: 'button', onclick: () => this.undo() }, 'Undo'),
      h('button', { type: 'button', onclick: () => this.cancel() }, 'Cancel'), this.refusal);
  }

  // `takesChanges`: the mission is not finished.
  show(areas: Polygon[], takesChanges: boolean): void {
    this.areas = areas;
    this.takesChanges = takesChanges;
    const may = mayOperate() && takesChanges;
    if (!may) this.cancel();
    fillIfChanged(this.element, JSON.stringify([may, areas.map((area) => area.name)]), () => [
      h('h2', {}, 'Keep-out areas'),
      areas.length === 0 ? h('p', { class: 'quiet' }, 'Robots may drive everywhere.') : null,
      ...areas.map(({ name }) => h('div', { class: 'row' }, h('strong', { class: 'spring' }, name),
        may ? h('button', { class: 'danger', 'aria-label': `Delete ${name}`,
                            onclick: () => void this.open(name) }, 'Delete …') : null)),
      may ? h('div', { class: 'row' },
        h('button', { onclick: () => this.draw('rectangle') }, 'Draw a rectangle'),
        h('button', { onclick: () => this.draw('polygon') }, 'Draw a polygon')) : null]);
  }

  leave(): void {
    this.cancel();
  }

  private draw(shape: Shape): void {
    this.cancel();
    const draft = this.draft = new AreaDraft(shape);
    this.name.value = freeName(this.areas.map((area) => area.name));
    this.panel.draw({
      draft,
      changed: () => this.showDraft(),
      key: (key) => {
        if (key === 'Escape') this.cancel();
        else if (key === 'Enter') void this.close();
        else if (key === 'Backspace') this.undo();
        else return false;
        return true;
      },
    });
    this.panel.element.append(this.bar);
    this.showDraft();
  }

  private showDraft(): void {
    if (this.draft === null) return;
    const ready = this.draft.area().length >= 3;
    this.submit.disabled = !ready || (this.draft.shape === 'rectangle' && !this.draft.done);
    this.refusal.textContent = '';
    this.how.textContent = this.draft.done ? 'Robots will keep out of it:' : HOW[this.draft.shape];
  }

  private undo(): void {
    this.draft?.undo();
    this.panel.map.draw();
    this.showDraft();
  }

  private cancel(): void {
    if (this.draft === null) return;
    this.draft = null;
    this.bar.remove();
    this.panel.draw(null);
  }

  private async close(): Promise<void> {
    const { draft } = this;
    if (draft === null || this.submit.disabled || !this.bar.reportValidity()) return;
    const area = this.name.value;
    const vertices = draft.area().map(({ x_m, y_m }) => ({ xM: centimetres(x_m), yM: centimetres(y_m) }));
    this.submit.disabled = true;
    const refusal = await this.change({ added: [{ name: area, vertices }] }, `${area} is closed to robots.`);
    if (this.draft !== draft) return; // another one is drawn by now
    if (refusal === '') return this.cancel();
    this.showDraft();
    this.refusal.textContent = refusal;
  }

  private async open(area: string): Promise<void> {
    if (!await ask(`Delete ${area}?`, 'Robots may drive through it from then on.', 'Delete')) return;
    const refusal = await this.change({ deleted: [area] }, `${area} is open to robots.`);
    if (refusal !== '') notice(refusal, 'bad');
  }

  // Why it was not taken; empty: it was.
  private async change(wish: { added?: { name: string; vertices: { xM: number; yM: number }[] }[]; deleted?: string[] },
                       done: string): Promise<string> {
    try {
      const { areas } = await missions.changeKeepOutAreas(
        { name: this.mission, ...wish, requestId: requestId() }, PATIENCE);
      this.show(areas, this.takesChanges);
      this.changed(areas);
      notice(done);
      return '';
    } catch (error) {
      return sentence(error);
    }
  }
}
