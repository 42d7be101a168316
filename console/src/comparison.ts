// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A moment that is kept, to compare others with: what the mean did since, and its map beside theirs.
import { figuresOf } from '@plumescout/client';
import { notice } from './dom.ts';
import type { MapPanel } from './map_panel.ts';
import type { Scene } from './scene.ts';

export class Comparison {
  private readonly pinned: Scene;

  constructor(private readonly scene: Scene, private readonly panel: MapPanel) {
    this.pinned = { ...scene };
  }

  // Keeps what is looked at, which is of this revision.
  pin(revision: bigint): void {
    const { raster, status, threshold_ppm, keepOut, homes } = this.scene;
    if (raster === null) return notice('There is no map yet.', 'bad');
    this.scene.then = raster.copy();
    Object.assign(this.pinned, {
      raster: this.scene.then, figures: figuresOf(this.scene.then, threshold_ppm), status, threshold_ppm, keepOut, homes,
      robot: '', plans: [], trails: new Map(), why: null, asked: null, draft: null, beside: this.scene });
    this.panel.callChange('Change', `Change of the gas mean since revision ${revision}`);
    this.panel.nameMoments({ then: `then: revision ${revision}` });
    this.panel.offer(this.pinned);
    notice(`Revision ${revision} is pinned: “Change” shows what the gas mean did since, “Side by side” both maps.`);
    this.panel.setCells('change');
  }

  // What is kept does not compare with what is looked at from now on.
  drop(): void {
    this.panel.offer(null);
    this.scene.then = null;
  }

  // What is looked at now, in words.
  now(moment: string): void {
    this.panel.nameMoments({ now: `now: ${moment}` });
  }
}
