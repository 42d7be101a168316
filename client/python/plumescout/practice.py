# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A room with a gas leak that is not there, to practise with before there is a robot."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import numpy.typing as npt

from .plans import Pose

_LONGEST_M = 1e9  # of a beam along a wall


@dataclasses.dataclass(frozen=True)
class Room:
    """Four walls, with a corner at the origin, and gas that is thickest at the leak."""

    width_m: float
    depth_m: float
    leak_m: tuple[float, float]
    leak_ppm: float = 20.0
    spread_m: float = 1.0
    beams: int = 180
    max_range_m: float = 8.0

    def scan(self, pose: Pose) -> tuple[npt.NDArray[np.float64], float, float, float]:
        """What a lidar sees all around, as add_scan wants it: ranges_m, start_angle_rad,
        angle_step_rad, max_range_m."""
        x_m, y_m, yaw_rad = pose
        step_rad = math.tau / self.beams
        angles_rad = yaw_rad + step_rad * np.arange(self.beams)
        to_wall_m = np.minimum(
            _to_walls_m(x_m, self.width_m, np.cos(angles_rad)),
            _to_walls_m(y_m, self.depth_m, np.sin(angles_rad)),
        )
        ranges_m = np.where(to_wall_m > self.max_range_m, np.inf, to_wall_m)
        return ranges_m, 0.0, step_rad, self.max_range_m

    def gas_ppm(self, pose: Pose) -> float:
        return self.leak_ppm * math.exp(-((math.dist(pose[:2], self.leak_m) / self.spread_m) ** 2))


def _to_walls_m(
    at_m: float, end_m: float, direction: npt.NDArray[np.float64]
) -> npt.NDArray[np.float64]:
    wall_m = np.where(direction > 0.0, end_m, 0.0)
    safe = np.where(np.abs(direction) < 1.0 / _LONGEST_M, 1.0 / _LONGEST_M, direction)
    to_wall_m: npt.NDArray[np.float64] = np.abs((wall_m - at_m) / safe)
    return to_wall_m
