# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""What plumescout-ros2 costs while it drives a robot of ROS 2 by Fast DDS, on loopback.

PLUMESCOUT_BUILD_DIR=build/release PYTHONPATH=tests/deploy \
    /usr/bin/python3 tests/ros2_peer/figures.py --seconds 60
"""

import argparse
import json
import os
import pathlib
import subprocess
import threading
import time

import running

BIN = running.BUILD_DIR / "bin"


def cpu_s(pid):
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def peak_rss_bytes(pid):
    for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmHWM:"):
            return int(line.split()[1]) * 1024
    raise RuntimeError("no VmHWM")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--beams", type=int, default=720)
    parser.add_argument("--record", metavar="DIR", help="have the run recorded there")
    arguments = parser.parse_args()
    domain = str(20 + os.getpid() % 80)
    server = running.Server()
    peer = subprocess.Popen(
        [BIN / "plumescout-ros2-peer", "--domain", domain, "--beams", str(arguments.beams)],
        stdout=subprocess.PIPE,
        text=True,
    )
    said = {}
    reader = threading.Thread(
        target=lambda: [said.update(json.loads(line)) for line in peer.stdout]
    )
    reader.start()
    loopback = f"file://{running.ROOT}/tests/ros2_peer/loopback.xml"
    bridge = subprocess.Popen(
        [BIN / "plumescout-ros2", "run", "--server", server.target, "--mission", "hall"]
        + ["--robot", "r1", "--create-mission", "--max-speed", "0.5", "--domain", domain]
        + (["--record", arguments.record] if arguments.record else []),
        env=dict(os.environ, CYCLONEDDS_URI=loopback),
        stderr=subprocess.DEVNULL,
    )
    try:
        running.await_that(lambda: said.get("paths", 0) > 0, "the first plan")
        began, cpu_before = time.monotonic(), cpu_s(bridge.pid)
        while time.monotonic() < began + arguments.seconds and bridge.poll() is None:
            time.sleep(0.1)
            if bridge.poll() is None:
                elapsed_s = time.monotonic() - began
                share = (cpu_s(bridge.pid) - cpu_before) / elapsed_s
                peak = peak_rss_bytes(bridge.pid)
        print(f"{elapsed_s:.0f} s, {arguments.beams} beams at 10 Hz, {said['paths']} paths")
        print(f"scan out to path in, by the robot: median {said['path_latency_median_s']:.4f} s")
        print(f"plumescout-ros2: {share:.3f} of a core, at most {peak / 1e6:.1f} MB")
    finally:
        for process in bridge, peer:
            if process.poll() is None:
                process.terminate()
            process.wait(timeout=running.PATIENCE_S)
        reader.join()
        server.stop()


if __name__ == "__main__":
    main()
