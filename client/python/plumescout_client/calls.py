# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""How calls to a server are made: in time, again if that may help, page by page."""

import time
import uuid

import grpc
import plumescout_channel

from .errors import PlumeScoutError, error_of, is_unavailable, passes_by_itself

_KEEPALIVE_TIME_MS = 10_000  # matches the server's minimum ping interval
_KEEPALIVE_TIMEOUT_MS = 5_000
_MAX_RECEIVE_BYTES = 256 << 20  # more than any server sends in one part of a map
_NAMED_CALL_TRIES = 3
_RETRY_AFTER_S = 0.5  # unless the server says how long


def _channel(target, credentials):
    return plumescout_channel.channel_of(
        target,
        options=[
            ("grpc.keepalive_time_ms", _KEEPALIVE_TIME_MS),
            ("grpc.keepalive_timeout_ms", _KEEPALIVE_TIMEOUT_MS),
            ("grpc.max_receive_message_length", _MAX_RECEIVE_BYTES),
        ],
        **credentials,
    )


class Calls:
    """A channel and its calls, which raise PlumeScoutError."""

    def __init__(self, target, timeout_s, credentials):
        self._channel = _channel(target, credentials)
        self._timeout_s = timeout_s

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._channel.close()

    def _call(self, method, request, timeout_s=None, before_try=None):
        """Within its time, a call waits for a server that recovers or has no room on its disk.

        before_try is given the request before it goes out, each time that it does."""
        end_s = time.monotonic() + (timeout_s or self._timeout_s)
        while True:
            left_s = max(0.001, end_s - time.monotonic())
            if before_try is not None:
                before_try(request)
            try:
                return method(request, timeout=left_s, wait_for_ready=True)
            except grpc.RpcError as grpc_error:
                error = error_of(grpc_error)
            wait_s = error.retry_after_s or _RETRY_AFTER_S
            if not is_unavailable(error) or error.reason not in ("", "RECOVERING", "STORE_UNAVAILABLE") or time.monotonic() + wait_s > end_s:
                raise error
            time.sleep(wait_s)

    def _call_named(self, method, request, timeout_s=None):
        """A request with a name: made again when its answer is lost, it is carried out once."""
        request.request_id = uuid.uuid4().hex
        end_s = time.monotonic() + (timeout_s or self._timeout_s)
        for tries_left in reversed(range(_NAMED_CALL_TRIES)):
            try:
                return self._call(method, request, max(0.001, end_s - time.monotonic()))
            except PlumeScoutError as error:
                if tries_left == 0 or not is_unavailable(error):
                    raise

    def _pages(self, method, request, field):
        items = []
        while True:
            response = self._call(method, request)
            items += getattr(response, field)
            request.page_token = response.next_page_token
            if not request.page_token:
                return items
