# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A TCP proxy that treats connections badly, as a network does that robots drive out of."""

import socket
import struct
import threading
import time

_CHUNK_BYTES = 1 << 16
_RESET = struct.pack("ii", 1, 0)  # SO_LINGER: close by a reset


class Proxy:
    """Between a port of its own and a target, host:port.

    state: "up"; "cut": connections are reset and new ones refused; "half_open": both ends think
    they are connected, and nothing arrives. delay_s: of everything, each way. slice_bytes: most
    bytes sent at once; 0: as they come."""

    def __init__(self, target, delay_s=0.0, slice_bytes=0):
        host, port = target.rsplit(":", 1)
        self._to = (host, int(port))
        self._delay_s = delay_s
        self._slice_bytes = slice_bytes
        self._lock = threading.Lock()
        self._state = "up"
        self._links = set()  # pairs of sockets
        self._threads = []
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.target = f"127.0.0.1:{self._listener.getsockname()[1]}"
        self.bytes = 0
        self._acceptor = threading.Thread(target=self._accept)
        self._acceptor.start()

    def set_state(self, state):
        """Connections do not outlive a change, but for the one to half_open; when that is over, both
        ends learn it."""
        with self._lock:
            self._state = state
        if state != "half_open":
            self._reset_all()

    def stop(self):
        self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()
        self._acceptor.join()
        self.set_state("cut")
        for thread in self._threads:
            thread.join()

    def _accept(self):
        while True:
            try:
                near, _ = self._listener.accept()
            except OSError:
                return
            if self._state == "cut":
                _reset(near)
                continue
            try:
                far = socket.create_connection(self._to, timeout=5.0)
            except OSError:
                _reset(near)
                continue
            far.settimeout(None)
            link = (near, far)
            for end in link:
                end.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            with self._lock:
                self._links.add(link)
            for source, sink in (link, link[::-1]):
                thread = threading.Thread(target=self._pump, args=(source, sink, link), daemon=True)
                thread.start()
                self._threads.append(thread)

    def _pump(self, source, sink, link):
        try:
            while True:
                data = source.recv(_CHUNK_BYTES)
                if not data:
                    break
                if self._state == "half_open":
                    continue  # swallowed
                if self._delay_s > 0:
                    time.sleep(self._delay_s)
                self._send(sink, data)
        except OSError:
            pass
        if self._state != "half_open":
            self._end(link)

    def _send(self, sink, data):
        size = self._slice_bytes or len(data)
        for begin in range(0, len(data), size):
            sink.sendall(data[begin : begin + size])
        self.bytes += len(data)

    def _reset_all(self):
        with self._lock:
            links = list(self._links)
        for link in links:
            self._end(link)

    def _end(self, link):
        with self._lock:
            if link not in self._links:
                return
            self._links.remove(link)
        for end in link:
            _reset(end)


def _reset(end):
    try:
        end.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, _RESET)
        end.shutdown(socket.SHUT_RDWR)  # wakes who waits in recv
    except OSError:
        pass
    end.close()
