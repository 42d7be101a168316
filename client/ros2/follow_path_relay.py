#!/usr/bin/env python3
# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Has Nav2's controller follow the paths of `plumescout-ros2 run --drive-by path`.

A node of ROS 2, with the remappings of ROS: it listens to plumescout/path and asks the controller
by its action FollowPath. An empty path says stop.
"""

import rclpy
from nav2_simple_commander.robot_navigator import BasicNavigator
from nav_msgs.msg import Path

LOOK_S = 0.1


def relay(navigator):
    """Follows what comes last, until ROS ends."""
    inbox = []
    navigator.create_subscription(Path, "plumescout/path", inbox.append, 1)
    is_following = False
    while rclpy.ok():
        if is_following:
            is_following = not navigator.isTaskComplete()  # listens meanwhile
        else:
            rclpy.spin_once(navigator, timeout_sec=LOOK_S)
        if not inbox:
            continue
        path = inbox[-1]
        inbox.clear()
        if is_following:
            navigator.cancelTask()
        is_following = bool(path.poses) and bool(navigator.followPath(path))


def main():
    rclpy.init()
    relay(BasicNavigator(node_name="plumescout_follow_path_relay"))


if __name__ == "__main__":
    main()
