// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What a map shows, and which of it can be switched.
import type { AreaDraft, Place } from './area_draft.ts';
import type { Cells } from './cell_picture.ts';
import type { Gases } from './gases.ts';
import type { JudgedSquare } from './objective_layer.ts';
import type { Trails } from './trails.ts';
import type { LivePlan, MapStatus, Plan, Point2D, Polygon } from '@plumescout/client/wire';

export const SWITCHES = ['frontiers', 'ways', 'trails', 'claims', 'names', 'areas', 'why'] as const;
export type Switch = (typeof SWITCHES)[number];

export type { Place };

// Whatever lies on the map.
export type Scene = Cells & {
  status: MapStatus | null;
  gases: Gases; // of which the raster is one
  plans: LivePlan[];
  why: Plan | null; // of the robot that is looked at
  asksWhy: boolean; // whether that is looked into
  candidate: number; // of it, pointed at; -1: none
  trails: Trails;
  keepOut: Polygon[];
  draft: AreaDraft | null; // of another one
  homes: Point2D[]; // of the robots
  robot: string; // that is looked at
  asked: Place | null; // the place that was clicked on
  sources: Place[]; // of gas, if somebody knows
  judged: JudgedSquare[]; // how the objective stands, where that is looked at
};
