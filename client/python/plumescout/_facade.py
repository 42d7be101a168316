# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What blocking and asyncio clients have in common."""

from __future__ import annotations

import functools
import inspect
import os
import pathlib
from collections.abc import Callable
from typing import Any, Concatenate, Generic, ParamSpec, TypeVar

import grpc

from ._ingest import Ingest
from ._log import Log, Rejection
from ._session import Session

P = ParamSpec("P")
T = TypeVar("T")
Driver = TypeVar("Driver")

DEFAULT_TARGET = "127.0.0.1:50551"
DEFAULT_TIMEOUT_S = 10.0
OPTIONS = (
    ("grpc.keepalive_time_ms", 10_000),  # matches the server's minimum ping interval
    ("grpc.keepalive_timeout_ms", 5_000),
    ("grpc.max_receive_message_length", 256 << 20),  # more than any part of a map
    ("grpc.initial_reconnect_backoff_ms", 100),
    ("grpc.min_reconnect_backoff_ms", 100),
    ("grpc.max_reconnect_backoff_ms", 2_000),
)
StrPath = str | os.PathLike[str]
Metadata = tuple[tuple[str, str], ...]


class Credentials:
    """How a connection is protected, and who uses it. What is not given is taken from the
    environment: PLUMESCOUT_TLS_CA, PLUMESCOUT_TLS_CERT, PLUMESCOUT_TLS_KEY and
    PLUMESCOUT_TOKEN_FILE.

    tls_ca: PEM file of the authorities of the server's certificate; without it, plaintext.
    tls_cert, tls_key: PEM files of the client's own certificate; token_file: holds a bearer token.
    """

    def __init__(
        self,
        tls_ca: StrPath | None = None,
        tls_cert: StrPath | None = None,
        tls_key: StrPath | None = None,
        token_file: StrPath | None = None,
    ) -> None:
        self._ca = tls_ca or os.environ.get("PLUMESCOUT_TLS_CA")
        self._cert = tls_cert or os.environ.get("PLUMESCOUT_TLS_CERT")
        self._key = tls_key or os.environ.get("PLUMESCOUT_TLS_KEY")
        self._token_file = token_file or os.environ.get("PLUMESCOUT_TOKEN_FILE")
        if bool(self._cert) != bool(self._key):
            raise ValueError("tls_cert and tls_key go together")
        if self._cert and not self._ca:
            raise ValueError("tls_cert needs tls_ca, the authority of the server's certificate")

    def channel_credentials(self) -> grpc.ChannelCredentials | None:
        """None: plaintext."""
        if not self._ca:
            return None
        return grpc.ssl_channel_credentials(
            root_certificates=pathlib.Path(self._ca).read_bytes(),
            private_key=pathlib.Path(self._key).read_bytes() if self._key else None,
            certificate_chain=pathlib.Path(self._cert).read_bytes() if self._cert else None,
        )

    def metadata(self) -> Metadata:
        """Of a call; the file of the token is read each time, for tokens are renewed."""
        if not self._token_file:
            return ()
        token = pathlib.Path(self._token_file).read_text().split("\n", 1)[0].strip()
        return (("authorization", f"Bearer {token}"),)


def presents(method: Callable[..., Any], returns: str = "{}") -> Callable[[T], T]:
    """Gives a call the name, words and arguments of the method that it carries out."""

    def dress(call: T) -> T:
        functools.update_wrapper(call, method)
        signature = inspect.signature(method)
        result = str(signature.return_annotation).removeprefix("Operation[").removesuffix("]")
        signature = signature.replace(return_annotation=returns.format(result))
        setattr(call, "__signature__", signature)
        return call

    return dress


def _local(
    method: Callable[Concatenate[Ingest, P], T]
) -> Callable[Concatenate[BaseRobot[Any], P], T]:
    """A method of a robot that asks nobody."""

    @presents(method)
    def call(self: BaseRobot[Any], /, *args: P.args, **kwargs: P.kwargs) -> T:
        return method(self.session, *args, **kwargs)

    return call


class BaseRobot(Generic[Driver]):
    """What a robot does without the server."""

    def __init__(self, driver: Driver, session: Session) -> None:
        self.driver = driver
        self.session = session

    @property
    def name(self) -> str:
        """missions/{mission}/robots/{robot}."""
        return self.session.name

    @property
    def log(self) -> Log:
        """What was observed, and how much of it the server has: applied_sequence,
        durable_sequence, last_sequence, lost_count."""
        return self.session.log

    @property
    def rejections(self) -> list[Rejection]:
        """Observations that the server refused, the newest 10,000."""
        return self.session.rejections

    add_scan = _local(Ingest.add_scan)
    add_gas = _local(Ingest.add_gas)
    add_correction = _local(Ingest.add_correction)
    add_status = _local(Ingest.add_status)
