# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What a server has answered, and whether the journal that it left holds all of it.

Robots write their answers down as they come; a Journal is what tests/faults/journal_lines.cc reads
out of a data folder. `breaches` compares the two, and is empty if every promise was kept.
"""

import collections
import dataclasses
import subprocess
import threading

import bed
import room


class Answers:
    """Thread-safe. Each answer has a mark, such as how long a trace was when it came, so that what
    was answered up to a mark can be asked for."""

    def __init__(self, mark=lambda: 0):
        self._mark = mark
        self._lock = threading.Lock()
        self._answers = []  # (mark, kind, mission, values...)

    def note(self, kind, mission, *values):
        with self._lock:
            self._answers.append((self._mark(), kind, mission, *values))

    def of(self, kind, mission, until=None):
        """[values ...] of all answers of a kind, in order."""
        with self._lock:
            return [
                answer[3:]
                for answer in self._answers
                if answer[1:3] == (kind, mission) and (until is None or answer[0] <= until)
            ]

    def durable(self, mission, robot, until=None):
        """The highest number that this robot was told is durable."""
        numbers = [n for who, n in self.of("durable", mission, until) if who == robot]
        return max(numbers, default=0)

    def missions(self, until=None):
        """Missions that were made and not deleted; of those whose deletion was asked for and not
        answered nobody knows."""
        with self._lock:
            made, gone = [], set()
            for mark, kind, mission, *_ in self._answers:
                if until is not None and mark > until:
                    continue
                if kind == "created":
                    made.append(mission)
                elif kind in ("deleting", "deleted"):
                    gone.add(mission)
            return [mission for mission in made if mission not in gone]

    def deleted(self, until=None):
        with self._lock:
            return {
                mission
                for mark, kind, mission, *_ in self._answers
                if kind == "deleted" and (until is None or mark <= until)
            }

    def count(self, kind):
        with self._lock:
            return sum(answer[1] == kind for answer in self._answers)


@dataclasses.dataclass
class Journal:
    """One mission's events, as far as they were read."""

    head: int = 0
    numbers_in_order: bool = True
    # robot -> [(sequence, time_ns, x, y, yaw, what)], in the order of events
    observations: dict = dataclasses.field(default_factory=lambda: collections.defaultdict(list))
    tokens: dict = dataclasses.field(default_factory=lambda: collections.defaultdict(list))
    plans: list = dataclasses.field(default_factory=list)  # (id, robot)
    reports: list = dataclasses.field(default_factory=list)  # (id, robot, outcome)
    removed: list = dataclasses.field(default_factory=list)

    def add(self, words):
        """Takes in one line of the reader, split."""
        number, kind, *fields = words
        if int(number) != self.head + 1:
            self.numbers_in_order = False
        self.head = int(number)
        if kind == "scan" or kind == "gas":
            robot, sequence, time_ns, x_m, y_m, yaw_rad, *what = fields
            if kind == "scan":
                what = ("scan", int(what[0]), int(what[1]))
            else:
                what = ("gas", float(what[0]))
            self.observations[robot].append(
                (int(sequence), int(time_ns), float(x_m), float(y_m), float(yaw_rad), what)
            )
        elif kind == "registered":
            self.tokens[fields[0]].append(int(fields[1]))
        elif kind == "plan":
            self.plans.append((len(self.plans) + 1, fields[0]))  # numbered as they come
        elif kind == "report":
            self.reports.append((int(fields[1]), fields[0], fields[2]))
        elif kind == "removed":
            self.removed.append(fields[0])


class DamagedJournal(Exception):
    """The reader refused the folder, or a mission of it."""


def read(data, journals=None):
    """{mission: Journal} of a folder that no server uses; the folder changes as when a server opens
    it, so give it a copy. With journals of an earlier look, only what came after is read and added
    to them."""
    first = min((j.head for j in journals.values()), default=0) + 1 if journals else 1
    journals = {} if journals is None else journals
    seen = {mission: journal.head for mission, journal in journals.items()}
    result = subprocess.run(
        [bed.BUILD_DIR / "bin/journal_lines", data, str(first)],
        capture_output=True,
        text=True,
        timeout=bed.PATIENCE_S,
    )
    if result.returncode != 0:
        raise DamagedJournal(result.stderr.strip() or f"exit code {result.returncode}")
    mission = None
    for line in result.stdout.splitlines():
        words = line.split("\t")
        if words[0] == "mission":
            mission = words[1].rsplit("/", 1)[-1]
            journals.setdefault(mission, Journal())
        elif int(words[0]) > seen.get(mission, 0):
            journals[mission].add(words)
    return journals


def _observation_breaches(robot, index, told, durable):
    numbers = [entry[0] for entry in told]
    if numbers != list(range(1, len(numbers) + 1)):
        doubled = [n for n, count in collections.Counter(numbers).items() if count > 1]
        yield f"{robot}: its numbers are not 1 to {len(numbers)}, each once (doubled: {doubled})"
        return
    if len(numbers) < durable:
        yield f"{robot}: {durable} observations were acknowledged, the journal has {len(numbers)}"
    for entry in told:
        if entry[1:] != room.expected(index, entry[0]):
            yield f"{robot}: observation {entry[0]} is {entry[1:]}, sent was " + str(
                room.expected(index, entry[0])
            )
            return


def _plan_breaches(journal, answers, mission, until):
    answered = answers.of("plan", mission, until)
    numbers = [plan for plan, _ in answered]
    if len(set(numbers)) != len(numbers):
        yield "a plan number was given out twice"
    known = set(journal.plans)
    lost = [plan for plan in answered if plan not in known]
    if lost:
        yield f"plans that were answered are not in the journal: {lost}"
    reports = collections.Counter(journal.reports)
    for report in answers.of("report", mission, until):
        if reports[report] != 1:
            yield f"report {report} stands in the journal {reports[report]} times"


def _lease_breaches(journal, answers, mission, until):
    for robot, tokens in journal.tokens.items():
        if any(later <= earlier for earlier, later in zip(tokens, tokens[1:])):
            yield f"{robot}: lease tokens do not grow: {tokens}"
    for robot, token in answers.of("registered", mission, until):
        if token not in journal.tokens[robot]:
            yield f"{robot}: lease token {token} was answered, the journal does not know it"


def breaches(journals, answers, robots, until=None):
    """[sentence ...]. robots: {name: index in the room} of every mission's robots."""
    found = []
    for mission in answers.missions(until):
        if mission not in journals:
            found.append(f"{mission}: was created, and is not there")
            continue
        journal = journals[mission]
        if not journal.numbers_in_order:
            found.append(f"{mission}: the journal has a gap")
        parts = [
            _plan_breaches(journal, answers, mission, until),
            _lease_breaches(journal, answers, mission, until),
        ]
        for robot, index in robots.items():
            durable = answers.durable(mission, robot, until)
            told = journal.observations[robot]
            parts.append(_observation_breaches(robot, index, told, durable))
        found += [f"{mission}: {breach}" for part in parts for breach in part]
    undead = answers.deleted(until) & set(journals)
    found += [f"{mission}: was deleted, and is there" for mission in undead]
    return found
