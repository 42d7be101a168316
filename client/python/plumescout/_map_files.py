# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Maps as files: map_server's for the building, arrays for the gas."""

from __future__ import annotations

import dataclasses
import pathlib
from typing import Any

import numpy as np
import numpy.typing as npt

UNKNOWN, FREE, OCCUPIED = 0, 1, 2  # values of occupancy
LAYERS = ("occupancy", "gas-mean", "gas-variance")
ENDINGS = (".yaml", ".npy", ".csv")

_GREYS = {UNKNOWN: 205, FREE: 254, OCCUPIED: 0}
_UNITS = {"occupancy": "state", "gas-mean": "mean_ppm", "gas-variance": "variance_ppm2"}


@dataclasses.dataclass(frozen=True)
class Raster:
    """Layers by name, each of shape (rows, columns), row 0 in the south, and where they lie."""

    layers: dict[str, npt.NDArray[Any]]
    resolution_m: float
    origin_m: tuple[float, float]


def write(raster: Raster, path: pathlib.Path, layer: str | None) -> list[pathlib.Path]:
    """See Map.save."""
    if path.suffix == ".yaml":
        if layer not in (None, "occupancy"):
            raise ValueError("a .yaml of map_server holds the occupancy only")
        return _write_map_server(raster, path)
    layer = layer or "gas-mean"
    if layer not in LAYERS:
        raise ValueError(f"layer {layer!r} must be one of {', '.join(LAYERS)}")
    if path.suffix == ".npy":
        np.save(path, raster.layers[layer])
    elif path.suffix == ".csv":
        _write_csv(raster, path, layer)
    else:
        raise ValueError(f"{path} must end in {', '.join(ENDINGS)}")
    return [path]


def _write_map_server(raster: Raster, path: pathlib.Path) -> list[pathlib.Path]:
    image = path.with_suffix(".pgm")
    greys = np.zeros(256, np.uint8)
    for state, grey in _GREYS.items():
        greys[state] = grey
    occupancy = raster.layers["occupancy"]
    rows, columns = occupancy.shape
    pixels = greys[occupancy][::-1]  # images begin in the north
    image.write_bytes(b"P5 %d %d 255\n" % (columns, rows) + pixels.tobytes())
    x_m, y_m = raster.origin_m
    path.write_text(
        f"image: {image.name}\n"
        f"resolution: {raster.resolution_m!r}\n"
        f"origin: [{x_m!r}, {y_m!r}, 0.0]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\nmode: trinary\n"
    )
    return [path, image]


def _write_csv(raster: Raster, path: pathlib.Path, layer: str) -> None:
    """One line for each known cell: its middle, and what is there."""
    cells = raster.layers[layer]
    known = cells != UNKNOWN if layer == "occupancy" else np.isfinite(cells)
    rows, columns = np.nonzero(known)
    x_m = raster.origin_m[0] + (columns + 0.5) * raster.resolution_m
    y_m = raster.origin_m[1] + (rows + 0.5) * raster.resolution_m
    table = np.column_stack([x_m, y_m, cells[rows, columns]])
    header = f"x_m,y_m,{_UNITS[layer]}"
    np.savetxt(path, table, fmt="%.9g", delimiter=",", header=header, comments="")
