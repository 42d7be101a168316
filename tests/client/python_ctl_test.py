# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs plumescoutctl against the built server."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
import plumescout
from plumescout.ctl import output

from ctl_program import (
    BUILD_DIR,
    PATIENCE_S,
    PROGRAM,
    interrupt,
    interrupted_ctl,
    silent_server,
    start_ctl,
    start_server,
    stop_server,
    wait_until,
)


class CtlTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server, cls.target = start_server()

    @classmethod
    def tearDownClass(cls):
        stop_server(cls.server)

    def setUp(self):
        self.client = plumescout.Client(self.target)
        self.addCleanup(self.client.close)
        for mission in self.client.list_missions():  # of the tests before
            self.client.delete_mission(mission)

    def ctl(self, *arguments, code=0, target=None):
        """Runs the program; returns what it prints."""
        run = subprocess.run(
            ["/usr/bin/python3", PROGRAM, *arguments],
            env=os.environ
            | {
                "PLUMESCOUT_SERVER": target or self.target,
                "PLUMESCOUT_SERVER_PROGRAM": str(BUILD_DIR / "bin/plumescout-server"),
            },
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
        )
        self.assertEqual(run.returncode, code, run.stderr)
        return run.stdout if code == 0 else run.stderr

    def ctl_json(self, *arguments):
        return json.loads(self.ctl(*arguments, "--output", "json"))

    def drive_in_a_room(self, mission):
        """A robot that sees a room of 6 m x 4 m and has a plan."""
        robot = self.client.register(mission, "scout")
        x_m, y_m = 2.0, 1.5
        angles = np.arange(180) * 2 * np.pi / 180
        with np.errstate(divide="ignore"):
            to_x = np.where(np.cos(angles) > 0, 30 - x_m, -x_m) / np.cos(angles)
            to_y = np.where(np.sin(angles) > 0, 30 - y_m, -y_m) / np.sin(angles)
        ranges_m = np.minimum(to_x, to_y)
        for i in range(4):
            robot.add_scan(i, (x_m, y_m, 0.0), ranges_m, 0.0, 2 * np.pi / 180, 8.0)
        robot.add_gas(4, (x_m, y_m, 0.0), 12.0)
        return robot, robot.next_best_trajectory()

    def test_areas_are_closed_and_opened_again(self):
        self.ctl("missions", "create", "yard")
        self.assertIn("2,1 3,1 3,2 2,2", self.ctl("missions", "close", "yard", "spill", "2,1 3,2"))
        areas = self.ctl_json("missions", "close", "yard", "ramp", "-2,1 3,1 3,-2.5")
        self.assertEqual([area["name"] for area in areas], ["spill", "ramp"])
        self.assertEqual(areas[1]["vertices"][2], {"x_m": 3.0, "y_m": -2.5})
        self.ctl("missions", "close", "yard", "ramp", "0,0 1,1", code=1)  # there is one
        self.ctl("missions", "close", "yard", "pit", "0,0 1", code=2)
        self.ctl("missions", "close", "yard", "pit", "0,0", code=1)  # one corner is no area
        self.assertNotIn("spill", self.ctl("missions", "open", "yard", "spill"))
        self.ctl("missions", "open", "yard", "spill", code=4)
        kept = self.client.get_mission("yard").options.keep_out
        self.assertEqual([area.name for area in kept], ["ramp"])

    def test_a_mission_tells_what_became_of_its_objective(self):
        self.ctl("missions", "create", "map")
        self.assertIn("a complete map", self.ctl("missions", "show", "map"))
        objective = {"kind": "OBJECTIVE_KIND_CONFIRM_CLEAN", "threshold_ppm": 10}
        self.client.create_mission("air", {"objective": objective})
        self.assertIn("nothing is known yet", self.ctl("missions", "show", "air"))
        status = self.ctl_json("missions", "show", "air")["objective"]
        self.assertEqual(status["state"], "STATE_PURSUED")

    def test_a_mission_from_its_making_to_its_end(self):
        self.ctl("missions", "create", "life", "--ttl", "3600")
        self.assertEqual(self.client.get_mission("life").idle_time_to_live.seconds, 3600)
        self.assertIn("life", self.ctl("missions", "list"))
        self.assertEqual(self.ctl_json("missions", "pause", "life")["state"], "MISSION_STATE_PAUSED")
        self.ctl("missions", "resume", "life")
        self.ctl("missions", "set-ttl", "life", "never")
        self.assertFalse(self.client.get_mission("life").HasField("idle_time_to_live"))
        self.assertIn("KEEPS EVENTS", self.ctl("missions", "set-keep", "life", "since-snapshot"))
        kept = self.ctl_json("missions", "show", "life")["event_retention"]
        self.assertEqual(kept, "EVENT_RETENTION_SINCE_SNAPSHOT")
        self.assertIn("finished", self.ctl("missions", "finish", "life"))
        refused = self.ctl("missions", "pause", "life", code=1)
        self.assertIn("MISSION_FINISHED", refused)
        self.ctl("missions", "delete", "life")
        self.assertNotIn("life", self.client.list_missions())
        self.ctl("missions", "show", "life", code=4)

    def test_options_of_a_mission_come_from_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "options.json")
            path.write_text('{"planning": {"speed_mps": 0.5}}')
            shown = self.ctl_json(
                "missions", "create", "slow", "--options", str(path), "--keep", "since-snapshot"
            )
            self.assertEqual(shown["event_retention"], "EVENT_RETENTION_SINCE_SNAPSHOT")
            self.assertEqual(shown["options"]["planning"]["speed_mps"], 0.5)
            path.write_text('{"planning": {"spede_mps": 0.5}}')
            self.assertIn("spede_mps", self.ctl("missions", "create", "x", "--options", path, code=2))

    def test_a_mission_that_nobody_calls_for_is_deleted(self):
        self.ctl("missions", "create", "brief", "--ttl", "1")
        wait_until(lambda: "brief" not in self.client.list_missions(), "it is not deleted")

    def test_robots_and_their_plans(self):
        self.client.create_mission("busy")
        robot, plan = self.drive_in_a_room("busy")
        shown = self.ctl_json("robots", "list", "busy")
        self.assertEqual([r["on_map"]["robot"] for r in shown], ["missions/busy/robots/scout"])
        self.assertTrue(shown[0]["leased"])
        self.assertEqual(int(shown[0]["on_map"]["applied_sequence"]), robot.log.last_sequence)
        plans = self.ctl_json("plans", "busy")
        self.assertEqual([p["name"] for p in plans], [plan.proto.name])
        self.assertIn("scout", self.ctl("plans", "busy"))

        self.assertEqual(shown[0]["link"], "ROBOT_LINK_IDLE")
        self.assertEqual(shown[0]["live_plan"], plan.proto.name)
        self.assertIn("PROGRESS", self.ctl("robots", "show", "busy", "scout"))

        self.assertIn("none is free", self.ctl("plan-team", "busy"))
        team = self.ctl_json("plan-team", "busy", "scout")
        told = [one["robot"] for one in team["plans"] + team["left_out"]]
        self.assertEqual(told, ["missions/busy/robots/scout"])
        self.ctl("plan-team", "busy", "nobody", code=4)
        self.assertIn("scout", self.ctl("plan-team", "busy", "scout", "--go-home"))

        self.ctl("robots", "home", "busy", "scout")
        self.assertTrue(self.ctl_json("robots", "show", "busy", "scout")["ordered_home"])
        self.assertIn("ordered", self.ctl("robots", "list", "busy"))
        self.ctl("robots", "cancel-home", "busy", "--all")
        self.assertNotIn("ordered", self.ctl("robots", "list", "busy"))
        self.ctl("robots", "home", "busy", code=2)
        self.ctl("robots", "home", "busy", "nobody", code=4)

        watched = self.ctl_json("robots", "watch", "busy", "scout", "--count", "1")
        self.assertFalse(watched[0]["standing"].get("finished", False))
        self.assertRegex(
            self.ctl("robots", "watch", "busy", "scout", "--count", "1"),
            r"(?m)^\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{3}Z  standing: ",
        )
        self.assertTrue(next(robot.watch()).HasField("standing"))

        self.ctl("robots", "release", "busy", "scout")
        self.assertFalse(self.ctl_json("robots", "show", "busy", "scout")["leased"])
        self.client.register("busy", "scout")  # nobody has to be superseded
        self.ctl("robots", "remove", "busy", "scout")
        self.assertEqual(self.ctl_json("robots", "list", "busy"), [])
        self.ctl("robots", "show", "busy", "scout", code=4)

    def test_maps_become_files(self):
        self.client.create_mission("mapped")
        self.drive_in_a_room("mapped")
        found = self.client.get_map("mapped")
        with tempfile.TemporaryDirectory() as folder:
            paths = {end: str(pathlib.Path(folder, f"map.{end}")) for end in ("yaml", "npy", "csv")}
            for path in paths.values():
                self.ctl("map", "export", "mapped", path)
            np.testing.assert_array_equal(np.load(paths["npy"]), found.gas_mean_ppm)
            table = np.loadtxt(paths["csv"], delimiter=",", skiprows=1)
            self.assertEqual(len(table), np.isfinite(found.gas_mean_ppm).sum())
            row, column = found.cell(*table[0, :2])
            self.assertAlmostEqual(table[0, 2], found.gas_mean_ppm[row, column], places=5)
            # The building survives the way out and in again.
            self.ctl("missions", "create", "known", "--prior-map", paths["yaml"])
            again = self.client.get_map("known")
            self.assertEqual(
                (again.occupancy == plumescout.FREE).sum(),
                (found.occupancy == plumescout.FREE).sum(),
            )
            self.ctl("map", "export", "mapped", paths["npy"], "--species", "ozone", code=1)
            wrong = self.ctl("map", "export", "mapped", str(pathlib.Path(folder, "map.png")), code=2)
            self.assertIn("must end in", wrong)

    def test_the_server_tells_of_itself(self):
        info = self.ctl_json("info")
        self.assertRegex(info["version"], r"^\d+\.\d+\.\d+$")
        self.assertEqual(info["caller_role"], "admin")
        self.assertEqual(info["limits"]["max_batch_observation_count"], 1024)
        self.assertRegex(self.ctl("info"), r"STORE +none: missions are gone")

    def test_top_shows_every_mission(self):
        self.client.create_mission("seen")
        shown = self.ctl("top", "--count", "2", "--interval", "0.01")
        self.assertEqual(shown.count("EVENTS/S"), 2)
        self.assertEqual(shown.count("seen "), 2)

    def test_completion_knows_the_commands(self):
        script = self.ctl("completion", "bash")
        words = 'COMP_WORDS=(plumescoutctl missions p); COMP_CWORD=2; _plumescoutctl; echo "${COMPREPLY[@]}"'
        run = subprocess.run(["bash", "-c", script + words], capture_output=True, text=True)
        self.assertEqual(run.stdout.split(), ["pause"], run.stderr)
        self.assertIn("bashcompinit", self.ctl("completion", "zsh"))

    def test_wrong_command_lines_and_servers_have_their_exit_codes(self):
        self.assertIn("usage", self.ctl("missions", "make", "x", code=2))
        self.assertIn("CLOCK", self.ctl("robots", "list", "--help"))
        self.assertIn("unrecognized", self.ctl("info", "--fast", code=2))
        self.ctl("info", "--timeout", "0.2", code=3, target="127.0.0.1:1")

    def test_what_is_cut_off_is_not_done(self):
        for code, *arguments in ((130, "drain"), (130, "top", "--count", "2"), (0, "top")):
            with self.subTest(arguments=arguments):
                with silent_server() as (silent, target):
                    run = start_ctl(*arguments, target=target)
                    with silent.accept()[0]:  # now it waits for an answer
                        self.assertEqual(interrupt(run), (code, ""))

    def test_who_watches_until_interrupted_is_done_then(self):
        self.client.create_mission("hall")
        self.client.register("hall", "scout")
        for code, count in ((130, "100"), (0, "0")):
            watch = ("robots", "watch", "hall", "scout", "--count", count)
            run = start_ctl(*watch, target=self.target)
            self.assertTrue(run.stdout.readline())
            self.assertEqual(interrupt(run), (code, ""))

    def test_an_interrupt_ends_it_while_it_opens_a_stream(self):
        self.client.create_mission("yard")
        self.client.register("yard", "scout")
        watch = ("robots", "watch", "yard", "scout", "--server", self.target)
        for threads, code, *count in ((1, 130, "--count", "9"), (2, 130, "--count", "9"), (2, 0)):
            run = interrupted_ctl(threads, *watch, *count)
            self.assertEqual((run.returncode, run.stderr), (code, ""))

    def test_an_interrupted_export_leaves_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            with silent_server() as (silent, target):
                run = start_ctl("missions", "export", "hall", f"{folder}/hall", target=target)
                with silent.accept()[0]:
                    wait_until(lambda: os.listdir(folder), "the export has begun")
                    self.assertEqual(interrupt(run), (130, ""))
            self.assertEqual(os.listdir(folder), [])

    def test_drain_ends_the_server(self):
        server, target = start_server()
        self.ctl("drain", target=target)
        self.assertEqual(server.wait(timeout=PATIENCE_S), 0)
        server.stdout.close()


class KeptMissionsTest(unittest.TestCase):
    """What takes a server that keeps its missions."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.data = str(self.folder / "data")
        self.server, self.target = start_server("--data", self.data, store="sqlite")
        self.addCleanup(self.stop)
        self.client = plumescout.Client(self.target)
        self.addCleanup(self.client.close)
        self.client.create_mission("hall")
        self.robot = self.client.register("hall", "scout")
        self.robot.add_gas(1_000_000_000, (1.0, 1.0, 0.0), 12.0)
        for second in range(2, 6):  # free cells take some scans
            time_ns = second * 1_000_000_000
            self.robot.add_scan(time_ns, (1.0, 1.0, 0.0), np.full(90, 2.0), 0.0, 0.07, 8.0)
        self.robot.flush()

    def stop(self):
        if self.server is not None:
            stop_server(self.server)
            self.server = None

    ctl = CtlTest.ctl
    ctl_json = CtlTest.ctl_json

    def test_the_server_tells_where_missions_are(self):
        store = self.ctl_json("info")["store"]
        self.assertEqual((store["engine"], store["available"]), ("sqlite", True))
        self.assertRegex(self.ctl("info"), r"STORE +sqlite, [\d.]+ k?B\n")

    def test_a_mission_goes_out_and_comes_in_again(self):
        path = self.folder / "hall.journal"
        revision = self.client.get_mission("hall").revision
        told = self.ctl("missions", "export", "hall", str(path))
        self.assertIn(f"up to event {revision}", told)
        self.assertEqual(list(self.folder.glob("*.part")), [])
        taken = self.ctl("missions", "import", str(path), code=1)
        self.assertIn("MISSION_EXISTS", taken)
        copy = self.ctl_json("missions", "import", str(path), "--name", "copy")
        self.assertEqual((copy["name"], copy["revision"]), ("missions/copy", str(revision)))
        np.testing.assert_array_equal(
            self.client.get_map("copy").occupancy, self.client.get_map("hall").occupancy
        )
        self.ctl("missions", "delete", "hall")
        self.assertIn("hall", self.ctl("missions", "import", str(path)))

    def test_a_mission_goes_out_as_mcap(self):
        path = self.folder / "hall.mcap"
        self.assertIn("up to event", self.ctl("missions", "export", "hall", str(path)))
        magic = b"\x89MCAP0\r\n"
        data = path.read_bytes()
        self.assertTrue(data.startswith(magic) and data.endswith(magic))
        for topic in (b"/journal", b"/map/occupancy", b"/map/gas/mean", b"/log"):
            self.assertIn(topic, data)
        self.assertIn("EXPORT_DAMAGED", self.ctl("missions", "import", str(path), code=1))
        self.ctl("missions", "export", "hall", str(path.with_suffix(".log")), "--mcap")
        self.assertTrue(path.with_suffix(".log").read_bytes().startswith(magic))

    def test_a_file_that_is_not_whole_is_refused_by_name(self):
        path = self.folder / "hall.journal"
        self.ctl("missions", "export", "hall", str(path))
        whole = path.read_bytes()
        for damaged, what in (
            (whole[:-1], "ends after event"),
            (whole[:8] + b"\x63" + whole[9:], "version 99"),
            (whole[:-3] + bytes([whole[-3] ^ 1]) + whole[-2:], "checksum"),
            (b"nothing", "no journal"),
        ):
            path.write_bytes(damaged)
            refused = self.ctl("missions", "import", str(path), "--name", "copy", code=1)
            self.assertIn(what, refused)
            self.assertIn(str(path), refused)
        self.ctl("missions", "import", str(self.folder / "nowhere"), code=2)
        self.assertEqual(self.client.list_missions(), ["hall"])

    def test_the_history_tells_what_happened(self):
        lines = self.ctl("missions", "history", "hall").splitlines()
        self.assertEqual(len(lines), self.client.get_mission("hall").revision)
        self.assertIn("joins", lines[0])
        self.assertRegex(lines[1], r"2 +1970-01-01 00:00:01.000Z +gas reading +scout +gas reading 1, 12 ppm")
        scans = self.ctl_json("missions", "history", "hall", "--kind", "scan")
        self.assertEqual(len(scans), 4)
        self.assertEqual(scans[0]["summary"], "scan 2, 90 beams at (1.00, 1.00)")
        self.assertEqual(self.ctl_json("missions", "history", "hall", "--kind", "plan"), [])
        last = self.ctl_json("missions", "history", "hall", "--first", "2", "--count", "1")
        self.assertEqual([event["number"] for event in last], ["2"])
        self.ctl("missions", "history", "attic", code=4)
        self.ctl("missions", "history", "hall", "--kind", "wonder", code=2)

    def test_maps_can_be_had_as_they_were(self):
        path = str(self.folder / "then.npy")
        self.ctl("map", "export", "hall", path, "--layer", "occupancy", "--revision", "2")
        self.assertEqual((np.load(path) != plumescout.UNKNOWN).sum(), 0)
        now = str(self.client.get_mission("hall").revision)
        self.ctl("map", "export", "hall", path, "--layer", "occupancy", "--revision", now)
        self.assertGreater((np.load(path) != plumescout.UNKNOWN).sum(), 0)
        self.assertIn("revision", self.ctl("map", "export", "hall", path, "--revision", "99", code=1))

    def test_what_was_kept_can_be_listed_and_verified(self):
        in_use = self.ctl("store", "verify", "--data", self.data, code=1)
        self.assertIn(self.data, in_use)
        revision = self.client.get_mission("hall").revision
        self.stop()
        self.assertIn("is whole", self.ctl("store", "verify", "--data", self.data))
        missions = self.ctl_json("store", "list", "--data", self.data)
        self.assertEqual([(m["mission"], m["events"]) for m in missions], [("hall", revision)])
        self.ctl("store", "verify", "--data", str(self.folder / "nowhere"), code=1)


class ProgressTest(unittest.TestCase):
    def test_who_waits_is_told_how_much_is_done(self):
        with tempfile.TemporaryFile("w+") as told:
            progress = output.Progress("export of hall", silence_s=0.0, file=told)
            with progress:
                progress(1_000_000, 4_000_000)
                wait_until(lambda: told.tell() > 0, "nothing is told")
                progress(4_000_000, 4_000_000)
            told.seek(0)
            self.assertIn("export of hall: ", told.read())
            self.assertIn("waiting for the server", progress.text())


if __name__ == "__main__":
    unittest.main()
