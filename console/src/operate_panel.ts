// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What an operator does to a mission and its robots, and what leaves it as files.
import { PATIENCE, client, missions, requestId, robots, sentence } from './client.ts';
import { ask, fillIfChanged, h, notice, saveFile } from './dom.ts';
import { exportMission, mapYamlOf, npyOf, pgmOf } from '@plumescout/client';
import type { Raster } from '@plumescout/client';
import { mayOperate } from './session.ts';
import type { Mission, Robot } from '@plumescout/client/wire';
import { MissionFileFormat, MissionState } from '@plumescout/client/wire';
import { fetchMap } from './watch.ts';
import type { Moment } from './watch.ts';
import { bytes, shortName, squaresInWords } from './words.ts';

async function attempt(what: string, task: () => Promise<unknown>): Promise<void> {
  try {
    await task();
    notice(what);
  } catch (error) {
    notice(sentence(error), 'bad');
  }
}

export class OperatePanel {
  readonly element = h('div', {});
  private exporting: AbortController | null = null;
  private readonly saving = new AbortController();

  // `areas`: what is done about keep-out areas; `raster`, `moment`: of what is looked at;
  // `report`: makes one of that.
  constructor(private readonly mission: string, private readonly areas: HTMLElement,
              private readonly raster: () => Raster | null,
              private readonly moment: () => Moment,
              private readonly link: () => string, private readonly report: () => Promise<string>) {}

  leave(): void {
    this.exporting?.abort();
    this.saving.abort();
  }

  show(mission: Mission | null, list: Robot[]): void {
    if (mission === null) return;
    const key = JSON.stringify([mayOperate(), mission.state, mission.options?.keepOut, list.map((one) =>
      [one.onMap?.robot, one.orderedHome, one.leased])]);
    fillIfChanged(this.element, key, () => [
      mayOperate() ? this.missionActions(mission)
        : h('p', { class: 'card' }, 'You look on: your role may not change missions.'),
      mayOperate() ? this.robotActions(mission, list) : null,
      this.areas,
      this.exports(),
      this.options(mission)]);
  }

  private missionActions(mission: Mission): HTMLElement {
    const name = mission.name;
    const id = shortName(name);
    const { state } = mission;
    const finish = async () => {
      if (await ask(`Finish ${id}?`, 'Its map can be read from then on, but nothing changes it any more, ' +
                    'and no robot gets a plan. This cannot be taken back.', 'Finish')) {
        await attempt(`${id} is finished.`, () => missions.finishMission({ name }, PATIENCE));
      }
    };
    const order = (home: boolean) => attempt(home ? 'All robots drive home.' : 'No robot has to go home.',
      () => robots.orderHome({ target: { case: 'mission', value: name }, home,
                               requestId: requestId() }, PATIENCE));
    return h('section', { class: 'card' }, h('h2', {}, 'Mission'), h('div', { class: 'row' },
      state === MissionState.PAUSED
        ? h('button', { class: 'primary', onclick: () => void attempt(`${id} goes on.`,
            () => missions.resumeMission({ name }, PATIENCE)) }, 'Resume')
        : h('button', { disabled: state !== MissionState.RUNNING,
            onclick: () => void attempt(`${id} pauses: no new plans.`,
              () => missions.pauseMission({ name }, PATIENCE)) }, 'Pause'),
      h('button', { disabled: state === MissionState.FINISHED, onclick: () => void order(true) }, 'All home'),
      h('button', { disabled: state === MissionState.FINISHED, onclick: () => void order(false) }, 'Not home any more'),
      h('button', { class: 'danger', disabled: state === MissionState.FINISHED, onclick: () => void finish() }, 'Finish …')));
  }

  private robotActions(mission: Mission, list: Robot[]): HTMLElement {
    const remove = async (robot: string) => {
      const id = shortName(robot);
      if (await ask(`Remove ${id}?`, `${id} leaves the mission, whoever holds its lease. What it measured stays. ` +
                    'If it is alive, it has to register again.', 'Remove')) {
        await attempt(`${id} is removed.`, () => robots.removeRobot({ robot, force: true }, PATIENCE));
      }
    };
    const release = async (robot: string) => {
      const id = shortName(robot);
      if (await ask(`Release the lease of ${id}?`, 'Whoever drives it now is sent away, and another client ' +
                    'may register it at once.', 'Release')) {
        await attempt(`The lease of ${id} is free.`, () => robots.releaseLease({ robot, force: true }, PATIENCE));
      }
    };
    const finished = mission.state === MissionState.FINISHED;
    return h('section', { class: 'card' }, h('h2', {}, 'Robots'),
      list.length === 0 ? h('p', { class: 'quiet' }, 'No robot has registered yet.') : null,
      ...list.map((one) => {
        const robot = one.onMap?.robot ?? '';
        const id = shortName(robot);
        return h('div', { class: 'row' }, h('strong', { class: 'spring' }, id),
          h('button', { disabled: finished, 'aria-label': one.orderedHome ? `${id} goes on` : `Send ${id} home`,
            onclick: () => void attempt(one.orderedHome ? `${id} goes on.` : `${id} drives home.`,
              () => robots.orderHome({ target: { case: 'robot', value: robot }, home: !one.orderedHome,
                                       requestId: requestId() }, PATIENCE)) },
            one.orderedHome ? 'Go on' : 'Home'),
          one.leased ? h('button', { 'aria-label': `Release the lease of ${id}`, onclick: () => void release(robot) }, 'Release …') : null,
          h('button', { class: 'danger', disabled: finished, 'aria-label': `Remove ${id}`,
                        onclick: () => void remove(robot) }, 'Remove …'));
      }));
  }

  private exports(): HTMLElement {
    const id = shortName(this.mission);
    const npy = (name: string, layer: (raster: Raster) => Float32Array) => void this.saveMap((raster, gas) =>
      saveFile(`${id}-${gas === '' ? '' : `${gas}-`}${name}.npy`, [npyOf(layer(raster), raster.geometry.rows, raster.geometry.columns).buffer as ArrayBuffer]));
    return h('section', { class: 'card' }, h('h2', {}, 'Take away'), h('div', { class: 'row' },
      h('button', { onclick: () => void this.saveMap((raster) => {
        saveFile(`${id}.pgm`, [pgmOf(raster).buffer as ArrayBuffer]);
        saveFile(`${id}.yaml`, [mapYamlOf(raster, `${id}.pgm`)]);
      }) }, 'Map (map_server)'),
      h('button', { onclick: () => npy('gas-mean', (raster) => raster.mean_ppm) }, 'Gas mean (npy)'),
      h('button', { onclick: () => npy('gas-variance', (raster) => raster.variance_ppm2) }, 'Gas variance (npy)'),
      h('button', { onclick: () => void this.saveReport() }, 'Report (HTML)'),
      ...(mayOperate() ? [
        h('button', { onclick: () => void this.exportMission('plumescout') }, 'Whole mission'),
        h('button', { onclick: () => void this.exportMission('mcap') }, 'MCAP (Foxglove)')] : []),
      h('button', { onclick: () => void Promise.resolve(navigator.clipboard?.writeText(this.link()) ?? Promise.reject())
        .then(() => notice('The link to this moment is copied.'), () => notice(this.link())) }, 'Link to this moment')));
  }

  // What is drawn may be of squares of cells, and its gas is of 16 bits.
  private async saveMap(write: (raster: Raster, gas: string) => void): Promise<void> {
    if (this.raster() === null) return notice('There is no map yet.', 'bad');
    const { signal } = this.saving;
    const moment = this.moment();
    try {
      const { raster, status } = await fetchMap(this.mission, moment, signal, true);
      write(raster, moment.gas);
      const squares = squaresInWords(raster.geometry.resolution_m, status.geometry?.resolutionM ?? NaN);
      if (squares !== '') notice(`The map is large: it is saved in ${squares}. plumescoutctl map export saves all cells.`);
    } catch (error) {
      if (!signal.aborted) notice(sentence(error), 'bad');
    }
  }

  private async saveReport(): Promise<void> {
    if (this.raster() === null) return notice('There is no map yet.', 'bad');
    notice('The report is on its way …');
    await attempt('The report is saved: it needs no server.', async () =>
      saveFile(`${shortName(this.mission)}.html`, [await this.report()], 'text/html'));
  }

  // As a journal, which can be imported again, or as MCAP.
  private async exportMission(ending: 'plumescout' | 'mcap'): Promise<void> {
    if (this.exporting !== null) return notice('The mission is on its way already.');
    const { signal } = this.exporting = new AbortController();
    const format = ending === 'mcap' ? MissionFileFormat.MCAP : MissionFileFormat.JOURNAL;
    const parts: Uint8Array[] = [];
    try {
      let size = 0;
      for await (const { data, done_bytes, expected_bytes } of exportMission(client, this.mission,
                                                                                { format, signal })) {
        if (size === 0) notice(`About ${bytes(expected_bytes)} are on their way …`);
        parts.push(data);
        size = done_bytes;
      }
      saveFile(`${shortName(this.mission)}.${ending}`, parts as BlobPart[]);
      notice(`The mission is saved: ${bytes(size)}.`);
    } catch (error) {
      if (!signal.aborted) notice(sentence(error), 'bad');
    } finally {
      this.exporting = null;
    }
  }

  private options(mission: Mission): HTMLElement {
    const text = JSON.stringify(mission.options ?? {}, (key, value) =>
      key.startsWith('$') || key === 'priorMap' ? undefined : typeof value === 'bigint' ? Number(value) : value, 2);
    return h('details', { class: 'group' }, h('summary', {}, 'Options in force'), h('pre', { class: 'scroll', tabindex: 0 }, text));
  }
}
