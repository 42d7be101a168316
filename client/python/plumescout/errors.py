# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Errors of the server, as exceptions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import grpc
from google.rpc import error_details_pb2, status_pb2

_DETAILS_KEY = "grpc-status-details-bin"
_OWNER_KEY = "x-owner"
# A front says the latter two when the server behind it ends in the middle of a call.
_LINK_CODES = (
    grpc.StatusCode.UNAVAILABLE,
    grpc.StatusCode.UNKNOWN,
    grpc.StatusCode.INTERNAL,
)
_CODES: Mapping[int, grpc.StatusCode] = {code.value[0]: code for code in grpc.StatusCode}


class PlumeScoutError(Exception):
    """An error of the server."""

    code: grpc.StatusCode
    reason: str
    """An UPPER_SNAKE word that programs may act on, such as LEASE_SUPERSEDED, or ''."""
    message: str
    fields: tuple[str, ...]
    """Names of the fields that are bad, of INVALID_ARGUMENT."""
    metadata: dict[str, str]
    """Facts by name."""
    retry_after_s: float | None
    """The server's advice, if it gave any."""
    node: str
    """Of MISSION_ELSEWHERE and NODE_UNREACHED: the server that has the mission; or ''."""

    def __init__(
        self,
        code: grpc.StatusCode,
        message: str,
        reason: str = "",
        retry_after_s: float | None = None,
        metadata: Mapping[str, str] | None = None,
        fields: Sequence[str] = (),
        node: str = "",
    ) -> None:
        super().__init__(f"{code.name}: {message}")
        self.code = code
        self.message = message
        self.reason = reason
        self.retry_after_s = retry_after_s
        self.metadata = dict(metadata or {})
        self.fields = tuple(fields)
        self.node = node

    @property
    def link_broke(self) -> bool:
        """Whether the call may have been made or not: the link broke, or the server is not
        there."""
        return self.code in _LINK_CODES and not self.reason

    @property
    def passes_by_itself(self) -> bool:
        """Whether the server has not made the call, and says when to try again: it recovers its
        missions, its disk is full, it has much to do, or goes down. Or another one has the
        mission, and is gone perhaps."""
        return self.reason == "MISSION_ELSEWHERE" or (
            self.retry_after_s is not None
            and self.code in (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.RESOURCE_EXHAUSTED)
        )


def error_of(error: grpc.RpcError) -> PlumeScoutError:
    """The PlumeScoutError of an error of gRPC, blocking or asyncio."""
    details = status_pb2.Status()
    node = ""
    for key, value in error.trailing_metadata() or ():
        if key == _DETAILS_KEY:
            details.ParseFromString(value)
        elif key == _OWNER_KEY:
            node = value
    if error.code() == grpc.StatusCode.CANCELLED and details.code in _CODES:
        # What a front that cuts off a call makes of an answer that came before all was sent.
        return _error(_CODES[details.code], details.message, details, node)
    return _error(error.code(), error.details() or "", details, node)


def _error(
    code: grpc.StatusCode, message: str, details: status_pb2.Status, node: str
) -> PlumeScoutError:
    info, retry = error_details_pb2.ErrorInfo(), error_details_pb2.RetryInfo()
    bad = error_details_pb2.BadRequest()
    retry_after_s = None
    for detail in details.details:
        detail.Unpack(info)
        detail.Unpack(bad)
        if detail.Unpack(retry):
            retry_after_s = retry.retry_delay.ToNanoseconds() / 1e9
    fields = [violation.field for violation in bad.field_violations]
    return PlumeScoutError(code, message, info.reason, retry_after_s, info.metadata, fields, node)
