# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes the messages of the wire, from ../../proto, when the package is built."""

import pathlib
import shutil
import subprocess
import sys

import setuptools
from setuptools.command.build_py import build_py

HERE = pathlib.Path(__file__).resolve().parent
PROTO = HERE.parents[1] / "proto"
# A protoc that is there fits the protobuf that is there, as on Debian; else pip brings both.
PROTOC = shutil.which("protoc")


class BuildWithWire(build_py):
    def run(self):
        super().run()
        package = pathlib.Path(HERE if self.editable_mode else self.build_lib) / "plumescout"
        _generate(package.parent, "plumescout/v1")
        _generate(package / "_wire", "google/rpc")


def _generate(out, folder):
    """Python and its types, of the .proto files of a folder."""
    out.mkdir(parents=True, exist_ok=True)
    sources = sorted(str(path) for path in PROTO.joinpath(folder).glob("*.proto"))
    protoc = [PROTOC] if PROTOC else [sys.executable, "-m", "grpc_tools.protoc"]
    arguments = [f"-I{PROTO}", f"--python_out={out}", f"--pyi_out={out}", *sources]
    subprocess.run(protoc + arguments, check=True)


setuptools.setup(
    cmdclass={"build_py": BuildWithWire}, setup_requires=[] if PROTOC else ["grpcio-tools"]
)
