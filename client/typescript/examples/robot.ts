// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A whole robot in a hundred lines: it maps a room with a gas leak that is not there.
//
//   node robot.ts [TARGET [MISSION]]      Node 22.18 or newer; before, through tsx or esbuild
import { Code, RobotSession, connect, errorOf } from '@plumescout/client';
import type { Plan, Pose } from '@plumescout/client';

const ROOM = { width_m: 8, depth_m: 6 };
const LEAK = { x_m: 6.5, y_m: 4.5, peak_ppm: 40, spread_m: 1.2 };
const BEAMS = 120;
const LIDAR = { startAngle_rad: 0, angleStep_rad: 2 * Math.PI / BEAMS, maxRange_m: 3 };
const LEG_PAUSE_NS = 500_000_000n; // between two poses, of the robot's clock, which is not a real one

const [target = '127.0.0.1:50551', mission = 'room'] = process.argv.slice(2);
const client = connect(target);
try {
  await client.missions.createMission({ missionId: mission, options: { planning: { speedMps: 0.5 } } });
} catch (error) {
  if (errorOf(error).code !== Code.AlreadyExists) throw error;
}
const robot = await RobotSession.register(client, {
  mission: `missions/${mission}`, robotId: 'scout', radius_m: 0.2, clock_ns: null, takeOver: true });

let time_ns = 1_000_000_000_000n;
let pose: Pose = { x_m: 1.5, y_m: 1.5, yaw_rad: 0 };

// What a lidar sees of four walls.
function scan({ x_m, y_m, yaw_rad }: Pose): Float64Array {
  return Float64Array.from({ length: BEAMS }, (_, i) => {
    const angle = yaw_rad + i * LIDAR.angleStep_rad;
    const [dx, dy] = [Math.cos(angle), Math.sin(angle)];
    const range_m = Math.min(dx > 0 ? (ROOM.width_m - x_m) / dx : -x_m / dx,
                             dy > 0 ? (ROOM.depth_m - y_m) / dy : -y_m / dy);
    return range_m > LIDAR.maxRange_m ? Infinity : range_m;
  });
}

function sense(): void {
  time_ns += LEG_PAUSE_NS;
  robot.addScan({ time_ns, pose, ranges_m: scan(pose), ...LIDAR });
  const distance_m = Math.hypot(pose.x_m - LEAK.x_m, pose.y_m - LEAK.y_m);
  robot.addGas({ time_ns, pose, concentration_ppm: LEAK.peak_ppm * Math.exp(-((distance_m / LEAK.spread_m) ** 2)) });
}

function drive(plan: Plan): void {
  for (let i = 0; i < plan.x_m.length; ++i) {
    pose = { x_m: plan.x_m[i]!, y_m: plan.y_m[i]!, yaw_rad: plan.yaw_rad[i]! };
    sense();
  }
}

for (let i = 0; i < 5; ++i) sense(); // a cell is free once it was seen more than once
for (;;) {
  const plan = await robot.nextBestTrajectory();
  console.log(plan.explanation);
  if (plan.complete) break;
  drive(plan);
  if (plan.name !== '') await robot.report(plan, 'reached');
}
await robot.leave();
client.close();
