#!/usr/bin/env bash
# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
# runc.sh ROOT WORK: runs the image's root by runc as an orchestrator would: mounted read-only, as user
# 999 without capabilities or new privileges, its state and /tmp alone to write to. It is healthy, cannot
# write elsewhere, keeps its missions over a kill -9, and ends in good order. Needs root, and runc.
# container.sh runs it.
set -euo pipefail
root="$(realpath "$1")"
mkdir -p "$2"
work="$(realpath "$2")"
here="$(cd "$(dirname "$0")" && pwd)"
name="plumescout-$$"
bundle="$work/bundle"
rm -rf "$bundle" "$work/state" && mkdir -p "$bundle"
install -d -o 999 -g 999 -m 750 "$work/state"

runc spec --bundle "$bundle"
python3 - "$bundle/config.json" "$root" "$work/state" << 'END'
import json
import sys

path, root, state = sys.argv[1:]
with open(path) as file:
    spec = json.load(file)
spec["root"] = {"path": root, "readonly": True}
process = spec["process"]
process["terminal"] = False
process["user"] = {"uid": 999, "gid": 999}
process["args"] = ["plumescout-server", "--config", "/etc/plumescout/plumescout.yaml"]
process["env"] = ["PATH=/usr/bin", "XDG_STATE_HOME=/var/lib"]
process["capabilities"] = {kind: [] for kind in process["capabilities"]}
process["noNewPrivileges"] = True
spec["mounts"] += [
    {"destination": "/tmp", "type": "tmpfs", "source": "tmpfs",
     "options": ["nosuid", "nodev", "mode=1777", "size=64m"]},
    {"destination": "/var/lib/plumescout", "type": "bind", "source": state, "options": ["rbind", "rw"]},
]
with open(path, "w") as file:
    json.dump(spec, file)
END

pid=""
trap 'runc delete --force "$name" 2> /dev/null || true; [[ -z "$pid" ]] || wait "$pid" || true' EXIT
check="$(sed -n '/^HEALTHCHECK/{n;p}' "$here/../../deploy/container/Dockerfile")"
check="$(python3 -c 'import json, sys; print(json.loads(sys.argv[1])[2])' "$check")"
start() {
  runc run --bundle "$bundle" "$name" > "$work/out" 2> "$work/log" &
  pid=$!
  for _ in $(seq 150); do
    ! runc exec "$name" bash -c "$check" 2> /dev/null || return 0
    kill -0 "$pid" || break
    sleep 0.2
  done
  cat "$work/log" >&2
  exit 1
}
start
runc exec "$name" bash -c '
  set -e
  [[ $EUID == 999 ]]
  for place in /usr/bin/x /etc/x /x; do
    if ( : > "$place" ) 2> /dev/null; then echo "$place was written" >&2; exit 1; fi
  done
  : > /tmp/x
  : > /var/lib/plumescout/x
  while read -r key value; do [[ $key != CapEff: ]] || [[ $value == 0000000000000000 ]] || exit 1; done \
    < /proc/self/status'
runc kill "$name" KILL
wait "$pid" || true
start
runc kill "$name" TERM
wait "$pid"
pid=""
find "$work/state" -name store.db | grep -q . || { echo "nothing was kept" >&2; exit 1; }
echo "runs by runc on a root that is mounted read-only"
