# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Which of several servers behind one address has a mission, as far as they have told."""

from __future__ import annotations

import dataclasses
import re
from typing import Any, TypeVar, Union

import grpc
from google.protobuf.message import Message

from ._operation import EndWriting, Invoke, Open, Operation, Read, Write
from .errors import PlumeScoutError

T = TypeVar("T")
Call = TypeVar("Call", Invoke, Open)

MAX_REDIRECTS = 3  # beyond them who made the call waits, as for a server that is not there
_MAX_MISSIONS = 4096  # beyond them all is forgotten: it is a hint
_WORD = re.compile(r"[!-~]{1,128}")  # what headers may say
_NAMES = ("mission", "name", "robot", "mission_id", "open")
# Of a server that does not serve, or is not there.
_GONE_REASONS = ("", "DRAINING", "FENCED", "STORE_UNAVAILABLE")
_GONE = frozenset(
    {
        grpc.StatusCode.UNAVAILABLE,
        grpc.StatusCode.UNKNOWN,
        grpc.StatusCode.INTERNAL,
        grpc.StatusCode.DEADLINE_EXCEEDED,
    }
)


class Routes:
    """Of one connection."""

    def __init__(self) -> None:
        self._nodes: dict[str, str] = {}

    def route(self, operation: Operation[T]) -> Operation[T]:
        """The same operation, whose calls say which mission they are about and go to the server
        that has it."""
        outcome: Any = None
        error: PlumeScoutError | None = None
        stream: _Stream | None = None
        try:
            while True:
                effect = operation.send(outcome) if error is None else operation.throw(error)
                outcome = error = None
                try:
                    if isinstance(effect, Invoke):
                        outcome = yield from self._invoke(effect)
                    elif isinstance(effect, Open):
                        outcome = stream = _Stream(self, effect)
                        yield from stream.open()
                    elif isinstance(effect, Read) and stream is not None:
                        outcome = yield from stream.read()
                    elif isinstance(effect, (Write, EndWriting)) and stream is not None:
                        outcome = yield dataclasses.replace(effect, stream=stream.call)
                    else:
                        outcome = yield effect
                except PlumeScoutError as failed:
                    error = failed
        except StopIteration as end:
            result: T = end.value
            return result
        finally:
            operation.close()

    def _invoke(self, effect: Invoke) -> Operation[Any]:
        for redirects_left in range(MAX_REDIRECTS, -1, -1):
            addressed, node = self.address(effect)
            try:
                return (yield addressed)
            except PlumeScoutError as error:
                if not self.note(addressed.mission, node, error) or redirects_left == 0:
                    raise
        raise AssertionError("not reached")

    def address(self, effect: Call) -> tuple[Call, str]:
        """The effect with the metadata that a front finds a server by; and that server, if one is
        known."""
        mission = effect.mission or (_mission_of(effect.request) if effect.request else "")
        if not _WORD.fullmatch(mission):
            return effect, ""
        node = self._nodes.get(mission, "")
        metadata = [("x-mission-id", mission)] + ([("x-node", node)] if node else [])
        return dataclasses.replace(effect, mission=mission, metadata=tuple(metadata)), node

    def note(self, mission: str, node: str, error: PlumeScoutError) -> bool:
        """Whether another server than `node` has the mission; the call may be made again at
        once."""
        if not mission:
            return False
        if error.reason == "MISSION_ELSEWHERE":
            if not _WORD.fullmatch(error.node) or error.node == node:
                return False
            if len(self._nodes) >= _MAX_MISSIONS and mission not in self._nodes:
                self._nodes.clear()
            self._nodes[mission] = error.node
            return True
        gone = error.code in _GONE and error.reason in _GONE_REASONS
        if gone and self._nodes.get(mission) == node:
            self._nodes.pop(mission, None)
        return False


class _Stream:
    """A call that streams, at whichever server."""

    def __init__(self, routes: Routes, effect: Open) -> None:
        self.call: Any = None
        self._routes = routes
        self._effect = effect
        self._node = ""
        self._redirects_left = 0 if effect.rpc.streams_requests else MAX_REDIRECTS

    def open(self) -> Operation[None]:
        self._effect, self._node = self._routes.address(self._effect)
        self.call = yield self._effect

    def read(self) -> Operation[Any]:
        while True:
            try:
                response = yield Read(self.call)
                self._redirects_left = 0
                return response
            except PlumeScoutError as error:
                elsewhere = self._routes.note(self._effect.mission, self._node, error)
                if not elsewhere or self._redirects_left == 0:
                    raise
            self._redirects_left -= 1
            yield from self.open()


def _mission_of(request: Message) -> str:
    """The ID of the mission that a request is about, as it is named in it; "" of one that is about
    none."""
    for name in _NAMES:
        field = request.DESCRIPTOR.fields_by_name.get(name)
        if field is None:
            continue
        value: Union[str, Message] = getattr(request, name)
        mission = _mission_of(value) if isinstance(value, Message) else value
        if mission:
            return mission.removeprefix("missions/").split("/", 1)[0]
    return ""
