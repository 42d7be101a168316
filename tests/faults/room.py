# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A room that robots drive around in, and what each of them sees there.

Observation n of robot i is always the same, so that nobody has to keep what was sent in order to
say what a journal must hold.
"""

import functools
import math
import zlib

import numpy as np

from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import types_pb2 as types_pb

WIDTH_M, HEIGHT_M = 9.0, 7.0
BEAMS = 72
MAX_RANGE_M = 12.0
UNIT_M = 0.01
POSES = 40  # places on a robot's round
SCAN_EVERY = 4  # observations; the others are gas readings
PERIOD_NS = 50_000_000
BEGIN_NS = 1_700_000_000_000_000_000  # long ago: no clock is behind it


@functools.lru_cache(maxsize=None)
def pose_of(robot, place):
    """x, y, yaw of a place on the robot's ellipse; robots keep apart by their phases."""
    angle = 2 * math.pi * (place / POSES + robot / 8)
    x_m = WIDTH_M / 2 + (WIDTH_M / 2 - 1.2) * math.cos(angle)
    y_m = HEIGHT_M / 2 + (HEIGHT_M / 2 - 1.2) * math.sin(angle)
    yaw_rad = math.remainder(angle + 1.5, 2 * math.pi)
    return x_m, y_m, yaw_rad


@functools.lru_cache(maxsize=None)
def counts_of(robot, place):
    """The ranges to the walls in counts of UNIT_M, as bytes of the wire."""
    x_m, y_m, yaw_rad = pose_of(robot, place)
    angles = yaw_rad + np.arange(BEAMS) * 2 * np.pi / BEAMS
    with np.errstate(divide="ignore"):
        to_x_m = np.where(np.cos(angles) > 0, WIDTH_M - x_m, -x_m) / np.cos(angles)
        to_y_m = np.where(np.sin(angles) > 0, HEIGHT_M - y_m, -y_m) / np.sin(angles)
    ranges_m = np.minimum(to_x_m, to_y_m)
    return np.round(ranges_m / UNIT_M).astype("<u2").tobytes()


@functools.lru_cache(maxsize=None)
def checksum_of(robot, place):
    """CRC-32 of the ranges as floats, in metres, as a mission holds them."""
    counts = np.frombuffer(counts_of(robot, place), "<u2").astype(float)
    return zlib.crc32((counts * UNIT_M).astype("<f4").tobytes())


def is_scan(sequence):
    return sequence % SCAN_EVERY == 1


def place_of(sequence):
    return sequence // SCAN_EVERY % POSES


def ppm_of(robot, sequence):
    return robot + (sequence * 7919 % 10_000) / 1000.0


def observation(robot, sequence):
    """The observation as it goes over the wire."""
    x_m, y_m, yaw_rad = pose_of(robot, place_of(sequence))
    made = ingest_pb.Observation(
        sequence=sequence,
        sample_time_ns=BEGIN_NS + sequence * PERIOD_NS,
        pose=types_pb.Pose2D(x_m=x_m, y_m=y_m, yaw_rad=yaw_rad),
    )
    if is_scan(sequence):
        made.scan.CopyFrom(
            ingest_pb.LaserScan(
                start_angle_rad=0.0,
                angle_step_rad=2 * math.pi / BEAMS,
                max_range_m=MAX_RANGE_M,
                range_unit_m=UNIT_M,
                ranges_u16=counts_of(robot, place_of(sequence)),
            )
        )
    else:
        made.gas.concentration_ppm = ppm_of(robot, sequence)
    return made


def expected(robot, sequence):
    """The same as the journal's reader tells it: (time_ns, x, y, yaw, what)."""
    pose = pose_of(robot, place_of(sequence))
    if is_scan(sequence):
        what = ("scan", BEAMS, checksum_of(robot, place_of(sequence)))
    else:
        what = ("gas", ppm_of(robot, sequence))
    return (BEGIN_NS + sequence * PERIOD_NS, *pose, what)
