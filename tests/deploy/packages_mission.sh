#!/usr/bin/env bash
# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
# Within the machine that packages were installed on: the server, as its unit starts it, plans for a
# simulated robot, is killed, and has the mission again.
set -euo pipefail
unit=/usr/lib/systemd/system/plumescout-server.service
command="$(sed -n 's/^ExecStart=//p' "$unit")"
id plumescout > /dev/null
[[ "$(stat -c %U:%a /var/lib/plumescout)" == plumescout:750 ]]

server_pid=
start_server() {
  # The state's folder as the unit says; not the unit's sandbox, for which there is no systemd here.
  exec 3< <(exec setpriv --reuid=plumescout --regid=plumescout --clear-groups \
    env XDG_STATE_HOME=/var/lib $command --http 127.0.0.1:8080 2> /tmp/server.log)
  server_pid=$!
  local line=""
  while read -r -u 3 line; do [[ "$line" != "listening on "* ]] || return 0; done
  cat /tmp/server.log >&2
  return 1
}
trap '[[ -z "$server_pid" ]] || kill "$server_pid"' EXIT

start_server
exec 4<> /dev/tcp/127.0.0.1/8080
printf 'GET / HTTP/1.1\r\nHost: 127.0.0.1:8080\r\n\r\n' >&4
timeout 30 grep -q '<title>PlumeScout' <&4 || { echo "no console" >&2; exit 1; }

plumescout-lab scene generate --seed 1 --count 1 --out /tmp/buildings > /dev/null
scene="$(dirname "$(find /tmp/buildings -name scene.json | head -n 1)")"
plumescout-lab robot --scene "$scene" --out /tmp/run --mission hall --duration 30 \
  --server 127.0.0.1:50551
plumescoutctl missions list

kill -9 "$server_pid"
wait "$server_pid" 2> /dev/null || true
start_server
plumescoutctl missions show hall | grep -q hall
find /var/lib/plumescout -name store.db | grep -q . || { echo "nothing was kept" >&2; exit 1; }
