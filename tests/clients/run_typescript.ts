// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Runs the scenario with the TypeScript client: run_typescript.ts TARGET SCENARIO; see README.md.
import { createReadStream, openSync, readFileSync, readSync, writeFileSync, writeSync } from 'node:fs';
import { fromJson } from '@bufbuild/protobuf';
import type { JsonValue } from '@bufbuild/protobuf';
import {
  Code, RobotSession, all, connect, encodeRanges, errorOf, exportMission, getMap, importMission, planOf,
  watchMap, watchRobot,
} from '@plumescout/client';
import type { Client, Plan, RobotNotice } from '@plumescout/client';
import * as wire from '@plumescout/client/wire';
import * as reduce from './reduce.ts';

type Numbers = [number, number, number];
type Observation = {
  time_ns: number; pose: Numbers; scan?: string; gas_ppm?: number; stddev_ppm?: number; sensor?: number;
  correction?: [number, Numbers][]; battery_share?: number;
};
type Scenario = {
  scan: { start_angle_rad: number; angle_step_rad: number; max_range_m: number };
  ranges_m: Record<string, (number | 'none' | null)[]>;
  steps: { do: string; with?: never }[];
};
type RobotArguments = { session?: string; mission?: string; robot?: string };
type PlanArguments = { session: string; budget_s: number; seed: number; plan?: string };
type MapArguments = { mission: string; layers?: (keyof typeof wire.MapLayer)[] };

const PLAN_TIMEOUT_S = 60;
const name = (mission: string) => `missions/${mission}`;
const robotName = (mission: string, robot: string) => `missions/${mission}/robots/${robot}`;
const poseOf = ([x_m, y_m, yaw_rad]: Numbers) => ({ x_m, y_m, yaw_rad });
const pointOf = ([xM, yM]: number[]) => ({ xM: xM!, yM: yM! });
const idleOf = (seconds: number) => ({ seconds: BigInt(seconds) });
const layersOf = ({ layers }: MapArguments) =>
  (layers === undefined ? {} : { layers: layers.map((layer) => wire.MapLayer[layer]) });

export class Runner {
  private readonly sessions = new Map<string, { session: RobotSession; rejected: number[] }>();
  private readonly plans = new Map<string | undefined, Plan>();

  constructor(private readonly client: Client, private readonly scenario: Scenario) {}

  // --- The server, and missions.

  async get_server_info() {
    const { features, limits } = await this.client.system.getServerInfo({});
    return { features, max_receive_bytes: limits?.maxReceiveBytes };
  }
  async drain_server() {
    await this.client.system.drainServer({});
  }
  async list_missions() {
    const missions = await all((pageToken) => this.client.missions.listMissions({ pageToken }), (page) => page.missions);
    return { missions: missions.map((one) => reduce.lastPart(one.name)) };
  }
  async create_mission({ mission, options, idle_time_to_live_s, event_retention = 'ALL' }: {
    mission: string; options?: JsonValue; idle_time_to_live_s?: number;
    event_retention?: keyof typeof wire.EventRetention;
  }) {
    return reduce.mission((await this.client.missions.createMission({
      missionId: mission, eventRetention: wire.EventRetention[event_retention],
      ...(options === undefined ? {} : { options: fromJson(wire.MissionOptionsSchema, options) }),
      ...(idle_time_to_live_s === undefined ? {} : { idleTimeToLive: idleOf(idle_time_to_live_s) }),
    })).mission!);
  }
  async get_mission({ mission }: { mission: string }) {
    return reduce.mission((await this.client.missions.getMission({ name: name(mission) })).mission!);
  }
  async pause_mission({ mission }: { mission: string }) {
    return reduce.mission((await this.client.missions.pauseMission({ name: name(mission) })).mission!);
  }
  async resume_mission({ mission }: { mission: string }) {
    return reduce.mission((await this.client.missions.resumeMission({ name: name(mission) })).mission!);
  }
  async finish_mission({ mission }: { mission: string }) {
    return reduce.mission((await this.client.missions.finishMission({ name: name(mission) })).mission!);
  }
  async update_mission({ mission, ...changes }: {
    mission: string; idle_time_to_live_s?: number | null; event_retention?: keyof typeof wire.EventRetention;
  }) {
    const { idle_time_to_live_s: idle, event_retention: retention } = changes;
    return reduce.mission((await this.client.missions.updateMission({
      updateMask: { paths: Object.keys(changes).map((field) => field.replace(/_s$/, '')) },
      mission: {
        name: name(mission),
        ...(typeof idle === 'number' ? { idleTimeToLive: idleOf(idle) } : {}),
        ...(retention === undefined ? {} : { eventRetention: wire.EventRetention[retention] }),
      },
    })).mission!);
  }
  async change_keep_out_areas({ mission, added = {}, deleted = [] }: {
    mission: string; added?: Record<string, [number, number][]>; deleted?: string[];
  }) {
    const { areas } = await this.client.missions.changeKeepOutAreas({
      name: name(mission), deleted,
      added: Object.entries(added).map(([area, corners]) => ({
        name: area, vertices: corners.map(([xM, yM]) => ({ xM, yM })) })),
    });
    return { areas: areas.map((area) => ({
      name: area.name, corners: area.vertices.map(({ xM, yM }) => [xM, yM]) })) };
  }
  async delete_mission({ mission }: { mission: string }) {
    await this.client.missions.deleteMission({ name: name(mission) });
  }

  // --- Robots.

  async register_robot({ session, mission, robot, radius_m, take_over = false, gas_sensors = [] }: {
    session: string; mission: string; robot: string; radius_m: number; take_over?: boolean;
    gas_sensors?: { id: string; ahead_m: number; left_m: number; stddev_ppm: number }[];
  }) {
    const rejected: number[] = [];
    const made = await RobotSession.register(this.client, {
      mission: name(mission), robotId: robot, radius_m, takeOver: take_over, clock_ns: null,
      gasSensors: gas_sensors.map(({ id, ahead_m, left_m, stddev_ppm }) =>
        ({ id, robotFromSensor: { xM: ahead_m, yM: left_m }, stddevPpm: stddev_ppm })),
      onRejected: ({ sequence }) => rejected.push(sequence),
    });
    this.sessions.set(session, { session: made, rejected });
    return { applied_sequence: made.statistics.applied };
  }
  async stream_observations({ session: key, observations }: { session: string; observations: Observation[] }) {
    const { session, rejected } = this.sessions.get(key)!;
    rejected.length = 0;
    for (const one of observations) this.add(session, one);
    await session.applied();
    return { applied_sequence: session.statistics.applied, rejected };
  }
  // The session streams what is new; what has been sent as a batch, too, is taken once.
  async batch_ingest_observations({ session: key, observations }: { session: string; observations: Observation[] }) {
    const { session, rejected } = this.sessions.get(key)!;
    const { robot, leaseToken, statistics } = session;
    rejected.length = 0;
    for (const one of observations) this.add(session, one);
    const { ingestState, rejections } = await this.client.ingest.batchIngestObservations({
      open: { robot, leaseToken },
      batch: { observations: observations.map((one, i) => this.onWire(one, statistics.lastSequence + 1 + i)) },
    });
    await session.applied();
    return { applied_sequence: Number(ingestState!.appliedSequence),
             rejected: [...rejected, ...rejections.map(({ sequence }) => Number(sequence))] };
  }
  private ranges_m(one: Observation): number[] {
    return this.scenario.ranges_m[one.scan!]!.map((range_m) =>
      (range_m === null ? NaN : range_m === 'none' ? Infinity : range_m));
  }
  private add(session: RobotSession, one: Observation): void {
    const time_ns = BigInt(one.time_ns);
    if (one.battery_share !== undefined) {
      session.addStatus({ time_ns, battery_share: one.battery_share });
      return;
    }
    const fix = { time_ns, pose: poseOf(one.pose) };
    const { start_angle_rad, angle_step_rad, max_range_m } = this.scenario.scan;
    if (one.scan !== undefined) {
      session.addScan({ ...fix, ranges_m: this.ranges_m(one), startAngle_rad: start_angle_rad,
                        angleStep_rad: angle_step_rad, maxRange_m: max_range_m });
    } else if (one.gas_ppm !== undefined) {
      session.addGas({ ...fix, concentration_ppm: one.gas_ppm, stddev_ppm: one.stddev_ppm ?? 0,
                       sensor: one.sensor ?? 0 });
    } else {
      session.addCorrection(fix, one.correction!.map(([time, pose]) => ({ time_ns: BigInt(time), pose: poseOf(pose) })));
    }
  }
  private onWire(one: Observation, sequence: number) {
    const [xM, yM, yawRad] = one.pose;
    const { start_angle_rad, angle_step_rad, max_range_m } = this.scenario.scan;
    const scan = one.scan === undefined ? null : encodeRanges(this.ranges_m(one));
    return {
      sequence: BigInt(sequence), sampleTimeNs: BigInt(one.time_ns), pose: { xM, yM, yawRad },
      payload: scan === null
        ? { case: 'gas' as const, value: { concentrationPpm: one.gas_ppm!, stddevPpm: one.stddev_ppm ?? 0,
                                           sensorIndex: one.sensor ?? 0 } }
        : { case: 'scan' as const, value: { startAngleRad: start_angle_rad, angleStepRad: angle_step_rad,
                                            maxRangeM: max_range_m, rangeUnitM: scan.unit_m,
                                            rangesU16: scan.ranges_u16 } },
    };
  }
  async list_robots({ mission }: { mission: string }) {
    const robots = await all((pageToken) => this.client.robots.listRobots({ mission: name(mission), pageToken }),
                             (page) => page.robots);
    return { robots: robots.map((one) => reduce.lastPart(one.onMap!.robot)) };
  }
  async get_robot({ mission, robot }: { mission: string; robot: string }) {
    return reduce.robot((await this.client.robots.getRobot({ name: robotName(mission, robot) })).robot!);
  }
  async watch_robot({ session, mission, robot }: RobotArguments) {
    const notices: AsyncGenerator<RobotNotice> = session === undefined
      ? watchRobot(this.client, robotName(mission!, robot!)) : this.sessions.get(session)!.session.watch();
    for await (const notice of notices) return reduce.standing(notice);
    throw new Error('the watch ended');
  }
  async order_home({ mission, robot, home }: { mission: string; robot?: string; home: boolean }) {
    await this.client.robots.orderHome({ home, target: robot === undefined
      ? { case: 'mission', value: name(mission) } : { case: 'robot', value: robotName(mission, robot) } });
  }
  async release_lease({ session, mission, robot }: RobotArguments) {
    if (session !== undefined) return this.sessions.get(session)!.session.release();
    await this.client.robots.releaseLease({ robot: robotName(mission!, robot!), force: true });
  }
  async remove_robot({ session, mission, robot }: RobotArguments) {
    if (session !== undefined) return this.sessions.get(session)!.session.leave();
    await this.client.robots.removeRobot({ robot: robotName(mission!, robot!), force: true });
  }

  // --- Plans.

  private keep(key: string | undefined, plan: Plan) {
    this.plans.set(key, plan);
    return reduce.plan(plan);
  }
  async next_best_trajectory({ session, budget_s, seed, plan }: PlanArguments) {
    return this.keep(plan, await this.sessions.get(session)!.session.nextBestTrajectory(
      { budget_s, seed: BigInt(seed), timeout_s: PLAN_TIMEOUT_S }));
  }
  async stream_next_best_trajectory({ session, budget_s, seed, plan }: PlanArguments) {
    let latest: Plan | null = null;
    for await (const better of this.sessions.get(session)!.session.streamTrajectories(
      { budget_s, seed: BigInt(seed), timeout_s: PLAN_TIMEOUT_S })) latest = better;
    return this.keep(plan, latest!);
  }
  async check_trajectory({ session, plan, path, goal_kind }: {
    session: string; plan?: string; path?: number[][]; goal_kind?: keyof typeof wire.GoalKind;
  }) {
    const subject = plan === undefined
      ? { vertices: path!.map(pointOf), goalKind: wire.GoalKind[goal_kind!] } : this.plans.get(plan)!;
    return reduce.check(await this.sessions.get(session)!.session.check(subject));
  }
  async list_frontiers({ session }: { session: string }) {
    return { frontiers: (await this.sessions.get(session)!.session.frontiers()).map(reduce.frontier) };
  }
  async report_progress({ session, plan, outcome }: { session: string; plan: string; outcome: string }) {
    await this.sessions.get(session)!.session.report(
      this.plans.get(plan)!, outcome.toLowerCase() as 'reached' | 'blocked' | 'aborted');
  }
  async list_plans({ mission }: { mission: string }) {
    return { plans: (await this.client.planning.listPlans({ mission: name(mission) })).plans.map(reduce.livePlan) };
  }
  async plan_team({ mission, robots, seed, budget_s, max_order_count }: {
    mission: string; robots: string[]; seed: number; budget_s: number; max_order_count: number;
  }) {
    const { plans, leftOut } = await this.client.planning.planTeam({
      mission: name(mission), robots: robots.map((robot) => robotName(mission, robot)), seed: BigInt(seed),
      planningBudget: idleOf(budget_s), maxOrderCount: max_order_count,
    }, { timeoutMs: 1000 * PLAN_TIMEOUT_S });
    return reduce.team({ plans: plans.map(planOf), leftOut });
  }

  // --- Maps.

  async get_map({ full_precision = true, region, level_of_detail = 0, max_part_bytes = 0, revision = 0, ...of }:
                MapArguments & { full_precision?: boolean; region?: number[]; level_of_detail?: number;
                                 max_part_bytes?: number; revision?: number }) {
    return reduce.area(await getMap(this.client, name(of.mission), {
      ...layersOf(of), fullPrecision: full_precision, levelOfDetail: level_of_detail, maxPartBytes: max_part_bytes,
      revision: BigInt(revision), freshPosterior: true,
      ...(region === undefined ? {} : { region: { min: pointOf(region), max: pointOf(region.slice(2)) } }),
    }), of.layers);
  }
  async watch_map({ during, ...of }: MapArguments & { during?: { session: string; observations: Observation[] } }) {
    let wanted: { robot: string; applied: number } | null = null;
    for await (const map of watchMap(this.client, name(of.mission), { ...layersOf(of), fullPrecision: true })) {
      if (during === undefined) return reduce.area(map, of.layers);
      wanted ??= { robot: this.sessions.get(during.session)!.session.robot,
                   applied: (await this.stream_observations(during)).applied_sequence };
      const { robot, applied } = wanted;
      const seen = map.status.robots.find((one) => one.robot === robot);
      if (Number(seen?.appliedSequence ?? 0n) >= applied) return reduce.area(map, of.layers);
    }
    throw new Error('the watch ended');
  }
  async query_gas({ mission, points, revision = 0 }: { mission: string; points: number[][]; revision?: number }) {
    const { gas, sampleTimeNs } = await this.client.maps.queryGas({
      mission: name(mission), points: points.map(pointOf), freshPosterior: true, revision: BigInt(revision) });
    return {
      mean_ppm: gas.map((one) => one.meanPpm ?? null), variance_ppm2: gas.map((one) => one.variancePpm2 ?? null),
      nearest_reading_m: gas.map((one) => one.nearestReadingM ?? null),
      nearest_reading_age_s: gas.map(({ nearestReadingTimeNs: time_ns }) =>
        time_ns === undefined ? null : Number(sampleTimeNs - time_ns) / 1e9),
    };
  }

  // --- Files.

  async export_mission({ mission, file, format = 'JOURNAL' }: {
    mission: string; file: string; format?: keyof typeof wire.MissionFileFormat }) {
    const pieces: Uint8Array[] = [];
    for await (const { data } of exportMission(this.client, name(mission), { format: wire.MissionFileFormat[format] })) {
      pieces.push(data);
    }
    writeFileSync(file, Buffer.concat(pieces));
    return { mission };
  }
  async import_mission({ file, mission }: { file: string; mission: string }) {
    return reduce.mission(await importMission(this.client, createReadStream(file), { missionId: mission }));
  }
  async get_mission_history({ mission, kinds }: { mission: string; kinds: (keyof typeof wire.MissionEventKind)[] }) {
    const events = await all((pageToken) => this.client.snapshots.getMissionHistory({
      mission: name(mission), kinds: kinds.map((kind) => wire.MissionEventKind[kind]), pageToken,
    }), (page) => page.events);
    return { events: events.map(reduce.event) };
  }
  async get_mission_figures({ mission }: { mission: string }) {
    for (;;) {
      const { figures, moreFollow } = await this.client.snapshots.getMissionFigures({ mission: name(mission) });
      if (!moreFollow) return reduce.figures(figures.at(-1)!);
    }
  }
}

// What the server refused; anything else ends the runner.
function refusalOf(thrown: unknown) {
  const { code, reason, fields } = errorOf(thrown);
  if (code === Code.Unknown) throw thrown;
  return { code: Code[code].replace(/(?<!^)(?=[A-Z])/g, '_').toUpperCase(), reason, fields };
}

// What a step brings. Streams are not begun again by the client: whoever is told that a server takes
// the mission over does it, as robots do.
async function patiently<T>(task: () => Promise<T>): Promise<T> {
  for (let retry = 0; retry < 100; ++retry) {
    try {
      return await task();
    } catch (error) {
      if (!['RECOVERING', 'MISSION_ELSEWHERE'].includes(errorOf(error).reason)) throw error;
    }
    await new Promise((resolve) => setTimeout(resolve, 200));
  }
  return await task();
}

const [target, path] = process.argv.slice(2);
const client = connect(target!, { timeout_s: 60 });
const scenario = JSON.parse(readFileSync(path!, 'utf8')) as Scenario;
const runner = new Runner(client, scenario);
const input = openSync('/dev/stdin', 'r');
for (const step of scenario.steps) {
  const task = step.do === 'restart' ? async () => {} : runner[step.do as Exclude<keyof Runner, never>] as
    (this: Runner, given: unknown) => Promise<object | void>;
  const told = await patiently(() => task.call(runner, step.with ?? {})).then(
    (result) => ({ result: result ?? {} }), (thrown) => ({ error: refusalOf(thrown) }));
  writeSync(1, `${JSON.stringify({ do: step.do, ...told })}\n`);
  if (step.do === 'restart') readSync(input, new Uint8Array(1 << 10));
}
client.close();
process.exit(0);
