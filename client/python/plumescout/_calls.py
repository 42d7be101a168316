# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""How calls are made: in time, again if that may help, page by page."""

from __future__ import annotations

import time
import uuid
from collections.abc import Callable
from typing import Any

from google.protobuf.message import Message

from ._operation import Backoff, Emit, Invoke, Open, Operation, Read, Sleep
from .errors import PlumeScoutError
from .rpcs import Request, Response, Rpc


class Calls:
    """What all operations are made of. timeout_s: of a call that is given none."""

    def __init__(self, timeout_s: float) -> None:
        self.timeout_s = timeout_s

    def call(
        self,
        rpc: Rpc[Request, Response],
        request: Request,
        timeout_s: float | None = None,
        before_try: Callable[[Request], None] = lambda request: None,
    ) -> Operation[Response]:
        """Makes a unary call, within its time again and again if the server has not taken it or, of
        a call that may be repeated, the link broke. A request that can have a name gets one.

        before_try is given the request before it goes out, each time that it does."""
        if "request_id" in request.DESCRIPTOR.fields_by_name:
            named: Any = request
            named.request_id = named.request_id or uuid.uuid4().hex
        end_s = self.end_s(timeout_s)
        backoff = Backoff()
        while True:
            before_try(request)
            try:
                response: Response = yield Invoke(rpc, request, left_s(end_s))
                return response
            except PlumeScoutError as error:
                repeat = error.passes_by_itself or (rpc.repeatable and error.link_broke)
                if not repeat:
                    raise
                yield from pause(error, backoff, end_s)

    def pages(self, rpc: Rpc[Any, Any], request: Any) -> Operation[list[Any]]:
        """The responses of a listing, one a page."""
        responses = []
        while True:
            response = yield from self.call(rpc, request)
            responses.append(response)
            request.page_token = response.next_page_token
            if not request.page_token:
                return responses

    def follow(
        self,
        rpc: Rpc[Any, Any],
        request: Message,
        digest: Callable[[Any], Any] = lambda response: response,
    ) -> Operation[None]:
        """Emits what digest makes of what a watch says, unless that is None, for as long as it
        takes; begins again when the link breaks."""
        backoff = Backoff()
        while True:
            stream = yield Open(rpc, request)
            try:
                while (response := (yield Read(stream))) is not None:
                    backoff = Backoff()
                    if (item := digest(response)) is not None:
                        yield Emit(item)
                return
            except PlumeScoutError as error:
                if not (error.link_broke or error.passes_by_itself):
                    raise
                yield from pause(error, backoff)

    def end_s(self, timeout_s: float | None) -> float:
        return time.monotonic() + (self.timeout_s if timeout_s is None else timeout_s)


def left_s(end_s: float) -> float:
    return max(0.001, end_s - time.monotonic())


def pause(error: PlumeScoutError, backoff: Backoff, end_s: float = float("inf")) -> Operation[None]:
    """Waits before another try; raises the error if that would be too late."""
    wait_s = error.retry_after_s or backoff.next_s()
    if time.monotonic() + wait_s > end_s:
        raise error
    yield Sleep(wait_s)
