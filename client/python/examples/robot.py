# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A robot that maps a room with a gas leak: robot.py [HOST:PORT]. Its room is made up."""

import sys
import time

import plumescout
from plumescout.practice import Room

room = Room(width_m=6.0, depth_m=4.0, leak_m=(4.5, 3.0))

with plumescout.Client(*sys.argv[1:]) as client:
    client.create_mission("room", exist_ok=True)
    robot = client.register("room", "scout", radius_m=0.2, take_over=True)

    def sense(pose):
        robot.add_scan(time.time_ns(), pose, *room.scan(pose))
        robot.add_gas(time.time_ns(), pose, room.gas_ppm(pose))

    for _ in range(4):  # a cell takes three beams to become free
        sense((1.0, 1.0, 0.1))
    while plan := robot.next_best_trajectory():  # sends what was sensed, and knows it
        print(plan.explanation)
        for pose in plan.every(0.2):  # here the robot jumps from one to the next
            sense(pose)
        robot.report(plan, "reached")
    client.get_map("room").save("room.yaml")  # for map_server, with room.pgm
    client.get_map("room").save("gas.npy")
