# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Errors of the server, as exceptions."""

import grpc
from google.rpc import error_details_pb2, status_pb2

_DETAILS_KEY = "grpc-status-details-bin"


class PlumeScoutError(Exception):
    """An error of the server: code is a grpc.StatusCode, reason an UPPER_SNAKE word or ''."""

    def __init__(self, code, message, reason="", retry_after_s=None, metadata=None, fields=()):
        super().__init__(f"{code.name}: {message}")
        self.code = code
        self.reason = reason
        self.retry_after_s = retry_after_s  # the server's advice, if it gave any
        self.metadata = metadata or {}  # facts by name, as strings
        self.fields = list(fields)  # names of bad fields


def error_of(error):
    """The PlumeScoutError of a grpc.RpcError."""
    details = status_pb2.Status()
    for key, value in error.trailing_metadata() or ():
        if key == _DETAILS_KEY:
            details.ParseFromString(value)
    info, retry = error_details_pb2.ErrorInfo(), error_details_pb2.RetryInfo()
    bad = error_details_pb2.BadRequest()
    retry_after_s = None
    for detail in details.details:
        detail.Unpack(info)
        detail.Unpack(bad)
        if detail.Unpack(retry):
            retry_after_s = retry.retry_delay.ToNanoseconds() / 1e9
    return PlumeScoutError(
        error.code(), error.details(), info.reason, retry_after_s, dict(info.metadata),
        [violation.field for violation in bad.field_violations],
    )


def is_unavailable(error):
    """Whether the link broke, or the server is not there: the call may or may not have been made."""
    return error.code == grpc.StatusCode.UNAVAILABLE


def passes_by_itself(error):
    """Whether the server has not made the call, and will once it has recovered its missions or its
    disk has room."""
    return is_unavailable(error) and error.reason in ("RECOVERING", "STORE_UNAVAILABLE")
