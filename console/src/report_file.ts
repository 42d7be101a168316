// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A mission as one HTML file that needs no server: the map at one moment, what it was for, and what
// robots were told last.
import { create, toBinary } from '@bufbuild/protobuf';
import type { Raster } from '@plumescout/client';
import {
  GetMapResponseSchema, MapLayer, ObjectiveKind, ObjectiveOptionsSchema, PlanSchema,
} from '@plumescout/client/wire';
import type { GetMapResponse, Mission, Point2D } from '@plumescout/client/wire';
import { PATIENCE, maps, planning } from './client.ts';
import { isFirst, ofGas } from './gases.ts';
import type { Gases } from './gases.ts';
import { MOST_PLACES, spread, squaresOf } from './objective_layer.ts';
import { base64Of, fillReport, rasterOf } from './reported_mission.ts';
import type { ReportedMission } from './reported_mission.ts';
import type { Trails } from './trails.ts';
import { shortName } from './words.ts';

const LAYERS = [MapLayer.OCCUPANCY, MapLayer.GAS_MEAN, MapLayer.GAS_VARIANCE];
// Questions for verdicts: of larger maps squares of cells are judged by their middle.
const MOST_QUESTIONS = 16;

// What is looked at. `revision` 0: as it is now.
export type Looked = {
  mission: Mission; revision: bigint; gases: Gases; raster: Raster; trails: Trails; homes: Point2D[] };

// One message, whatever parts it came in, as coarse as `raster`.
async function wholeMap({ mission: { name }, revision, gases, raster }: Looked): Promise<GetMapResponse> {
  let whole: GetMapResponse | null = null;
  let level = 0;
  let partToken = '';
  do {
    const part = await maps.getMap({ mission: name, revision, layers: LAYERS, levelOfDetail: level, partToken,
      species: gases.looked === '' ? [] : [gases.looked] }, PATIENCE);
    const cell_m = part.status?.geometry?.resolutionM ?? NaN;
    if (whole === null && raster.geometry.resolution_m > 1.5 * cell_m && level === 0) {
      level = Math.round(Math.log2(raster.geometry.resolution_m / cell_m));
      continue;
    }
    if (whole === null) whole = part;
    else whole.tiles.push(...part.tiles);
    partToken = part.nextPartToken;
  } while (whole === null || partToken !== '');
  whole.nextPartToken = '';
  return whole;
}

async function objectiveOf({ mission, revision, gases }: Looked, raster: Raster): Promise<ReportedMission['objective']> {
  const asked = mission.options?.objective;
  // It is of the first gas, and so are the means that tell above from below.
  if (asked === undefined || asked.kind === ObjectiveKind.COMPLETE_MAP || !isFirst(gases)) return null;
  const { places, size_m } = squaresOf(raster, MOST_QUESTIONS * MOST_PLACES);
  const verdicts: number[] = [];
  for (let i = 0; i < places.length; i += MOST_PLACES) {
    const points = places.slice(i, i + MOST_PLACES).map((place) => ({ xM: place.x_m, yM: place.y_m }));
    const { gas } = await maps.queryGas({ mission: mission.name, points, withVerdicts: true, revision }, PATIENCE);
    verdicts.push(...gas.map(({ verdict }) => verdict));
  }
  return { asked: base64Of(toBinary(ObjectiveOptionsSchema, create(ObjectiveOptionsSchema, asked))),
           verdicts: base64Of(spread(raster, places, size_m, verdicts)) };
}

// The page. Errors are those of the calls.
export async function reportOf(looked: Looked): Promise<string> {
  const { mission, revision, trails, homes } = looked;
  const map = await wholeMap(looked);
  const raster = rasterOf(map); // it may have grown
  const [page, objective, { latest }] = await Promise.all([
    fetch('report.html').then((answer) => answer.text()),
    raster === null ? null : objectiveOf(looked, raster),
    revision === 0n ? planning.listPlans({ mission: mission.name, withLatest: true }, PATIENCE) : { latest: [] }]);
  return fillReport(page, {
    title: `${shortName(mission.name)}, ${ofGas(looked.gases) === '' ? '' : `gas${ofGas(looked.gases)}, `}revision ${map.revision}`,
    map: base64Of(toBinary(GetMapResponseSchema, map)),
    plans: latest.map((plan) => ({ plan: base64Of(toBinary(PlanSchema, plan)) })),
    ways: [...trails].map(([robot, { points }]) => ({ robot, points_m: points })),
    homes_m: homes.map(({ xM, yM }) => [xM, yM]),
    sources_m: [],
    objective,
  });
}
