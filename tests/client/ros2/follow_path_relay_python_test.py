# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What the relay to Nav2 does with paths, against stand-ins for rclpy and Nav2."""

import importlib.util
import pathlib
import sys
import types
import unittest

RELAY = pathlib.Path(__file__).resolve().parents[3] / "client/ros2/follow_path_relay.py"


class Navigator:
    """Each look plays one step of the script: a path that comes, or whether the task is over."""

    def __init__(self, steps):
        self.steps = steps
        self.done = []

    def create_subscription(self, _type, topic, callback, _depth):
        self.topic = topic
        self.callback = callback

    def look(self):
        step = self.steps.pop(0)
        if not isinstance(step, bool):
            self.callback(types.SimpleNamespace(poses=step))
            return False
        return step

    def isTaskComplete(self):  # as Nav2 has it
        return self.look()

    def followPath(self, path):
        self.done.append(path.poses)
        return True

    def cancelTask(self):
        self.done.append("cancel")


def play(steps):
    navigator = Navigator(steps)
    sys.modules["rclpy"] = types.SimpleNamespace(
        ok=lambda: bool(navigator.steps), spin_once=lambda node, timeout_sec: node.look()
    )
    commander = types.SimpleNamespace(BasicNavigator=Navigator)
    sys.modules["nav2_simple_commander"] = types.SimpleNamespace(robot_navigator=commander)
    sys.modules["nav2_simple_commander.robot_navigator"] = commander
    messages = types.SimpleNamespace(Path=object)
    sys.modules["nav_msgs"] = types.SimpleNamespace(msg=messages)
    sys.modules["nav_msgs.msg"] = messages
    spec = importlib.util.spec_from_file_location("follow_path_relay", RELAY)
    relay = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(relay)
    relay.relay(navigator)
    return navigator


class FollowPathRelayTest(unittest.TestCase):
    def test_follows_a_path_to_its_end(self):
        navigator = play([False, ["a"], False, True, False])
        self.assertEqual(navigator.topic, "plumescout/path")
        self.assertEqual(navigator.done, [["a"]])

    def test_newer_path_takes_the_place_of_the_one_before(self):
        self.assertEqual(play([["a"], ["b"], True]).done, [["a"], "cancel", ["b"]])

    def test_empty_path_stops(self):
        self.assertEqual(play([["a"], [], False]).done, [["a"], "cancel"])


if __name__ == "__main__":
    unittest.main()
