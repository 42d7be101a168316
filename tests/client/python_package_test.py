# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Installs the Python package with pip, without a network, and drives the robot of the examples."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import running

ROOT = pathlib.Path(__file__).resolve().parents[2]


class PackageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """In a copy, for a build leaves files in its folder."""
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        shutil.copytree(ROOT / "proto", cls.folder / "tree/proto")
        shutil.copytree(ROOT / "client/python", cls.folder / "tree/client/python")
        cls.site = cls.folder / "site"
        options = ["--quiet", "--no-build-isolation", "--no-deps", "--no-index"]
        where = ["--target", cls.site, cls.folder / "tree/client/python"]
        subprocess.run([sys.executable, "-m", "pip", "install", *options, *where], check=True)
        cls.environment = os.environ | {"PYTHONPATH": str(cls.site)}

    def run_in(self, folder, *command):
        return subprocess.run(
            command,
            cwd=folder,
            env=self.environment,
            check=True,
            stdout=subprocess.PIPE,
            text=True,
            timeout=running.PATIENCE_S,
        ).stdout

    def test_the_messages_of_the_wire_are_in_it_with_their_types(self):
        for name in ("py.typed", "v1/types_pb2.py", "v1/types_pb2.pyi", "_wire/google/rpc"):
            self.assertTrue((self.site / "plumescout" / name).exists(), name)

    def test_the_programs_start(self):
        program = self.site / "bin/plumescoutctl"
        self.assertIn("usage:", self.run_in(self.folder, sys.executable, program, "--help"))

    def test_the_robot_of_the_examples_maps_its_room(self):
        server = running.Server()
        self.addCleanup(server.stop)
        example = ROOT / "client/python/examples/robot.py"
        told = self.run_in(self.folder, sys.executable, example, server.target)
        self.assertIn("Drive", told)
        gas_ppm = np.load(self.folder / "gas.npy")
        self.assertGreater(np.isfinite(gas_ppm).sum(), 0.9 * 60 * 40)
        self.assertTrue((self.folder / "room.pgm").read_bytes().startswith(b"P5 "))

    def test_the_page_shows_the_example(self):
        example = (ROOT / "client/python/examples/robot.py").read_text()
        page = (ROOT / "docs/clients.md").read_text()
        self.assertIn(example[example.index("import sys") :], page)

    def test_types_hold(self):
        shutil.copy(ROOT / "client/python/pyproject.toml", self.site)
        self.run_in(self.site, "mypy", "-p", "plumescout")


if __name__ == "__main__":
    unittest.main()
