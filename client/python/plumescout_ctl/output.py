# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Tables for people, JSON for programs."""

import json
import sys

from google.protobuf import json_format


def as_dict(message):
    """A message with the names of its .proto file; numbers that are 0 are there, too."""
    return json_format.MessageToDict(
        message, preserving_proto_field_name=True, including_default_value_fields=True
    )


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


class Printer:
    """Prints what a command found, in the form that was asked for."""

    def __init__(self, form):
        self.json = form == "json"

    def messages(self, messages, headings, row):
        if self.json:
            print_json([as_dict(message) for message in messages])
        else:
            print(table(headings, [row(message) for message in messages]))

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
