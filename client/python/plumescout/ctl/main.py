# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""The command line of plumescoutctl."""

import argparse
import os
import signal
import sys

import grpc
import plumescout
from google.protobuf import json_format

from .. import tokens
from .._map_files import LAYERS
from . import commands, completion, interrupts, store, words
from .output import Printer

EXIT_REFUSED, EXIT_USAGE, EXIT_UNREACHABLE, EXIT_NOT_FOUND = 1, 2, 3, 4
EXIT_INTERRUPTED = 130  # as shells say that SIGINT ended a program
_EPILOG = """\
exit codes: 0 done; 1 the server refused; 2 the command line is wrong; 3 the server cannot be
reached; 4 no such mission or robot; 130 interrupted before it was done. What goes on until
Ctrl-C (top, robots watch, without --count) is done then.

examples:
  plumescoutctl missions list
  plumescoutctl --output json robots list hall
  plumescoutctl missions create hall --ttl 3600
  plumescoutctl map export hall hall.yaml        also writes hall.pgm, for map_server
  plumescoutctl map export hall gas.csv --layer gas-mean
  plumescoutctl missions export hall hall.journal
  plumescoutctl missions export hall hall.mcap   to look at in Foxglove
  plumescoutctl missions history hall --kind plan
  plumescoutctl plan-team hall                   a plan for every robot that has none
  plumescoutctl robots home hall --all
  plumescoutctl missions close hall spill "2,1 3,2"
  plumescoutctl robots watch hall r1
  plumescoutctl store verify --data /var/lib/plumescout
  plumescoutctl completion bash > ~/.local/share/bash-completion/completions/plumescoutctl
"""
_CODES = {
    grpc.StatusCode.UNAVAILABLE: EXIT_UNREACHABLE,
    grpc.StatusCode.DEADLINE_EXCEEDED: EXIT_UNREACHABLE,
    grpc.StatusCode.NOT_FOUND: EXIT_NOT_FOUND,
}


def main(argv=None):
    """Returns the exit code."""
    try:
        if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
            signal.signal(signal.SIGINT, signal.default_int_handler)
        parser = make_parser()
        arguments, rest = parser.parse_known_args(sys.argv[1:] if argv is None else argv)
        return _carry_out(parser, arguments, rest)
    except KeyboardInterrupt:
        return EXIT_INTERRUPTED


def _carry_out(parser, arguments, rest):
    if arguments.command in (tokens.main, store.run):
        return arguments.command(rest)
    if rest:
        parser.error(f"unrecognized arguments: {' '.join(rest)}")
    if arguments.command is _completion:
        print(completion.script(parser, arguments.shell), end="")
        return 0
    try:
        client = connect(arguments)
        code = 0 if _goes_on(arguments) else EXIT_INTERRUPTED
        return interrupts.carry_out(lambda: _use(client, arguments), client.close, code)
    except plumescout.PlumeScoutError as error:
        print(f"plumescoutctl: {error}", file=sys.stderr)
        return _CODES.get(error.code, EXIT_REFUSED)
    except (OSError, ValueError, json_format.ParseError) as error:
        print(f"plumescoutctl: {error}", file=sys.stderr)
        return EXIT_USAGE


def _use(client, arguments):
    with client:
        arguments.command(client, arguments, Printer(arguments.output))
    return 0


def _goes_on(arguments):
    """Whether nothing but Ctrl-C ends it."""
    return arguments.command in (commands.show_top, commands.watch_robot) and not arguments.count


def connect(arguments):
    return plumescout.Client(
        arguments.server,
        arguments.timeout,
        tls_ca=arguments.tls_ca,
        tls_cert=arguments.tls_cert,
        tls_key=arguments.tls_key,
        token_file=arguments.token_file,
    )


def make_parser():
    parser = argparse.ArgumentParser(
        prog="plumescoutctl",
        description="Looks after a PlumeScout server: its missions, robots, maps and itself.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    server = os.environ.get("PLUMESCOUT_SERVER", "127.0.0.1:50551")
    parser.set_defaults(server=server, timeout=10.0, output="table")
    parser.set_defaults(tls_ca=None, tls_cert=None, tls_key=None, token_file=None)
    _add_everywhere(parser)
    groups = parser.add_subparsers(metavar="COMMAND", required=True)
    _add_missions(groups)
    _add_robots(groups)
    _add_map(groups)
    plans = _add(groups, "plans", "where the robots of a mission drive now, and when they arrive")
    _takes(plans, commands.list_plans, "mission")
    team = _add(
        groups,
        "plan-team",
        "plan for several robots at once; each drives its plan when it asks for the next",
    )
    _takes(team, commands.plan_team, "mission")
    team.add_argument(
        "robots",
        nargs="*",
        metavar="robot",
        help="its live plan is replaced; default: all robots that have none",
    )
    team.add_argument("--go-home", action="store_true", help="plan their ways home")
    _takes(_add(groups, "info", "version, limits and features"), commands.show_server)
    _takes(_add(groups, "drain", "take the server out of service"), commands.drain_server)
    token = groups.add_parser("tokens", help="create, list and revoke tokens", add_help=False)
    token.set_defaults(command=tokens.main)
    kept = groups.add_parser(
        "store", help="list and verify what a server that is down has kept", add_help=False
    )
    kept.set_defaults(command=store.run)
    top = _takes(_add(groups, "top", "follow all missions"), commands.show_top)
    top.add_argument("--interval", type=_positive, default=2.0, metavar="S", help="default: 2")
    top.add_argument("--count", type=int, default=0, metavar="N", help="looks; 0: until Ctrl-C")
    shell = _add(groups, "completion", "print a completion script")
    shell.add_argument("shell", choices=("bash", "zsh"))
    shell.set_defaults(command=_completion)
    return parser


def _add_everywhere(parser):
    """Options that may stand before and after the command."""
    absent = argparse.SUPPRESS  # an option before the command is not undone by its absence after it
    parser.add_argument(
        "--server",
        default=absent,
        metavar="HOST:PORT",
        help="default: $PLUMESCOUT_SERVER, or 127.0.0.1:50551",
    )
    parser.add_argument(
        "--timeout", type=_positive, default=absent, metavar="S", help="of a call; default: 10"
    )
    for name, what in (
        ("--tls-ca", "PEM file of the server's authority; default: $PLUMESCOUT_TLS_CA, or plaintext"),
        ("--tls-cert", "PEM file of your certificate; default: $PLUMESCOUT_TLS_CERT"),
        ("--tls-key", "PEM file of its key; default: $PLUMESCOUT_TLS_KEY"),
        ("--token-file", "holds your token; default: $PLUMESCOUT_TOKEN_FILE"),
    ):
        parser.add_argument(name, default=absent, metavar="FILE", help=what)
    parser.add_argument(
        "--output", choices=("table", "json"), default=absent, help="default: table"
    )


KEPT_EVENTS = ("all", "since-snapshot")


def _add_missions(groups):
    missions = _add(groups, "missions", "list, show, create and change missions")
    steps = missions.add_subparsers(metavar="COMMAND", required=True)
    _takes(_add(steps, "list", "all missions"), commands.list_missions)
    _takes(_add(steps, "show", "one mission"), commands.show_mission, "mission")
    create = _takes(_add(steps, "create", "make a mission"), commands.create_mission, "mission")
    create.add_argument(
        "--options", metavar="FILE", help="JSON of plumescout.v1.MissionOptions"
    )
    create.add_argument("--prior-map", metavar="YAML", help="a known building, of map_server")
    create.add_argument(
        "--ttl", type=_positive, metavar="S", help="delete it when nobody calls for so long"
    )
    create.add_argument(
        "--keep", choices=KEPT_EVENTS, default="all", help="events on the disk; default: all"
    )
    create.add_argument("--exist-ok", action="store_true", help="it may be there already")
    for word, what, command in (
        ("pause", "no new plans; observations are taken", commands.pause_mission),
        ("resume", "end a pause", commands.resume_mission),
        ("finish", "close it for good: it can be read only", commands.finish_mission),
        ("delete", "delete it and all it holds", commands.delete_mission),
    ):
        _takes(_add(steps, word, what), command, "mission")
    close = _takes(
        _add(steps, "close", "close an area to robots"), commands.close_area, "mission", "area"
    )
    close.add_argument(
        "corners", type=_corners, help='"x,y x,y ...", metres; two are those of a rectangle'
    )
    _takes(_add(steps, "open", "open it again"), commands.open_area, "mission", "area")
    export = _takes(
        _add(steps, "export", "write a mission to a file"), commands.export_mission, "mission"
    )
    export.add_argument(
        "file",
        help=".mcap: MCAP, which Foxglove shows; else a journal, which missions import takes. "
        "plumescout-lab replay reads both",
    )
    export.add_argument("--mcap", action="store_true", help="MCAP, whatever the file's name")
    imported = _takes(
        _add(steps, "import", "make a mission of an exported one"), commands.import_mission, "file"
    )
    imported.add_argument("--name", metavar="MISSION", help="default: that in the file")
    history = _takes(
        _add(steps, "history", "what happened, a line for each event"),
        commands.show_history,
        "mission",
    )
    history.add_argument(
        "--kind", action="append", choices=sorted(words.EVENT_KINDS), help="may be repeated"
    )
    history.add_argument(
        "--first", type=_count, default=0, metavar="N", help="from the event of this number on"
    )
    history.add_argument("--count", type=_count, default=0, metavar="N", help="events; 0: all")
    ttl = _takes(_add(steps, "set-ttl", "how long it may idle"), commands.set_ttl, "mission")
    ttl.add_argument("seconds", type=_seconds_or_never, help='seconds, or "never"')
    keep = _takes(
        _add(steps, "set-keep", "which events stay on the disk"), commands.set_keep, "mission"
    )
    keep.add_argument("events", choices=KEPT_EVENTS, help="since-snapshot: what recovery needs")


def _add_robots(groups):
    robots = _add(groups, "robots", "list, show, send home and remove robots")
    steps = robots.add_subparsers(metavar="COMMAND", required=True)
    listed = _takes(_add(steps, "list", "robots of a mission"), commands.list_robots, "mission")
    shown = _takes(_add(steps, "show", "one robot"), commands.show_robot, "mission", "robot")
    for parser in (listed, shown):
        parser.epilog = words.ROBOT_COLUMNS
        parser.formatter_class = argparse.RawDescriptionHelpFormatter
    for word, what, command in (
        ("remove", "take it out of the mission, as one that died", commands.remove_robot),
        ("release", "free its lease for another client", commands.release_lease),
    ):
        _takes(_add(steps, word, what), command, "mission", "robot")
    for word, what, command in (
        ("home", "send one robot, or all, home with the next plan", commands.send_home),
        ("cancel-home", "take that back", commands.cancel_home),
    ):
        order = _takes(_add(steps, word, what), command, "mission")
        order.add_argument("robot", nargs="?", help=_NAMES["robot"])
        order.add_argument("--all", action="store_true", help="all robots of the mission")
    watch = _add(
        steps,
        "watch",
        "follow what a robot is told unasked, with when each line came: how it stands, its plan",
    )
    _takes(watch, commands.watch_robot, "mission", "robot")
    watch.add_argument(
        "--count", type=_count, default=0, metavar="N", help="notices; 0: until Ctrl-C"
    )


def _add_map(groups):
    maps = _add(groups, "map", "maps as files")
    steps = maps.add_subparsers(metavar="COMMAND", required=True)
    export = _takes(_add(steps, "export", "write a map"), commands.export_map, "mission")
    export.add_argument("file", help=".yaml (map_server, with a .pgm), .npy or .csv")
    export.add_argument("--layer", choices=LAYERS, help="default: gas-mean; of .yaml: occupancy")
    export.add_argument(
        "--revision", type=_count, default=0, metavar="N", help="as it was after event N"
    )
    export.add_argument("--species", metavar="NAME", help="of which gas; default: the first")


def _add(groups, word, what):
    return groups.add_parser(word, help=what, description=what[0].upper() + what[1:] + ".")


_NAMES = {
    "mission": "its name, as in missions list",
    "robot": "its name, as in robots list",
    "area": "name of a keep-out area",
    "file": "to read",
}


def _takes(parser, command, *names):
    for name in names:
        parser.add_argument(name, help=_NAMES[name])
    _add_everywhere(parser)
    parser.set_defaults(command=command)
    return parser


def _completion(*_):
    raise AssertionError("main prints the script")


def _positive(text):
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} must be > 0")
    return value


def _corners(text):
    """"1,2 3,4" as [(1.0, 2.0), (3.0, 4.0)]."""
    try:
        return [(float(x_m), float(y_m)) for x_m, y_m in (c.split(",") for c in text.split())]
    except ValueError:
        raise argparse.ArgumentTypeError(f'"{text}" is not "x,y x,y ..."') from None


def _count(text):
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"{text} must be >= 0")
    return value


def _seconds_or_never(text):
    return None if text == "never" else _positive(text)
