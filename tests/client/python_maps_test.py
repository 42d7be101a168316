# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Maps of the Python client: tiles, what a watch says, files."""

import pathlib
import tempfile
import unittest
import zlib

import numpy as np
import plumescout
from plumescout import rpcs
from plumescout.maps import MapBuilder, decode_tile, layers_of

from plumescout.v1 import ingest_service_pb2 as ingest_pb
from plumescout.v1 import map_service_pb2 as map_pb
from plumescout.v1 import mission_service_pb2 as mission_pb
from plumescout.v1 import planning_service_pb2 as planning_pb
from plumescout.v1 import robot_service_pb2 as robot_pb
from plumescout.v1 import snapshot_service_pb2 as snapshot_pb
from plumescout.v1 import system_service_pb2 as system_pb

FILES = (ingest_pb, map_pb, mission_pb, planning_pb, robot_pb, snapshot_pb, system_pb)
Kind = map_pb.WatchMapResponse


def tile(cells, row=0, column=0, layer=map_pb.MAP_LAYER_OCCUPANCY, **encoding):
    cells = np.asarray(cells)
    encoding = {"encoding": map_pb.MapTile.ENCODING_U8} | encoding
    return map_pb.MapTile(
        layer=layer,
        min_cell={"row": row, "column": column},
        row_count=cells.shape[0],
        column_count=cells.shape[1],
        deflated_data=zlib.compress(cells.tobytes()),
        **encoding,
    )


def frame(kind, *tiles, revision=1, **fields):
    geometry = {"origin": {"x_m": -1.0}, "resolution_m": 0.5, "column_count": 3, "row_count": 2}
    return Kind(kind=kind, revision=revision, tiles=tiles, tile_geometry=geometry, **fields)


class TileTest(unittest.TestCase):
    def test_scaled_values_are_reckoned_in_double_and_rounded_once(self):
        counts = np.array([[0, 3, 65535]], "<u2")
        cells = decode_tile(
            tile(
                counts,
                layer=map_pb.MAP_LAYER_GAS_MEAN,
                encoding=map_pb.MapTile.ENCODING_U16_SCALED,
                value_scale=0.1,
                value_offset=1.0,
            )
        )
        self.assertEqual(cells.dtype, np.float32)
        np.testing.assert_array_equal(
            cells, np.array([[1.0, 1.0 + 0.1 * 3, np.nan]]).astype(np.float32)
        )

    def test_layers_have_names(self):
        self.assertEqual(layers_of(["gas-mean"]), [map_pb.MAP_LAYER_GAS_MEAN])
        with self.assertRaises(ValueError):
            layers_of(["gas"])


class WatchTest(unittest.TestCase):
    def setUp(self):
        self.builder = MapBuilder()

    def test_changes_come_on_top_of_the_whole(self):
        full = frame(Kind.KIND_FULL, tile(np.ones((2, 3), "u1")))
        first = self.builder.watched(full)
        delta = frame(Kind.KIND_DELTA, tile(np.full((1, 1), 2, "u1"), 1, 2), revision=2)
        second = self.builder.watched(delta)
        np.testing.assert_array_equal(first.occupancy, [[1, 1, 1], [1, 1, 1]])
        np.testing.assert_array_equal(second.occupancy, [[1, 1, 1], [1, 1, 2]])
        self.assertEqual((first.revision, second.revision), (1, 2))
        self.assertTrue(np.isnan(second.gas_mean_ppm).all())
        self.assertEqual(second.cell(0.4, 0.6), (1, 2))

    def test_a_map_of_several_messages_is_whole_with_the_last(self):
        more = frame(Kind.KIND_FULL, tile([[np.uint8(1)]]), more_follow=True)
        self.assertIsNone(self.builder.watched(more))
        last = frame(Kind.KIND_DELTA, tile([[np.uint8(2)]], 0, 1))
        np.testing.assert_array_equal(self.builder.watched(last).occupancy, [[1, 2, 0], [0, 0, 0]])

    def test_nothing_is_left_after_a_reset(self):
        self.builder.watched(frame(Kind.KIND_FULL, tile(np.ones((2, 3), "u1"))))
        self.assertIsNone(self.builder.watched(Kind(kind=Kind.KIND_RESET)))
        again = self.builder.watched(frame(Kind.KIND_FULL))
        self.assertFalse(again.occupancy.any())

    def test_progress_moves_the_status_alone(self):
        self.builder.watched(frame(Kind.KIND_FULL, tile(np.ones((2, 3), "u1"))))
        status = map_pb.MapStatus(gas_threshold_ppm=4.0)
        found = self.builder.watched(Kind(kind=Kind.KIND_PROGRESS, revision=9, status=status))
        self.assertEqual((found.revision, found.status.gas_threshold_ppm), (9, 4.0))
        self.assertTrue(found.occupancy.all())


class FilesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        mean = np.full((1, 2), 2.5, "<f4")
        gas = tile(mean, layer=map_pb.MAP_LAYER_GAS_MEAN, encoding=map_pb.MapTile.ENCODING_F32)
        cells = tile(np.array([[1, 1, 2]], "u1"))
        self.map = MapBuilder().watched(frame(Kind.KIND_FULL, cells, gas))

    def test_a_layer_as_array(self):
        self.map.save(self.folder / "gas.npy")
        np.testing.assert_array_equal(np.load(self.folder / "gas.npy"), self.map.gas_mean_ppm)

    def test_the_building_for_map_server_comes_back(self):
        paths = self.map.save(self.folder / "hall.yaml")
        self.assertEqual([path.name for path in paths], ["hall.yaml", "hall.pgm"])
        self.assertEqual(
            (self.folder / "hall.pgm").read_bytes(), b"P5 3 2 255\n\xcd\xcd\xcd\xfe\xfe\x00"
        )
        files = plumescout.prior_map_of_files(self.folder / "hall.yaml")["files"]
        self.assertIn("origin: [-1.0, 0.0, 0.0]", files["yaml"])

    def test_known_cells_as_lines(self):
        self.map.save(str(self.folder / "gas.csv"))
        lines = (self.folder / "gas.csv").read_text().splitlines()
        self.assertEqual(lines, ["x_m,y_m,mean_ppm", "-0.75,0.25,2.5", "-0.25,0.25,2.5"])

    def test_what_cannot_be_written_is_named(self):
        for path, layer in (("hall.png", None), ("hall.yaml", "gas-mean"), ("hall.npy", "gas")):
            with self.assertRaises(ValueError, msg=path):
                self.map.save(self.folder / path, layer)


class RpcsTest(unittest.TestCase):
    def test_every_rpc_is_in_the_table_as_it_streams(self):
        services = {}
        for file in FILES:
            for service in file.DESCRIPTOR.services_by_name.values():
                for method in service.methods:
                    services[f"/{service.full_name}/{method.name}"] = method
        self.assertEqual({rpc.path for rpc in rpcs.ALL}, set(services))
        for rpc in rpcs.ALL:
            method = services[rpc.path]
            self.assertEqual(rpc.request.DESCRIPTOR, method.input_type)
            self.assertEqual(rpc.response.DESCRIPTOR, method.output_type)
            self.assertEqual(rpc.streams_requests, method.client_streaming)
            self.assertEqual(rpc.streams_responses, method.server_streaming)


if __name__ == "__main__":
    unittest.main()
