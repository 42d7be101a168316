# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""A table of all missions that follows them."""

import sys
import time

from . import interrupts, words
from .output import as_dict, print_json, table

_CLEAR = "\x1b[H\x1b[2J"
HEADINGS = words.MISSION_HEADINGS[:6] + ["EVENTS/S", "UPDATE P99", "STALENESS P99"]


def rows(missions, before, elapsed_s):
    """before: the revisions of an earlier look, by name, elapsed_s ago."""
    for mission in missions:
        revisions = mission.revision - before.get(mission.name, mission.revision)
        yield words.mission_row(mission)[:6] + [
            f"{revisions / elapsed_s:.1f}" if elapsed_s > 0 else "-",
            f"{1e3 * mission.gas_timings.update.p99_s:.1f} ms",
            f"{1e3 * mission.gas_timings.staleness.p99_s:.1f} ms",
        ]


def follow(client, interval_s, count, json):
    """count 0: until interrupted. On a terminal each table takes the place of the last."""
    before: dict[str, int] = {}
    last_s, looks = time.monotonic(), 0
    while True:
        missions = client.missions()
        now_s = time.monotonic()
        if json:
            print_json([as_dict(mission) for mission in missions])
        else:
            lines = list(rows(missions, before, now_s - last_s if looks else 0.0))
            print((_CLEAR if sys.stdout.isatty() else "") + table(HEADINGS, lines), flush=True)
        looks += 1
        if looks == count:
            return
        before, last_s = {mission.name: mission.revision for mission in missions}, now_s
        interrupts.sleep(interval_s)
