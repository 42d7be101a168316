# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Maps as files: map_server's for the building, arrays for the gas."""

import pathlib

import numpy as np
import plumescout_client

_GREYS = {plumescout_client.UNKNOWN: 205, plumescout_client.FREE: 254, plumescout_client.OCCUPIED: 0}
LAYERS = ("occupancy", "gas-mean", "gas-variance")
ENDINGS = (".yaml", ".npy", ".csv")


def write_map(found, path, layer=None):
    """Writes one layer of a plumescout_client.Map; the ending of `path` says how. Returns the paths
    written. A .yaml has its .pgm beside it, and is always of the occupancy."""
    path = pathlib.Path(path)
    if path.suffix == ".yaml":
        if layer not in (None, "occupancy"):
            raise ValueError("a .yaml of map_server holds the occupancy only")
        return _write_map_server(found, path)
    cells = _layer(found, layer or "gas-mean")
    if path.suffix == ".npy":
        np.save(path, cells)
    elif path.suffix == ".csv":
        _write_csv(found, cells, path, layer or "gas-mean")
    else:
        raise ValueError(f"{path} must end in {', '.join(ENDINGS)}")
    return [path]


def _layer(found, layer):
    if layer == "occupancy":
        return found.occupancy
    return found.gas_mean_ppm if layer == "gas-mean" else found.gas_variance_ppm2


def _write_map_server(found, path):
    geometry = found.geometry
    image = path.with_suffix(".pgm")
    greys = np.zeros(256, np.uint8)
    for state, grey in _GREYS.items():
        greys[state] = grey
    rows, columns = found.occupancy.shape
    pixels = greys[found.occupancy][::-1]  # images begin in the north
    image.write_bytes(b"P5 %d %d 255\n" % (columns, rows) + pixels.tobytes())
    path.write_text(
        f"image: {image.name}\n"
        f"resolution: {geometry.resolution_m!r}\n"
        f"origin: [{geometry.origin.x_m!r}, {geometry.origin.y_m!r}, 0.0]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\nmode: trinary\n"
    )
    return [path, image]


def _write_csv(found, cells, path, layer):
    """One line for each known cell: its middle, and what is there."""
    geometry = found.geometry
    unit = {"occupancy": "state", "gas-mean": "mean_ppm", "gas-variance": "variance_ppm2"}[layer]
    known = cells != plumescout_client.UNKNOWN if layer == "occupancy" else np.isfinite(cells)
    rows, columns = np.nonzero(known)
    x_m = geometry.origin.x_m + (columns + 0.5) * geometry.resolution_m
    y_m = geometry.origin.y_m + (rows + 0.5) * geometry.resolution_m
    table = np.column_stack([x_m, y_m, cells[rows, columns]])
    np.savetxt(path, table, fmt="%.9g", delimiter=",", header=f"x_m,y_m,{unit}", comments="")
