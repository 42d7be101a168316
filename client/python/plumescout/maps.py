# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Maps as arrays."""

from __future__ import annotations

import base64
import dataclasses
import pathlib
import re
import zlib
from collections.abc import Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from plumescout.v1 import map_service_pb2 as map_pb
from plumescout.v1 import types_pb2 as types_pb

from . import _map_files
from ._map_files import FREE, OCCUPIED, UNKNOWN

_U16_NAN = 65535
_DTYPES: dict[int, npt.DTypeLike] = {
    map_pb.MapTile.ENCODING_U8: "u1",
    map_pb.MapTile.ENCODING_F32: "<f4",
    map_pb.MapTile.ENCODING_U16_SCALED: "<u2",
}
Tiles = Union[map_pb.GetMapResponse, map_pb.WatchMapResponse]


@dataclasses.dataclass(frozen=True, eq=False)
class Map:
    """A map at one revision. Arrays have shape (rows, columns), row 0 in the south; layers that
    were not asked for are UNKNOWN, or NaN."""

    revision: int
    status: map_pb.MapStatus  # of the map in full detail: geometry, frontiers, robots, phase ...
    resolution_m: float  # edge of a cell of the arrays
    origin_m: tuple[float, float]  # south-west corner of cell (0, 0)
    occupancy: npt.NDArray[np.uint8]  # UNKNOWN, FREE or OCCUPIED
    gas_mean_ppm: npt.NDArray[np.float32]  # NaN off free cells; of the gas that was asked for
    gas_variance_ppm2: npt.NDArray[np.float32]  # likewise

    @property
    def shape(self) -> tuple[int, int]:
        rows, columns = self.occupancy.shape
        return rows, columns

    def cell(self, x_m: float, y_m: float) -> tuple[int, int]:
        """(row, column) of a point; it may lie outside the arrays."""
        return (
            int(np.floor((y_m - self.origin_m[1]) / self.resolution_m)),
            int(np.floor((x_m - self.origin_m[0]) / self.resolution_m)),
        )

    def save(self, path: str | pathlib.Path, layer: str | None = None) -> list[pathlib.Path]:
        """Writes one layer ("occupancy", "gas-mean" or "gas-variance"); returns the paths written.

        The ending of the path says how: .npy; .csv, a line for each known cell; .yaml for
        map_server, with the .pgm beside it, which is always of the occupancy. Default: the mean."""
        layers = (self.occupancy, self.gas_mean_ppm, self.gas_variance_ppm2)
        raster = _map_files.Raster(
            dict(zip(_map_files.LAYERS, layers)), self.resolution_m, self.origin_m
        )
        return _map_files.write(raster, pathlib.Path(path), layer)


class MapBuilder:
    """Puts maps together: of parts of GetMap, or of what WatchMap says."""

    def __init__(self) -> None:
        self._geometry: types_pb.GridGeometry | None = None
        self._status = map_pb.MapStatus()
        self._layers: dict[int, npt.NDArray[Any]] = {}

    def clear(self) -> None:
        self._geometry = None

    def add(self, part: Tiles) -> None:
        """Takes tiles over what is there; of another geometry, over nothing."""
        if self._geometry is None or self._geometry != part.tile_geometry:
            self._geometry = part.tile_geometry
            shape = (self._geometry.row_count, self._geometry.column_count)
            self._layers = {
                map_pb.MAP_LAYER_OCCUPANCY: np.full(shape, UNKNOWN, np.uint8),
                map_pb.MAP_LAYER_GAS_MEAN: np.full(shape, np.nan, np.float32),
                map_pb.MAP_LAYER_GAS_VARIANCE: np.full(shape, np.nan, np.float32),
            }
        if part.HasField("status"):
            self._status = part.status
        for tile in part.tiles:
            row, column = tile.min_cell.row, tile.min_cell.column
            rows, columns = tile.row_count, tile.column_count
            layer = self._layers[tile.layer]
            layer[row : row + rows, column : column + columns] = decode_tile(tile)

    def map(self, revision: int) -> Map:
        """As it stands; arrays are copies."""
        geometry = self._geometry or types_pb.GridGeometry()
        return Map(
            revision=revision,
            status=self._status,
            resolution_m=geometry.resolution_m,
            origin_m=(geometry.origin.x_m, geometry.origin.y_m),
            occupancy=self._layers[map_pb.MAP_LAYER_OCCUPANCY].copy(),
            gas_mean_ppm=self._layers[map_pb.MAP_LAYER_GAS_MEAN].copy(),
            gas_variance_ppm2=self._layers[map_pb.MAP_LAYER_GAS_VARIANCE].copy(),
        )

    def watched(self, frame: map_pb.WatchMapResponse) -> Map | None:
        """Takes what WatchMap says next; returns the map once it is whole again."""
        if frame.kind == map_pb.WatchMapResponse.KIND_RESET:
            self.clear()
            return None
        if frame.kind == map_pb.WatchMapResponse.KIND_FULL:
            self.clear()
        if frame.kind == map_pb.WatchMapResponse.KIND_PROGRESS:
            self._status = frame.status
        else:
            self.add(frame)
        return None if frame.more_follow else self.map(frame.revision)


def decode_tile(tile: map_pb.MapTile) -> npt.NDArray[Any]:
    """Its cells: uint8 or float32, shape (rows, columns)."""
    cells = np.frombuffer(zlib.decompress(tile.deflated_data), _DTYPES[tile.encoding])
    if tile.encoding == map_pb.MapTile.ENCODING_U16_SCALED:
        values = tile.value_offset + tile.value_scale * cells
        cells = np.where(cells == _U16_NAN, np.nan, values).astype(np.float32)
    return cells.reshape(tile.row_count, tile.column_count)


def layers_of(words: Sequence[str]) -> list[map_pb.MapLayer]:
    """words: "occupancy", "gas-mean", "gas-variance"."""
    return [map_pb.MapLayer.Value("MAP_LAYER_" + word.upper().replace("-", "_")) for word in words]


def prior_map(
    occupancy: npt.ArrayLike, resolution_m: float, origin_m: tuple[float, float] = (0.0, 0.0)
) -> dict[str, Any]:
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


def prior_map_of_files(yaml_path: str | pathlib.Path) -> dict[str, Any]:
    """The same from the files of ROS map_server: a YAML file and the PGM image that it names. An
    image beyond the server's limits.max_receive_bytes has to go through prior_map."""
    yaml_path = pathlib.Path(yaml_path)
    yaml = yaml_path.read_text()
    image = re.search(r"^image:\s*(.+?)\s*$", yaml, re.MULTILINE)
    if image is None:
        raise ValueError(f"{yaml_path} names no image")
    pgm = (yaml_path.parent / image.group(1).strip("'\"")).read_bytes()
    return {"files": {"yaml": yaml, "pgm": base64.b64encode(pgm).decode()}}


__all__ = ["FREE", "OCCUPIED", "UNKNOWN", "Map", "prior_map", "prior_map_of_files"]
