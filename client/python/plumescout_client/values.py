# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What calls take and return: plans, maps, poses, ranges."""

import base64
import dataclasses
import pathlib
import re
import zlib

import numpy as np

from plumescout.v1 import map_service_pb2 as map_pb
from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import types_pb2 as types_pb

UNKNOWN, FREE, OCCUPIED = 0, 1, 2  # values of Map.occupancy

_RANGE_UNIT_M = 0.005
_NO_RETURN, _INVALID = 0, 65535  # counts of ranges_u16 with a meaning of their own


@dataclasses.dataclass(frozen=True)
class Rejection:
    """An observation that the server refused; it counts as applied."""

    sequence: int
    message: str


@dataclasses.dataclass(frozen=True)
class Plan:
    """The answer to "where next"; `proto` holds all candidates with their costs."""

    proto: planning_pb.Plan

    @property
    def complete(self):
        return self.proto.phase == types_pb.MISSION_PHASE_COMPLETE

    @property
    def explanation(self):
        return self.proto.explanation

    @property
    def poses(self):
        """Way points as an array of shape (n, 3): x_m, y_m, yaw_rad; the first is the start."""
        points = self.proto.trajectory.waypoints
        return np.array([(p.pose.x_m, p.pose.y_m, p.pose.yaw_rad) for p in points]).reshape(-1, 3)

    @property
    def arrival_s(self):
        """Arrival at each way point, seconds since departure."""
        return np.array([p.arrival_time_s for p in self.proto.trajectory.waypoints])

    @property
    def dwell_s(self):
        """Standing time at each way point."""
        return np.array([p.dwell_s for p in self.proto.trajectory.waypoints])


@dataclasses.dataclass(frozen=True)
class Map:
    """A map at one revision. Arrays have shape (rows, columns), row 0 in the south."""

    revision: int
    status: map_pb.MapStatus  # of the map in full detail: geometry, frontiers, robots, phase ...
    geometry: types_pb.GridGeometry  # of the arrays
    occupancy: np.ndarray  # uint8: UNKNOWN, FREE or OCCUPIED
    gas_mean_ppm: np.ndarray  # float32, NaN off free cells; of the gas that was asked for
    gas_variance_ppm2: np.ndarray  # likewise

    def cell(self, x_m, y_m):
        """(row, column) of a point; it may lie outside the arrays."""
        geometry = self.geometry
        return (
            int(np.floor((y_m - geometry.origin.y_m) / geometry.resolution_m)),
            int(np.floor((x_m - geometry.origin.x_m) / geometry.resolution_m)),
        )


def prior_map(occupancy, resolution_m, origin_m=(0.0, 0.0)):
    """A known building for create_mission({"prior_map": ...}).

    occupancy: array of UNKNOWN, FREE and OCCUPIED, shape (rows, columns), row 0 in the south;
    origin_m: its south-west corner, whole multiples of the resolution, which is the mission's
    occupancy.resolution_m."""
    cells = np.asarray(occupancy, dtype=np.uint8)
    rows, columns = cells.shape
    return {
        "cells": {
            "geometry": {
                "origin": {"x_m": origin_m[0], "y_m": origin_m[1]},
                "resolution_m": resolution_m,
                "column_count": columns,
                "row_count": rows,
            },
            "deflated_data": base64.b64encode(zlib.compress(cells.tobytes())).decode(),
        }
    }


def prior_map_of_files(yaml_path):
    """The same from the files of ROS map_server: a YAML file and the PGM image that it names. An
    image beyond the server's limits.max_receive_bytes has to go through prior_map."""
    yaml_path = pathlib.Path(yaml_path)
    yaml = yaml_path.read_text()
    image = re.search(r"^image:\s*(.+?)\s*$", yaml, re.MULTILINE)
    if image is None:
        raise ValueError(f"{yaml_path} names no image")
    pgm = (yaml_path.parent / image.group(1).strip("'\"")).read_bytes()
    return {"files": {"yaml": yaml, "pgm": base64.b64encode(pgm).decode()}}


def _pose(pose):
    x_m, y_m, yaw_rad = pose
    return types_pb.Pose2D(x_m=x_m, y_m=y_m, yaw_rad=yaw_rad)


def _points(points):
    return [types_pb.Point2D(x_m=x_m, y_m=y_m) for x_m, y_m in points]


def _encode_ranges(ranges_m):
    seen = np.isfinite(ranges_m) & (ranges_m > 0)
    longest_m = ranges_m[seen].max(initial=0.0)
    unit_m = max(_RANGE_UNIT_M, longest_m / (_INVALID - 1))
    counts = np.full(ranges_m.shape, _INVALID)
    counts[seen] = np.clip(np.round(ranges_m[seen] / unit_m), 1, _INVALID - 1)
    counts[np.isposinf(ranges_m)] = _NO_RETURN
    return counts, unit_m


def _map_from_proto(parts):
    geometry = parts[0].tile_geometry
    shape = (geometry.row_count, geometry.column_count)
    layers = {
        map_pb.MAP_LAYER_OCCUPANCY: np.full(shape, UNKNOWN, np.uint8),
        map_pb.MAP_LAYER_GAS_MEAN: np.full(shape, np.nan, np.float32),
        map_pb.MAP_LAYER_GAS_VARIANCE: np.full(shape, np.nan, np.float32),
    }
    for tile in (tile for part in parts for tile in part.tiles):
        row, column = tile.min_cell.row, tile.min_cell.column
        layers[tile.layer][row : row + tile.row_count, column : column + tile.column_count] = (
            _decode_tile(tile)
        )
    return Map(
        revision=parts[0].revision,
        status=parts[0].status,
        geometry=geometry,
        occupancy=layers[map_pb.MAP_LAYER_OCCUPANCY],
        gas_mean_ppm=layers[map_pb.MAP_LAYER_GAS_MEAN],
        gas_variance_ppm2=layers[map_pb.MAP_LAYER_GAS_VARIANCE],
    )


_DTYPES = {
    map_pb.MapTile.ENCODING_U8: np.dtype("u1"),
    map_pb.MapTile.ENCODING_F32: np.dtype("<f4"),
    map_pb.MapTile.ENCODING_U16_SCALED: np.dtype("<u2"),
}


def _decode_tile(tile):
    cells = np.frombuffer(zlib.decompress(tile.deflated_data), _DTYPES[tile.encoding])
    if tile.encoding == map_pb.MapTile.ENCODING_U16_SCALED:
        values = tile.value_offset + tile.value_scale * cells
        cells = np.where(cells == 65535, np.nan, values).astype(np.float32)
    return cells.reshape(tile.row_count, tile.column_count)
