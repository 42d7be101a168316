# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Client of the PlumeScout server.

    with plumescout.Client("127.0.0.1:50551") as client:
        client.create_mission("house", exist_ok=True)
        robot = client.register("house", "scout")
        robot.add_scan(time_ns, pose, ranges_m, start_angle_rad, angle_step_rad, max_range_m)
        robot.add_gas(time_ns, pose, concentration_ppm)
        plan = robot.next_best_trajectory()
        ...drive along plan.poses...
        robot.report(plan, "reached")
        gas_ppm = client.get_map("house").gas_mean_ppm

plumescout.aio has the same for asyncio. Poses are (x_m, y_m, yaw_rad) in frame map. Observations
are kept in memory until the server has them on its disk; a robot that must outlive restarts of its
own is better served by the program plumescout-robot. Messages of the wire are in plumescout.v1.
"""

import pathlib
import pkgutil
import sys

# In a tree that is not installed plumescout.v1 is in a folder of its own: build/release/python.
__path__ = pkgutil.extend_path(__path__, __name__)
try:
    import google.rpc.error_details_pb2  # of googleapis-common-protos, if that is installed
except ModuleNotFoundError:  # else ours
    sys.path.append(str(pathlib.Path(__file__).with_name("_wire")))

from .blocking import Client, Robot  # noqa: E402
from .errors import PlumeScoutError  # noqa: E402
from ._log import Rejection  # noqa: E402
from .maps import FREE, OCCUPIED, UNKNOWN, Map, prior_map, prior_map_of_files  # noqa: E402
from .plans import Plan, Pose  # noqa: E402

__all__ = [
    "FREE",
    "OCCUPIED",
    "UNKNOWN",
    "Client",
    "Map",
    "Plan",
    "PlumeScoutError",
    "Pose",
    "Rejection",
    "Robot",
    "prior_map",
    "prior_map_of_files",
]
