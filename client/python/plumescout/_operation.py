# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What a client does, apart from how it waits.

An operation is a generator: it yields what is to be done (an Effect) and is sent what came of it,
or thrown a PlumeScoutError. It is written once; blocking.py and aio.py carry it out.
"""

from __future__ import annotations

import dataclasses
import random
from collections.abc import Generator
from typing import Any, Generic, TypeVar, Union

from google.protobuf.message import Message

from .errors import PlumeScoutError
from .rpcs import Rpc

T = TypeVar("T")


@dataclasses.dataclass(frozen=True)
class Invoke:
    """Makes a unary call once. Comes to: the response."""

    rpc: Rpc[Any, Any]
    request: Message
    timeout_s: float
    mission: str = ""
    metadata: tuple[tuple[str, str], ...] = ()


@dataclasses.dataclass(frozen=True)
class Open:
    """Begins a call that streams; who carries out the operation cancels it when that ends.
    request: None if requests are written. mission: that they are about. Comes to: the stream."""

    rpc: Rpc[Any, Any]
    request: Message | None = None
    timeout_s: float | None = None
    mission: str = ""
    metadata: tuple[tuple[str, str], ...] = ()


@dataclasses.dataclass(frozen=True)
class Write:
    """Writes a request to a stream."""

    stream: Any
    request: Message


@dataclasses.dataclass(frozen=True)
class EndWriting:
    """No more requests come."""

    stream: Any


@dataclasses.dataclass(frozen=True)
class Read:
    """Comes to: the next response, None after the last."""

    stream: Any


@dataclasses.dataclass(frozen=True)
class Sleep:
    seconds: float


@dataclasses.dataclass(frozen=True)
class Emit:
    """Hands an item to whoever iterates over the operation."""

    item: Any


Effect = Union[Invoke, Open, Write, EndWriting, Read, Sleep, Emit]
Operation = Generator[Effect, Any, T]


class Progress(Generic[T]):
    """Where an operation stands."""

    def __init__(self, operation: Operation[T]) -> None:
        self._operation = operation
        self._outcome: Any = None
        self._error: PlumeScoutError | None = None
        self._result: list[T] = []

    def advance(self) -> Effect | None:
        """What is to be done next; None: the operation has ended. Raises what it raises."""
        outcome, error = self._outcome, self._error
        self._outcome = self._error = None
        try:
            if error is not None:
                return self._operation.throw(error)
            return self._operation.send(outcome)
        except StopIteration as end:
            self._result.append(end.value)
            return None

    def give(self, outcome: Any) -> None:
        self._outcome = outcome

    def fail(self, error: PlumeScoutError) -> None:
        self._error = error

    def close(self) -> None:
        """No more of it is done."""
        self._operation.close()

    def result(self) -> T:
        """Once it has ended."""
        return self._result[0]


class Backoff:
    """Waits that grow up to a bound, spread so that clients do not come back in step."""

    FIRST_S, LONGEST_S, FACTOR, JITTER_SHARE = 0.1, 2.0, 1.6, 0.2

    def __init__(self) -> None:
        self._base_s = self.FIRST_S

    def next_s(self) -> float:
        wait_s = self._base_s * random.uniform(1 - self.JITTER_SHARE, 1 + self.JITTER_SHARE)
        self._base_s = min(self._base_s * self.FACTOR, self.LONGEST_S)
        return min(wait_s, self.LONGEST_S)
