# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A robot that maps a room with a gas leak: robot.py [HOST:PORT]. Its room is made up; write your
own scan, gas_ppm and drive instead."""

import math
import sys
import time

import plumescout

ROOM_M, LEAK_M, BEAMS = (6.0, 4.0), (4.5, 3.0), 180


def scan(pose):  # metres to the wall, beam by beam, counter-clockwise from straight ahead
    for beam in range(BEAMS):
        angle_rad = pose[2] + beam * math.tau / BEAMS
        dx, dy = math.cos(angle_rad) or 1e-9, math.sin(angle_rad) or 1e-9
        to_x = ((ROOM_M[0] if dx > 0 else 0.0) - pose[0]) / dx
        to_y = ((ROOM_M[1] if dy > 0 else 0.0) - pose[1]) / dy
        yield min(to_x, to_y)


def gas_ppm(pose):
    return 20.0 * math.exp(-math.dist(pose[:2], LEAK_M) ** 2)


def drive(plan):  # poses on the way, one every 0.2 m; here the robot jumps from one to the next
    for (x_m, y_m, _), end in zip(plan.poses, plan.poses[1:]):
        for step in range(steps := 1 + int(math.dist((x_m, y_m), end[:2]) / 0.2)):
            share = (step + 1) / steps
            yield x_m + share * (end[0] - x_m), y_m + share * (end[1] - y_m), end[2]


with plumescout.Client(sys.argv[1] if len(sys.argv) > 1 else "127.0.0.1:50551") as client:
    client.create_mission("room", exist_ok=True)
    robot = client.register("room", "scout", radius_m=0.2, take_over=True)

    def sense(pose):
        robot.add_scan(time.time_ns(), pose, list(scan(pose)), 0.0, math.tau / BEAMS, 8.0)
        robot.add_gas(time.time_ns(), pose, gas_ppm(pose))

    for _ in range(4):  # a cell takes three beams to become free
        sense((1.0, 1.0, 0.1))
    while plan := robot.next_best_trajectory():  # sends what was sensed, and knows it
        print(plan.explanation)
        for pose in drive(plan):
            sense(pose)
        robot.report(plan, "reached")
    client.get_map("room").save("room.yaml")  # for map_server, with room.pgm
    client.get_map("room").save("gas.npy")
