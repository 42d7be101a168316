# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Tables for people, JSON for programs."""

import inspect
import json
import sys
import threading

from google.protobuf import json_format

_PARAMETERS = inspect.signature(json_format.MessageToDict).parameters
_ZEROS = "including_default_value_fields"  # its name until protobuf 25
if _ZEROS not in _PARAMETERS:
    _ZEROS = "always_print_fields_with_no_presence"


def as_dict(message):
    """A message with the names of its .proto file; numbers that are 0 are there, too."""
    return json_format.MessageToDict(message, preserving_proto_field_name=True, **{_ZEROS: True})


def print_json(value):
    json.dump(value, sys.stdout, indent=2)
    print()


def table(headings, rows):
    """Columns of text, as wide as they need to be."""
    lines = [headings] + [[str(cell) for cell in row] for row in rows]
    widths = [max(len(line[i]) for line in lines) for i in range(len(headings))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip()
        for line in lines
    )


class Progress:
    """Tells on stderr how much is done, every second, to whoever has waited for two. A callable of
    what is done and what is expected, in bytes."""

    _PERIOD_S = 1.0

    def __init__(self, what, silence_s=2.0, file=sys.stderr):
        self._what = what
        self._silence_s = silence_s
        self._file = file
        self._state = (0, 0)
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._tell, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._over.set()
        self._thread.join()

    def __call__(self, done_bytes, expected_bytes):
        self._state = (done_bytes, expected_bytes)

    def text(self):
        done_bytes, expected_bytes = self._state
        if expected_bytes and done_bytes >= expected_bytes:
            return f"{self._what}: all {done_bytes / 1e6:.1f} MB; waiting for the server"
        share = f", {100 * done_bytes / expected_bytes:.0f} %" if expected_bytes else ""
        return f"{self._what}: {done_bytes / 1e6:.1f} MB{share}"

    def _tell(self):
        told, wait_s = False, self._silence_s
        on_terminal = self._file.isatty()
        while not self._over.wait(wait_s):
            told, wait_s = True, self._PERIOD_S
            line = f"\r{self.text()}\x1b[K" if on_terminal else f"{self.text()}\n"
            print(line, end="", file=self._file, flush=True)
        if told and on_terminal:
            print(file=self._file)


class Printer:
    """Prints what a command found, in the form that was asked for."""

    def __init__(self, form):
        self.json = form == "json"

    def messages(self, messages, headings, row):
        if self.json:
            print_json([as_dict(message) for message in messages])
        else:
            print(table(headings, [row(message) for message in messages]))

    def lines(self, messages, line):
        """Of any number of messages, as they come."""
        separator = "["
        for message in messages:
            if self.json:
                print(separator + json.dumps(as_dict(message)), flush=True)
            else:
                print(line(message), flush=True)
            separator = ","
        if self.json:
            print("[]" if separator == "[" else "]")

    def message(self, message, facts):
        """facts: pairs of a name and a value, for people."""
        if self.json:
            print_json(as_dict(message))
        else:
            width = max(len(name) for name, _ in facts)
            for name, value in facts:
                print(f"{name.ljust(width)}  {value}")

    def done(self, what):
        """Of commands that find nothing: says what was done, to people alone."""
        if self.json:
            print_json({})
        else:
            print(what)
