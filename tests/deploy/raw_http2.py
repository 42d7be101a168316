# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Calls in HTTP/2 as no client of gRPC makes them: taken back at once, or never sent to their end."""

import ssl
import struct
import threading
import time

DATA, HEADERS, RST_STREAM, SETTINGS = 0, 1, 3, 4
END_HEADERS = 4
CANCEL = 8


def frame(kind, flags, stream, payload):
    return struct.pack(">I", len(payload))[1:] + struct.pack(">BBI", kind, flags, stream) + payload


def literal(name_index, value):
    """A header whose name is of HPACK's static table, without Huffman codes."""
    index = bytes([name_index]) if name_index < 15 else bytes([15, name_index - 15])
    return index + bytes([len(value)]) + value


# POST, https and a method of the service; 4 is :path, 1 :authority, 31 content-type.
CALL = (
    b"\x83\x87"
    + literal(4, b"/plumescout.v1.MissionService/ListMissions")
    + literal(1, b"localhost")
    + literal(31, b"application/grpc")
    + b"\0\x02te\x08trailers"
)
PREFACE = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + frame(SETTINGS, 0, 0, b"")


def resets(first_stream, count):
    """Calls that are taken back as soon as they are made."""
    frames = []
    for stream in range(first_stream, first_stream + 2 * count, 2):
        frames.append(frame(HEADERS, END_HEADERS, stream, CALL))
        frames.append(frame(RST_STREAM, 0, stream, struct.pack(">I", CANCEL)))
    return b"".join(frames)


def half_requests(count):
    """Calls whose request is never sent to its end."""
    half = b"\0" + struct.pack(">I", 1000) + b"\0" * 500
    streams = range(1, 2 * count, 2)
    return b"".join(
        frame(HEADERS, END_HEADERS, stream, CALL) + frame(DATA, 0, stream, half)
        for stream in streams
    )


class Answers:
    """How many calls of a connection have been answered."""

    def __init__(self, link):
        self._link = link
        self._link.settimeout(0.0)
        self._bytes = b""
        self.count = 0

    def look(self):
        try:
            while chunk := self._link.recv(1 << 16):
                self._bytes += chunk
        except (BlockingIOError, ssl.SSLWantReadError):
            pass
        while len(self._bytes) >= 9:
            end = 9 + int.from_bytes(self._bytes[:3], "big")
            if len(self._bytes) < end:
                break
            self.count += self._bytes[3] == HEADERS
            self._bytes = self._bytes[end:]
        return self.count


class Flood:
    """Four connections at a time that open streams and reset them, as fast as they can."""

    BATCH = 200

    def __init__(self, handshake, end):
        self._handshake = handshake
        self._end = end
        self.resets = self.connections = self.refused = 0
        self._lock = threading.Lock()
        self._threads = [threading.Thread(target=self._run) for _ in range(4)]
        for thread in self._threads:
            thread.start()

    def join(self):
        for thread in self._threads:
            thread.join()

    def _add(self, **counts):
        with self._lock:
            for name, count in counts.items():
                setattr(self, name, getattr(self, name) + count)

    def _run(self):
        while time.monotonic() < self._end:
            try:
                link = self._handshake()
            except OSError:
                self._add(refused=1)
                continue
            self._add(connections=1)
            try:
                link.sendall(PREFACE)
                stream = 1
                while time.monotonic() < self._end:
                    link.sendall(resets(stream, self.BATCH))
                    self._add(resets=self.BATCH)
                    stream += 2 * self.BATCH
            except OSError:
                pass  # ended by the front: on with another
            link.close()
