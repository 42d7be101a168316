# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Missions as files: out of a server, and into one."""

from __future__ import annotations

import hashlib
import os
import pathlib
import zlib
from collections.abc import Callable, Iterator
from typing import BinaryIO

from plumescout.v1 import snapshot_service_pb2 as snapshot_pb

_FRAMING_BYTES = 4096  # of a request, beside the bytes of the file
_MAX_PIECE_BYTES = 1 << 20
Progress = Callable[[int, int], None]


class DamagedExport(Exception):
    """What came is not what the server sent."""


class Writer:
    """Writes the messages of ExportMission to a file, which is there once it is whole, and only
    then.

    progress(done_bytes, expected_bytes) is called now and then."""

    def __init__(self, path: str | pathlib.Path, progress: Progress) -> None:
        self._path = pathlib.Path(path)
        self._part = self._path.with_name(self._path.name + ".part")
        self._progress = progress
        self._start = snapshot_pb.MissionFileStart()
        self._crc, self._digest, self._size = 0, hashlib.sha256(), 0
        self._whole = self._kept = False

    def __enter__(self) -> Writer:
        self._file = open(self._part, "wb")
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()
        if not self._kept:
            self._part.unlink(missing_ok=True)

    def take(self, response: snapshot_pb.ExportMissionResponse) -> None:
        """Raises DamagedExport."""
        kind = response.WhichOneof("part")
        if kind == "start":
            self._start = response.start
        elif kind == "piece":
            self._take_piece(response.piece)
        elif kind == "end":
            end = response.end
            if end.total_bytes != self._size or end.sha256 != self._digest.digest():
                raise DamagedExport(f"of {end.total_bytes} bytes, {self._size} came, or others")
            self._whole = True

    def finish(self) -> snapshot_pb.MissionFileStart:
        """When no more responses come. Raises DamagedExport."""
        if not self._whole:
            raise DamagedExport(f"the export ends after {self._size} bytes, before its end")
        self._file.flush()
        os.fsync(self._file.fileno())
        os.replace(self._part, self._path)
        self._kept = True
        return self._start

    def _take_piece(self, piece: snapshot_pb.MissionFilePiece) -> None:
        self._crc = zlib.crc32(piece.data, self._crc)
        if piece.offset_bytes != self._size or piece.crc32 != self._crc:
            raise DamagedExport(f"the piece at byte {self._size} is not what was sent")
        self._file.write(piece.data)
        self._digest.update(piece.data)
        self._size += len(piece.data)
        self._progress(self._size, max(self._size, self._start.expected_bytes))


def requests(
    file: BinaryIO, mission: str | None, max_request_bytes: int, progress: Progress
) -> Iterator[snapshot_pb.ImportMissionRequest]:
    """The messages of ImportMission for an open file."""
    yield snapshot_pb.ImportMissionRequest(start=snapshot_pb.ImportStart(mission_id=mission or ""))
    piece_bytes = max(1, min(_MAX_PIECE_BYTES, max_request_bytes - _FRAMING_BYTES))
    expected_bytes = os.fstat(file.fileno()).st_size
    crc, digest, size = 0, hashlib.sha256(), 0
    while data := file.read(piece_bytes):
        crc = zlib.crc32(data, crc)
        digest.update(data)
        yield snapshot_pb.ImportMissionRequest(
            piece=snapshot_pb.MissionFilePiece(offset_bytes=size, data=data, crc32=crc)
        )
        size += len(data)
        progress(size, max(size, expected_bytes))
    yield snapshot_pb.ImportMissionRequest(
        end=snapshot_pb.MissionFileEnd(total_bytes=size, sha256=digest.digest())
    )
