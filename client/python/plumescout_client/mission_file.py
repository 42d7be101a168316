# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Missions as files: out of a server, and into one."""

import hashlib
import os
import pathlib
import zlib

from plumescout.v1 import snapshot_service_pb2 as snapshot_pb

_FRAMING_BYTES = 4096  # of a request, beside the bytes of the file
_MAX_PIECE_BYTES = 1 << 20


class DamagedExport(Exception):
    """What came is not what the server sent."""


def write(responses, path, progress):
    """Writes the messages of ExportMission to a file, which is there when it is whole, and only then.

    progress(done_bytes, expected_bytes) is called now and then."""
    path = pathlib.Path(path)
    part = path.with_name(path.name + ".part")
    try:
        with open(part, "wb") as file:
            start = _write_parts(responses, file, progress)
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise
    return start


def _write_parts(responses, file, progress):
    start, crc, digest, size = None, 0, hashlib.sha256(), 0
    for response in responses:
        kind = response.WhichOneof("part")
        if kind == "start":
            start = response.start
        elif kind == "piece":
            data = response.piece.data
            crc = zlib.crc32(data, crc)
            if response.piece.offset_bytes != size or response.piece.crc32 != crc:
                raise DamagedExport(f"the piece at byte {size} is not what was sent")
            file.write(data)
            digest.update(data)
            size += len(data)
            progress(size, max(size, start.expected_bytes if start else 0))
        elif kind == "end":
            if response.end.total_bytes != size or response.end.sha256 != digest.digest():
                raise DamagedExport(f"of {response.end.total_bytes} bytes, {size} came, or others")
            return start
    raise DamagedExport(f"the export ends after {size} bytes, before its end")


def requests(file, mission, max_request_bytes, progress):
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
