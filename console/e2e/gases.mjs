// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A mission of two gases, whose robot stands in a room and reads both: methane in the east, ammonia in the west.
import { RobotSession } from '@plumescout/client';

const ROOM_M = 8, BEAMS = 180, STEP_RAD = 2 * Math.PI / BEAMS;

function ranges({ x_m, y_m }) {
  return Float64Array.from({ length: BEAMS }, (_, i) => {
    const [dx, dy] = [Math.cos(i * STEP_RAD), Math.sin(i * STEP_RAD)];
    return Math.min(dx > 0 ? (ROOM_M - x_m) / dx : -x_m / dx, dy > 0 ? (ROOM_M - y_m) / dy : -y_m / dy);
  });
}

// The robot's session, which holds its lease.
export async function measureTwoGases(client, mission) {
  const gases = ['methane', 'ammonia'];
  await client.missions.createMission({ missionId: mission, options: { gasSpecies: gases.map((name) => ({ name })) } });
  const robot = await RobotSession.register(client, { mission: `missions/${mission}`, robotId: 'sniffer', radius_m: 0.2,
    clock_ns: null, takeOver: true, gasSensors: gases.map((species) => ({ id: species, species })) });
  let time_ns = 1_000_000_000_000n;
  for (let i = 0; i < 12; ++i) {
    const pose = { x_m: 1 + 0.5 * i, y_m: 4.1, yaw_rad: 0 };
    for (let k = 0; k < 4; ++k) { // a cell is free once it was seen more than once
      time_ns += 250_000_000n;
      robot.addScan({ time_ns, pose, ranges_m: ranges(pose), startAngle_rad: 0, angleStep_rad: STEP_RAD, maxRange_m: 12 });
    }
    for (const [sensor, east] of [[0, 1], [1, 0]]) {
      robot.addGas({ time_ns, pose, sensor, concentration_ppm: (east ? pose.x_m : ROOM_M - pose.x_m) * (east ? 4 : 1) });
    }
  }
  await robot.applied();
  return robot;
}
