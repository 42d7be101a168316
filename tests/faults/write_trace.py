# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What a disk may hold after power fails: made of a trace of writes and syncs (io_shim.c).

What was synced is there. Of what was written since, any part may be: each sector of 512 bytes by
itself. New names, renames and removals arrive in their order, up to any of them; a sync of a file
makes its name last too, a sync of a folder all names in it.
"""

import dataclasses
import pathlib
import struct

SECTOR = 512
_HEADER = struct.Struct("<cQQQ")


@dataclasses.dataclass
class Operation:
    kind: str
    path: str
    offset: int
    data: bytes
    end: int  # where its record ends in the trace


def read(path):
    """[Operation ...] of a trace; a record that was cut off is left out."""
    trace = pathlib.Path(path).read_bytes()
    operations, at = [], 0
    while at + _HEADER.size <= len(trace):
        kind, name_length, offset, size = _HEADER.unpack_from(trace, at)
        name_at = at + _HEADER.size
        end = name_at + name_length + size
        if end > len(trace):
            break
        name = trace[name_at : name_at + name_length].decode().lstrip("/")
        operations.append(
            Operation(kind.decode(), name, offset, trace[name_at + name_length : end], end)
        )
        at = end
    return operations


class _File:
    """Bytes that are on the disk, and changes that may be."""

    def __init__(self):
        self.content = bytearray()
        self.pending = []  # (offset, bytes), or (size, None): a truncation

    def sync(self):
        for change in self.pending:
            self._apply(*change)
        self.pending = []

    def lose_some(self, chance):
        """Keeps any part of the pending changes, each sector by itself."""
        for offset, data in self.pending:
            if data is None:
                if chance.random() < 0.5:
                    self._apply(offset, None)
                continue
            for begin in range(offset - offset % SECTOR, offset + len(data), SECTOR):
                first, last = max(begin, offset), min(begin + SECTOR, offset + len(data))
                if chance.random() < 0.5:
                    self._apply(first, data[first - offset : last - offset])
        self.pending = []

    def _apply(self, offset, data):
        if data is None:
            del self.content[offset:]
            self.content.extend(bytes(offset - len(self.content)))
            return
        if len(self.content) < offset:
            self.content.extend(bytes(offset - len(self.content)))
        self.content[offset : offset + len(data)] = data


class Disk:
    """Plays operations; then power fails once."""

    def __init__(self):
        self._names = {}  # path -> _File, as programs see it
        self._kept = {}  # as it is on the disk
        self._pending = []  # changes of names, each a list of (path, _File or None)

    def play(self, operation):
        kind, path = operation.kind, operation.path
        if kind == "w" or kind == "t":
            file = self._named(path)
            file.pending.append((operation.offset, operation.data if kind == "w" else None))
        elif kind == "s":
            file = self._named(path)
            file.sync()
            self._keep(lambda name, now: now is file)
        elif kind == "d":
            folder = path.rstrip("/")
            self._keep(lambda name, _: name.rpartition("/")[0] == folder)
        elif kind == "r":
            self._rename(path, operation.data.decode().lstrip("/"))
        elif kind == "u":
            self._name(path, None)
        else:
            raise ValueError(f"operation {kind!r}")

    def fail(self, chance):
        """{path: bytes} of one state that the disk may be in now."""
        for change in self._pending[: chance.randint(0, len(self._pending))]:
            self._set_kept(change)
        for file in set(self._kept.values()):
            file.lose_some(chance)
        return {path: bytes(file.content) for path, file in self._kept.items()}

    def _named(self, path):
        if path not in self._names:
            self._name(path, _File())
        return self._names[path]

    def _name(self, path, file):
        if file is None:
            self._names.pop(path, None)
        else:
            self._names[path] = file
        self._pending.append([(path, file)])

    def _rename(self, path, new_path):
        file = self._named(path)
        del self._names[path]
        self._names[new_path] = file
        self._pending.append([(new_path, file), (path, None)])

    # Names that last bring those that were changed before them: file systems keep this order.
    def _keep(self, lasts):
        last = -1
        for i, change in enumerate(self._pending):
            if any(lasts(path, file) for path, file in change):
                last = i
        for change in self._pending[: last + 1]:
            self._set_kept(change)
        del self._pending[: last + 1]

    def _set_kept(self, change):
        for path, file in change:
            if file is None:
                self._kept.pop(path, None)
            else:
                self._kept[path] = file


def state_at(operations, end, chance):
    """A state after all operations whose records end there or before."""
    disk = Disk()
    for operation in operations:
        if operation.end > end:
            break
        disk.play(operation)
    return disk.fail(chance)


def lay_down(state, folder):
    folder.mkdir(parents=True, mode=0o700)
    for path, content in state.items():
        file = folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content)
