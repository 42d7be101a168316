// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// One robot's part in a mission.
import { create } from '@bufbuild/protobuf';
import type { MessageInitShape } from '@bufbuild/protobuf';
import { durationFromMs } from '@bufbuild/protobuf/wkt';
import { OwnAbort } from './abort.ts';
import type { Client } from './client.ts';
import { IngestLoop } from './ingest_loop.ts';
import type { Standing } from './ingest_loop.ts';
import { planOf } from './plan.ts';
import type { Plan } from './plan.ts';
import { encodeRanges } from './ranges.ts';
import { DEFAULT_LOG, RobotLog } from './robot_log.ts';
import type { LogOptions } from './robot_log.ts';
import { watchRobot } from './watch_robot.ts';
import type { RobotNotice } from './watch_robot.ts';
import type { CallError } from './errors.ts';
import { ObservationSchema, ReportProgressRequest_Outcome } from './wire/index.ts';
import type {
  CheckTrajectoryResponse, FrontierGoal, GasSensorSchema, IntendedPathSchema, ObservationRejected,
  Pose2DSchema, RegisterRobotRequestSchema, RegisterRobotResponse, RobotFrameSchema,
} from './wire/index.ts';

export type { LogOptions };
/** In frame map, or in the robot's own if it registered with one. */
export type Pose = { x_m: number; y_m: number; yaw_rad: number };
/** At a time, by the robot's clock, nanoseconds since the Unix epoch. */
export type PoseFix = { time_ns: bigint; pose: Pose };
export type ScanSample = PoseFix & {
  ranges_m: ArrayLike<number>; // Infinity: nothing seen, NaN: the beam says nothing
  startAngle_rad: number; // of beam 0, from the robot's heading
  angleStep_rad: number;
  maxRange_m: number; // beyond which nothing is seen
};
export type GasSample = PoseFix & {
  concentration_ppm: number;
  stddev_ppm?: number; // absent: that of the sensor, or of the mission's model
  sensor?: number; // its place among those that the robot registered; 0
};
export type BatterySample = { time_ns: bigint; battery_share: number }; // of a full one
export type Refusal = { sequence: number; message: string };

export type RegisterOptions = {
  mission: string; // missions/{mission}
  robotId: string;
  radius_m: number;
  takeOver?: boolean; // supersede a lease that another client holds
  frame?: MessageInitShape<typeof RobotFrameSchema>; // of the poses of observations; the mission's
  gasSensors?: MessageInitShape<typeof GasSensorSchema>[]; // one, calibrated, at the robot's pose
  // The robot's time now, from which the server learns how far its clock is off. null: it is taken as
  // it is, as of simulations that do not keep real time. Default: of this computer.
  clock_ns?: (() => bigint) | null;
  log?: Partial<LogOptions>;
  onRejected?: (refusal: Refusal) => void; // default: a warning on the console
  onLink?: (up: boolean, error: CallError | null) => void;
};

export type PlanOptions = {
  start?: Pose; // absent: the latest, or where the robot will be; frame map
  budget_s?: number; // time for planning; 1
  seed?: bigint; // of the draws; absent: derived from the mission's
  goHome?: boolean;
  timeout_s?: number; // of all; 10 s more than the budget
  signal?: AbortSignal;
};

export type SessionStatistics = {
  lastSequence: number; // added up to here
  applied: number; // as last acknowledged
  durable: number; // likewise; 0 of a server that keeps nothing on disk
  rejected: number; // they count as applied
  lost: number; // dropped from a full log before any server had applied them
  reconnects: number;
};

const OUTCOMES = {
  reached: ReportProgressRequest_Outcome.REACHED,
  blocked: ReportProgressRequest_Outcome.BLOCKED,
  aborted: ReportProgressRequest_Outcome.ABORTED,
};
const CALL_TIMEOUT_S = 10;

const poseOf = ({ x_m, y_m, yaw_rad }: Pose): MessageInitShape<typeof Pose2DSchema> =>
  ({ xM: x_m, yM: y_m, yawRad: yaw_rad });

// Below 2^53, and not 0.
const newLogEpoch = () => 1 + Math.floor(Math.random() * (Number.MAX_SAFE_INTEGER - 1));

// See IngestOptions.rejoin. Who has taken the robot over since keeps it.
function rejoining(client: Client, request: MessageInitShape<typeof RegisterRobotRequestSchema>,
                   bootId: string): () => Promise<Standing | null> {
  return async () => {
    if ((await client.system.getServerInfo({})).bootId === bootId) return null;
    const again = await client.robots.registerRobot({ ...request, takeOver: false });
    const applied = Number(again.ingestState?.appliedSequence ?? 0n);
    if (applied > 0 && !again.logContinues) throw new Error('another client has told of this robot since');
    bootId = again.serverBootId;
    return { leaseToken: again.leaseToken, applied };
  };
}

/** Observations are numbered, kept, and sent as the server has credit for them; nothing that adds them
 * waits. A link that breaks is opened again, and the log goes on where the server says. The log is in
 * memory: a robot that must outlive restarts of its own is better served by plumescout-robot.
 * Methods that ask the server first wait until it has applied what was added. They throw what the call
 * threw, or why the session has ended: another client has the lease (LEASE_SUPERSEDED), the robot is
 * not of the mission any more (NotFound), or a callback threw. Where a server has lost the robot as it
 * restarted, the robot registers again. */
export class RobotSession {
  private rejected = 0;
  private readonly loop: IngestLoop;

  private constructor(private readonly client: Client, readonly robot: string,
                      private readonly log: RobotLog, options: RegisterOptions,
                      request: MessageInitShape<typeof RegisterRobotRequestSchema>,
                      registered: RegisterRobotResponse) {
    const onRejected = options.onRejected ??
      ((refusal) => console.warn(`${robot}: observation ${refusal.sequence} refused: ${refusal.message}`));
    this.loop = new IngestLoop(client, log, {
      robot, leaseToken: registered.leaseToken, rejoin: rejoining(client, request, registered.serverBootId),
      clock_ns: options.clock_ns === undefined ? () => BigInt(Date.now()) * 1_000_000n : options.clock_ns,
      onRejected: ({ sequence, status }: ObservationRejected) => {
        ++this.rejected;
        onRejected({ sequence: Number(sequence), message: status?.message ?? '' });
      },
      onLink: options.onLink ?? (() => {}),
    });
  }

  /** Joins a mission, or comes back to it. Errors are those of RegisterRobot, as LEASE_HELD. */
  static async register(client: Client, options: RegisterOptions): Promise<RobotSession> {
    const { mission, robotId, radius_m, takeOver = false, gasSensors = [], frame } = options;
    const request = {
      mission, robotId, radiusM: radius_m, takeOver, gasSensors, logEpoch: BigInt(newLogEpoch()),
      ...(frame === undefined ? {} : { frame }),
    };
    const registered = await client.robots.registerRobot(request);
    // The log is a new one: it begins after whatever the server has of this robot.
    const log = new RobotLog(Number(registered.ingestState?.appliedSequence ?? 0n),
                             { ...DEFAULT_LOG, ...options.log });
    return new RobotSession(client, registered.robot, log, options, request, registered);
  }

  /** Another one once the robot has registered again. */
  get leaseToken(): bigint {
    return this.loop.leaseToken;
  }
  get statistics(): SessionStatistics {
    const { applied, durable, reconnects } = this.loop;
    return { lastSequence: this.log.lastSequence, applied, durable, rejected: this.rejected,
             lost: this.log.lost, reconnects };
  }

  /** Numbers a scan. Returns its number. */
  addScan({ time_ns, pose, ranges_m, startAngle_rad, angleStep_rad, maxRange_m }: ScanSample): number {
    const { ranges_u16, unit_m } = encodeRanges(ranges_m);
    return this.add({ sampleTimeNs: time_ns, pose: poseOf(pose), payload: { case: 'scan', value: {
      startAngleRad: startAngle_rad, angleStepRad: angleStep_rad, maxRangeM: maxRange_m,
      rangeUnitM: unit_m, rangesU16: ranges_u16,
    } } });
  }
  /** Numbers a gas reading. Returns its number. */
  addGas({ time_ns, pose, concentration_ppm, stddev_ppm = 0, sensor = 0 }: GasSample): number {
    return this.add({ sampleTimeNs: time_ns, pose: poseOf(pose), payload: { case: 'gas', value: {
      concentrationPpm: concentration_ppm, stddevPpm: stddev_ppm, sensorIndex: sensor,
    } } });
  }
  /** Numbers what the robot tells of itself. Returns its number. */
  addStatus({ time_ns, battery_share }: BatterySample): number {
    return this.add({ sampleTimeNs: time_ns, payload: { case: 'status', value: { batteryShare: battery_share } } });
  }
  /** Poses of before were wrong, as after a loop closure: the right ones at some of the times at which
   * something was observed, in their order. The way between is interpolated, beyond them it is moved
   * rigidly. The fix itself, and poses after it, are right. Returns its number. */
  addCorrection({ time_ns, pose }: PoseFix, anchors: PoseFix[]): number {
    return this.add({ sampleTimeNs: time_ns, pose: poseOf(pose), payload: { case: 'correction', value: {
      anchors: anchors.map((anchor) => ({ sampleTimeNs: anchor.time_ns, pose: poseOf(anchor.pose) })),
    } } });
  }

  /** Waits until the server has applied all that was added so far. Throws if it has not in time. */
  async applied(timeout_s = CALL_TIMEOUT_S, signal?: AbortSignal): Promise<void> {
    const sequence = this.log.lastSequence;
    await this.waitFor(() => this.loop.applied >= sequence, timeout_s, signal);
  }
  /** The same, until it is safe on the server's disk, if that keeps anything there. */
  async durable(timeout_s = CALL_TIMEOUT_S, signal?: AbortSignal): Promise<void> {
    const sequence = this.log.lastSequence;
    await this.waitFor(() => this.loop.applied >= sequence &&
      (this.loop.durable === 0 || this.loop.durable >= sequence), timeout_s, signal);
  }

  /** Where to drive next, or the way home. */
  async nextBestTrajectory(options: PlanOptions = {}): Promise<Plan> {
    const { request, call } = await this.planning(options);
    const { plan } = await this.client.planning.nextBestTrajectory(request, call);
    if (plan === undefined) throw new Error('the server answered without a plan');
    return planOf(plan);
  }
  /** Better and better plans; the last is the one to drive. Leaving the loop before its end cancels
   * the search, and nothing is committed. */
  async* streamTrajectories(options: PlanOptions = {}): AsyncGenerator<Plan, void> {
    const { request, call } = await this.planning(options);
    const abort = new OwnAbort(options.signal);
    try {
      const stream = this.client.planning.streamNextBestTrajectory(request, { ...call, signal: abort.signal });
      for await (const { plan } of stream) if (plan !== undefined) yield planOf(plan);
    } finally {
      abort.end();
    }
  }
  /** Whether the rest of the robot's latest plan, or a path, still holds: blockage and rejectedGoal
   * are set if something is wrong with the way or the goal. */
  async check(subject: Plan | MessageInitShape<typeof IntendedPathSchema>): Promise<CheckTrajectoryResponse> {
    await this.applied();
    return this.client.planning.checkTrajectory({
      ...this.lease(), minAppliedSequence: BigInt(this.log.lastSequence),
      subject: 'message' in subject ? { case: 'plan', value: subject.name } : { case: 'path', value: subject },
    });
  }
  /** Where this robot could go, and why not. */
  async frontiers(): Promise<FrontierGoal[]> {
    await this.applied();
    return (await this.client.planning.listFrontiers({ robot: this.robot })).frontiers;
  }
  /** How a plan ended. */
  async report(plan: Plan, outcome: keyof typeof OUTCOMES): Promise<void> {
    await this.applied();
    await this.client.planning.reportProgress({ ...this.lease(), plan: plan.name, outcome: OUTCOMES[outcome] });
  }
  /** What the robot has to know without having asked; see watchRobot. */
  watch(signal?: AbortSignal): AsyncGenerator<RobotNotice, void> {
    return watchRobot(this.client, this.robot, {
      leaseToken: this.leaseToken, ...(signal === undefined ? {} : { signal }) });
  }

  /** Gives up the lease: another client may take the robot over at once. It stays in the mission. */
  async release(): Promise<void> {
    await this.applied();
    this.close();
    await this.client.robots.releaseLease(this.lease());
  }
  /** Leaves the mission; registering again goes on with the log. */
  async leave(): Promise<void> {
    await this.applied();
    this.close();
    await this.client.robots.removeRobot(this.lease());
  }
  /** Ends the stream. What is not applied by now is lost with this session. */
  close(): void {
    this.loop.close();
  }

  private lease(): { robot: string; leaseToken: bigint } {
    return { robot: this.robot, leaseToken: this.leaseToken };
  }

  private add(observation: MessageInitShape<typeof ObservationSchema>): number {
    const sequence = this.log.append(create(ObservationSchema, observation));
    this.loop.noteAdded();
    return sequence;
  }

  private async planning(options: PlanOptions) {
    const { start, budget_s = 1, seed = 0n, goHome = false, signal } = options;
    const timeout_s = options.timeout_s ?? budget_s + CALL_TIMEOUT_S;
    const begun_ms = performance.now();
    await this.applied(timeout_s, signal);
    return {
      request: {
        ...this.lease(), minAppliedSequence: BigInt(this.log.lastSequence), seed, goHome,
        planningBudget: durationFromMs(1000 * budget_s),
        ...(start === undefined ? {} : { start: poseOf(start) }),
      },
      call: {
        timeoutMs: Math.max(1, Math.ceil(1000 * timeout_s - (performance.now() - begun_ms))),
        ...(signal === undefined ? {} : { signal }),
      },
    };
  }

  private async waitFor(holds: () => boolean, timeout_s: number, signal?: AbortSignal): Promise<void> {
    if (holds()) return;
    const patience = new OwnAbort(signal);
    const timer = setTimeout(() => patience.end(), 1000 * timeout_s);
    try {
      if (await this.loop.until(holds, patience.signal)) return;
    } finally {
      clearTimeout(timer);
      patience.end();
    }
    signal?.throwIfAborted();
    throw new Error(`the server has applied observation ${this.loop.applied} of ${this.log.lastSequence} ` +
                    `after ${timeout_s} s`);
  }
}
