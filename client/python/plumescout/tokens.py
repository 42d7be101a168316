# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Files of bearer tokens, as the server reads them (access.tokens_file).

A line is "HASH NAME ROLE TENANT EXPIRY": the SHA-256 of the token in hexadecimal digits, who has
it, robot, viewer, operator or admin, a tenant or "-", and a time such as 2030-01-31T00:00:00Z or
"never". Empty lines and lines that begin with # mean nothing. The file holds no secrets: a token is
shown once, when it is made. The server notices changes by itself.

    secret = tokens.create("tokens", "scout", "robot", tenant="acme", days=90)
    for token in tokens.list_tokens("tokens"): print(token)
    tokens.revoke("tokens", "scout")

As a program: plumescoutctl tokens create|list|revoke FILE ...
"""

from __future__ import annotations

import argparse
import contextlib
import dataclasses
import datetime
import fcntl
import hashlib
import os
import pathlib
import re
import secrets
import sys
import tempfile
from collections.abc import Iterator, Sequence

ROLES = ("robot", "viewer", "operator", "admin")

_WORD = re.compile(r"[!-~]{1,64}")
_ROBOT_ID = re.compile(r"[a-z]([a-z0-9-]{0,61}[a-z0-9])?")
_SECRET_BYTES = 32
_ID_LENGTH = 8
_TIME_FORMAT = "%Y-%m-%dT%H:%M:%SZ"

Path = str | pathlib.Path


@dataclasses.dataclass(frozen=True)
class Token:
    """One line. id: the first digits of the hash, which tell tokens of one name apart."""

    id: str
    name: str
    role: str
    tenant: str  # "" if none
    expiry: str  # "never" or a time of RFC 3339


def create(path: Path, name: str, role: str, tenant: str = "", days: float | None = None) -> str:
    """Adds a token and returns its secret, which nobody can find out again. days: until it expires;
    default: never. The file is made if it is not there."""
    if not _WORD.fullmatch(name):
        raise ValueError(f"name {name!r} must be 1 to 64 visible ASCII characters")
    if role not in ROLES:
        raise ValueError(f"role {role!r} must be one of {', '.join(ROLES)}")
    if role == "robot" and not _ROBOT_ID.fullmatch(name):
        raise ValueError(f"name {name!r} must be the robot's id, {_ROBOT_ID.pattern}")
    if tenant and (tenant == "-" or "/" in tenant or not _WORD.fullmatch(tenant)):
        raise ValueError(
            f"tenant {tenant!r} must be 1 to 64 visible ASCII characters, without /, and not -"
        )
    if days is not None and not days > 0:
        raise ValueError(f"days {days} must be > 0")
    expiry = "never"
    if days is not None:
        end = datetime.datetime.now(datetime.timezone.utc) + datetime.timedelta(days=days)
        expiry = end.strftime(_TIME_FORMAT)
    secret = "ps_" + secrets.token_urlsafe(_SECRET_BYTES)
    digest = hashlib.sha256(secret.encode()).hexdigest()
    with _locked(path):
        lines = _read(path)
        _replace(path, [*lines, f"{digest} {name} {role} {tenant or '-'} {expiry}"])
    return secret


def list_tokens(path: Path) -> list[Token]:
    """The Tokens of a file, in its order."""
    return [token for token in map(_parse, _read(path)) if token]


def revoke(path: Path, name_or_id: str) -> int:
    """Removes the tokens of this name, or the one of this id; returns how many there were."""

    def is_meant(line: str) -> bool:
        token = _parse(line)
        return token is not None and name_or_id in (token.name, token.id)

    with _locked(path):
        lines = _read(path)
        kept = [line for line in lines if not is_meant(line)]
        if len(kept) < len(lines):
            _replace(path, kept)
    return len(lines) - len(kept)


def _read(path: Path) -> list[str]:
    try:
        return pathlib.Path(path).read_text().splitlines()
    except FileNotFoundError:
        return []


def _parse(line: str) -> Token | None:
    fields = line.split()
    if len(fields) != 5 or line.lstrip().startswith("#"):
        return None
    digest, name, role, tenant, expiry = fields
    return Token(digest[:_ID_LENGTH], name, role, "" if tenant == "-" else tenant, expiry)


@contextlib.contextmanager
def _locked(path: Path) -> Iterator[None]:
    """One writer at a time: two would lose a line, or bring a revoked one back."""
    with open(f"{path}.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _replace(path: Path, lines: Sequence[str]) -> None:
    """The server sees the old file or the new one, and nothing between, whenever power fails."""
    path = pathlib.Path(path)
    mode = path.stat().st_mode & 0o777 if path.exists() else 0o640
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "w") as file:
            file.write("".join(f"{line}\n" for line in lines))
            file.flush()
            os.fsync(file.fileno())
        os.chmod(temporary, mode)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        prog="plumescoutctl tokens", description="Bearer tokens of a PlumeScout server."
    )
    commands = parser.add_subparsers(dest="command", required=True)
    new = commands.add_parser("create", help="adds a token and prints it, once")
    new.add_argument("file")
    new.add_argument("name", help="who has it; of a robot its id")
    new.add_argument("--role", choices=ROLES, required=True)
    new.add_argument("--tenant", default="", help="whose missions it is about; default: of none")
    new.add_argument("--days", type=float, help="until it expires; default: never")
    listed = commands.add_parser("list", help="prints id, name, role, tenant and expiry")
    listed.add_argument("file")
    revoked = commands.add_parser("revoke", help="removes tokens")
    revoked.add_argument("file")
    revoked.add_argument("name", help="all of this name, or the one of this id")
    flags = parser.parse_args(arguments)
    if flags.command == "create":
        try:
            print(create(flags.file, flags.name, flags.role, flags.tenant, flags.days))
        except ValueError as error:
            parser.error(str(error))
    elif flags.command == "list":
        for token in list_tokens(flags.file):
            print(token.id, token.name, token.role, token.tenant or "-", token.expiry)
    else:
        count = revoke(flags.file, flags.name)
        if count == 0:
            print(f"{flags.file} has no token of {flags.name}", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
