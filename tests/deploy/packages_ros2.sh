#!/usr/bin/env bash
# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
# Within the machine that packages were installed on, in a network of its own: plumescout-ros2 hears
# a robot by Fast DDS, drives it to a place and records that, and the server has its map.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
ip link set lo up multicast on
export ROS_DOMAIN_ID=7 CYCLONEDDS_URI="file://$here/loopback.xml"

pids=()
trap 'kill "${pids[@]}" 2> /dev/null; wait' EXIT
plumescout-server --listen 127.0.0.1:50551 --store none > /tmp/server.log 2>&1 &
pids+=($!)
"$here/plumescout-ros2-peer" --namespace r1 > /tmp/peer.log &
pids+=($!)

plumescout-ros2 --check --namespace r1 --for 60
plumescout-ros2 run --namespace r1 --mission hall --robot scout --create-mission --max-speed 0.5 \
  --record /tmp/runs 2> /tmp/bridge.log &
bridge=$!
pids+=("$bridge")
for _ in $(seq 120); do
  ! grep -q 'plan [0-9]*: reached' /tmp/bridge.log || break
  sleep 1
done
kill -TERM "$bridge"
wait "$bridge" || { cat /tmp/bridge.log >&2; exit 1; }
grep -q 'plan [0-9]*: reached' /tmp/bridge.log || { cat /tmp/bridge.log >&2; exit 1; }
plumescoutctl robots list hall | grep -q scout
find /tmp/runs/hall -name 'scout.*.mcap' -size +10k | grep -q .
tail -n 1 /tmp/peer.log
