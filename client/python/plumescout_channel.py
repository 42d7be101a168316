# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Channels to a PlumeScout server: how they are protected, and who uses them.

What is not given is taken from the environment: PLUMESCOUT_TLS_CA, PLUMESCOUT_TLS_CERT,
PLUMESCOUT_TLS_KEY and PLUMESCOUT_TOKEN_FILE name the files.
"""

import collections
import os
import pathlib

import grpc


class _CallDetails(
    collections.namedtuple(
        "_CallDetails",
        ("method", "timeout", "metadata", "credentials", "wait_for_ready", "compression"),
    ),
    grpc.ClientCallDetails,
):
    pass


class _TokenInterceptor(
    grpc.UnaryUnaryClientInterceptor,
    grpc.UnaryStreamClientInterceptor,
    grpc.StreamUnaryClientInterceptor,
    grpc.StreamStreamClientInterceptor,
):
    """Adds the token to every call; its file is read each time, for tokens are renewed."""

    def __init__(self, token_file):
        self._token_file = pathlib.Path(token_file)

    def _with_token(self, details):
        token = self._token_file.read_text().split("\n", 1)[0].strip()
        metadata = [*(details.metadata or ()), ("authorization", f"Bearer {token}")]
        return _CallDetails(
            details.method,
            details.timeout,
            metadata,
            details.credentials,
            getattr(details, "wait_for_ready", None),
            getattr(details, "compression", None),
        )

    def _intercept(self, proceed, details, request):
        return proceed(self._with_token(details), request)

    intercept_unary_unary = _intercept
    intercept_unary_stream = _intercept
    intercept_stream_unary = _intercept
    intercept_stream_stream = _intercept


def channel_of(target, options=(), tls_ca=None, tls_cert=None, tls_key=None, token_file=None):
    """A grpc.Channel to target, host:port.

    tls_ca: PEM file of the authorities of the server's certificate; without it, plaintext.
    tls_cert, tls_key: PEM files of the client's own certificate; token_file: holds a bearer token.
    """
    tls_ca = tls_ca or os.environ.get("PLUMESCOUT_TLS_CA")
    tls_cert = tls_cert or os.environ.get("PLUMESCOUT_TLS_CERT")
    tls_key = tls_key or os.environ.get("PLUMESCOUT_TLS_KEY")
    token_file = token_file or os.environ.get("PLUMESCOUT_TOKEN_FILE")
    if bool(tls_cert) != bool(tls_key):
        raise ValueError("tls_cert and tls_key go together")
    if tls_cert and not tls_ca:
        raise ValueError("tls_cert needs tls_ca, the authority of the server's certificate")
    if tls_ca:
        credentials = grpc.ssl_channel_credentials(
            root_certificates=pathlib.Path(tls_ca).read_bytes(),
            private_key=pathlib.Path(tls_key).read_bytes() if tls_key else None,
            certificate_chain=pathlib.Path(tls_cert).read_bytes() if tls_cert else None,
        )
        channel = grpc.secure_channel(target, credentials, options=list(options))
    else:
        channel = grpc.insecure_channel(target, options=list(options))
    if token_file:
        channel = grpc.intercept_channel(channel, _TokenInterceptor(token_file))
    return channel
