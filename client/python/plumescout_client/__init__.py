# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A small client of the PlumeScout server for scripts and notebooks.

    with plumescout_client.Client("127.0.0.1:50551") as client:
        client.create_mission("house", exist_ok=True)
        robot = client.register("house", "scout")
        robot.add_scan(time_ns, pose, ranges_m, start_angle_rad, angle_step_rad, max_range_m)
        robot.add_gas(time_ns, pose, concentration_ppm)
        plan = robot.next_best_trajectory()
        ...drive along plan.poses...
        robot.report(plan, "reached")
        gas_ppm = client.get_map("house").gas_mean_ppm

Poses are (x_m, y_m, yaw_rad) in frame map. Observations are kept in memory until the server has them
on its disk, or has applied them if it keeps nothing there; a robot that must outlive restarts of its
own is better served by the program plumescout-robot.
The generated stubs (plumescout.v1, google.rpc) must be on PYTHONPATH: build/release/python.
"""

from .client import Client
from .errors import PlumeScoutError
from .robot import Robot
from .values import (
    FREE,
    OCCUPIED,
    UNKNOWN,
    Map,
    Plan,
    Rejection,
    prior_map,
    prior_map_of_files,
)

__all__ = [
    "FREE",
    "OCCUPIED",
    "UNKNOWN",
    "Client",
    "Map",
    "Plan",
    "PlumeScoutError",
    "Rejection",
    "Robot",
    "prior_map",
    "prior_map_of_files",
]
