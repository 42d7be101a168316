#!/usr/bin/env bash
# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
# systemd.sh ROOT: boots a Debian 12 that has plumescout-server, plumescout-lab, python3-plumescout and
# systemd installed, with systemd as its first process and loopback alone for a network. A mission is
# driven there; the server is killed, and hangs, and each time systemd begins it anew and the mission is
# there; at last it is stopped. Needs root and systemd-nspawn. scripts/packages --try runs it.
set -euo pipefail
root="$(realpath "$1")"
patience_s=60
machine="plumescout-$$"
log="$root.boot.log"

systemd-nspawn --register=no --keep-unit --private-network --machine="$machine" --quiet \
  --directory="$root" --boot < /dev/null > "$log" 2>&1 &
nspawn=$!
init=""
clean_up() {
  [[ -z "$init" ]] || kill -KILL "$init" 2> /dev/null || true
  wait "$nspawn" || true
}
trap clean_up EXIT

await() {
  local deadline=$((SECONDS + patience_s))
  until "$@" > /dev/null 2>&1; do
    [[ $SECONDS -lt $deadline ]] || { echo "not within $patience_s s: $*" >&2; tail "$log" >&2; exit 1; }
    sleep 0.2
  done
}
find_init() { init="$(pgrep -P "$nspawn")" && [[ "$(cat "/proc/$init/comm")" == systemd ]]; }
inside() { nsenter -t "$init" --mount --uts --ipc --net --pid env -i LC_ALL=C.UTF-8 \
  PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root "$@"; }
booted() { inside systemctl is-active --quiet multi-user.target; }
value() { inside systemctl show plumescout-server --property "$1" --value; }
is_serving() { [[ "$(value ActiveState) $(value StatusText)" == "active serving on port 50551" ]]; }
is_anew() { is_serving && [[ "$(value MainPID)" != "$1" ]]; }
has_mission() { inside plumescoutctl missions show hall; }
drive() { inside plumescout-lab robot --scene "$scene" --out /tmp/robot --mission hall --duration "$1" \
  --server 127.0.0.1:50551; }

await find_init
await booted
inside systemctl enable --quiet plumescout-server
# So that this need not wait for the half minute that the unit allows.
mkdir "$root/etc/systemd/system/plumescout-server.service.d"
printf '[Service]\nWatchdogSec=4\n' > "$root/etc/systemd/system/plumescout-server.service.d/watch.conf"
inside systemctl daemon-reload
inside systemctl start plumescout-server
[[ "$(value ActiveState)" == active ]] # what notifies is ready once start has returned
await is_serving
exposure="$(inside systemd-analyze security --no-pager plumescout-server | grep -oE '[0-9.]+ OK' || true)"
echo "exposure: ${exposure:-beyond what is called OK}"
awk -v exposure="${exposure%% *}" 'BEGIN { exit !(exposure > 0 && exposure <= 2.0) }'

inside plumescout-lab scene generate --seed 1 --count 1 --out /tmp/buildings > /dev/null
scene="$(inside find /tmp/buildings -name scene.json | head -n 1)"
scene="${scene%/*}"
drive 10
before="$(value MainPID)"
inside systemctl kill --kill-whom=main --signal=KILL plumescout-server
await is_anew "$before"
await has_mission
before="$(value MainPID)"
inside systemctl kill --kill-whom=main --signal=STOP plumescout-server # as one that hangs
await is_anew "$before"
inside journalctl --unit plumescout-server --no-pager --grep 'Watchdog timeout' > /dev/null
await has_mission
drive 5
[[ "$(value NRestarts)" == 2 ]]
inside systemctl stop plumescout-server
[[ "$(value Result) $(value ActiveState)" == "success inactive" ]]
echo "killed and hung once each, began anew $(value NRestarts) times, and stopped"
