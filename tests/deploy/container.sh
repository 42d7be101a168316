#!/usr/bin/env bash
# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
# container.sh FOLDER PROGRAMS: makes the image plumescout-server of the packages in the folder, or if
# that is empty of the source alone (half an hour), without a registry: its base is a fresh Debian 12.
# Starts it as a user without rights on a root that it cannot write, and asks for its health. A simulated
# robot, from outside, drives a mission; the server is killed, started again, and has the mission. PROGRAMS
# has plumescout-lab. Needs root. scripts/packages --container runs it.
set -euo pipefail
packages="${1:+$(realpath "$1")}" programs="$(realpath "$2")"
root="$(cd "$(dirname "$0")/../.." && pwd)"
"$root/scripts/setup" --container
work="$root/out/container"
mkdir -p "$work"
say() { printf '\033[1m==> %s\033[0m\n' "$*"; }
image() { buildah --root "$work/storage" --runroot "$work/run" --storage-driver vfs "$@"; }

if ! image inspect --type image debian:12 > /dev/null 2>&1; then
  say "A fresh Debian 12"
  # As slim as the official one: without manuals, translations and lists of packages.
  mmdebstrap --quiet --variant=minbase --dpkgopt='path-exclude=/usr/share/man/*' \
    --dpkgopt='path-exclude=/usr/share/locale/*' --dpkgopt='path-exclude=/usr/share/doc/*' \
    --dpkgopt='path-include=/usr/share/doc/*/copyright' --aptopt='Apt::Install-Recommends "0"' \
    --customize-hook='rm -rf "$1"/var/lib/apt/lists/* "$1"/var/cache/apt/*' \
    bookworm "$work/base.tar"
  base="$(image from scratch)"
  image add "$base" "$work/base.tar" / > /dev/null
  image config --cmd /bin/bash "$base"
  image commit --quiet --rm "$base" debian:12 > /dev/null
fi
say "The image"
trust=() # behind a proxy with an authority of its own, the one that npm trusts here
[[ -z "${NODE_EXTRA_CA_CERTS:-}" ]] ||
  trust=(--build-arg NODE_EXTRA_CA_CERTS=/tmp/authorities.pem
    --volume "$(realpath "$NODE_EXTRA_CA_CERTS"):/tmp/authorities.pem:ro")
image bud "${trust[@]}" --isolation chroot --pull-never --format docker --quiet --build-arg BASE=debian:12 \
  --build-arg PACKAGES="${packages#"$root"/}" -t plumescout-server \
  -f "$root/deploy/container/Dockerfile" "$root" > "$work/image"

say "Running it"
container="$(image from --pull-never plumescout-server)"
mounted="$(image mount "$container")"
pid="" server=""
clean_up() {
  [[ -z "$server" ]] || kill "$server" 2> /dev/null || true
  [[ -z "$pid" ]] || wait "$pid" || true
  image rm "$container" > /dev/null
}
trap clean_up EXIT
megabytes="$(du -sm "$mounted" | cut -f1)"
echo "size: $megabytes MB"
[[ "$megabytes" -lt 120 ]] || { echo "the image has grown beyond 120 MB" >&2; exit 1; }

run=(image run --isolation chroot --volume "$work/state:/var/lib/plumescout" "$container" --)
rm -rf "$work/state" && install -d -o 999 -g 999 -m 750 "$work/state"
"${run[@]}" plumescout-server --version
# Words of the shell alone: there is nothing else.
[[ "$("${run[@]}" bash -c 'echo $EUID; [[ -w / || -w /etc || -w /usr/bin ]] || echo closed')" == \
  $'999\nclosed' ]]
check="$(sed -n '/^HEALTHCHECK/{n;p}' "$root/deploy/container/Dockerfile")"
check="$(python3 -c 'import json, sys; print(json.loads(sys.argv[1])[2])' "$check")"

# Of the container's processes, which are below `pid`: the server itself.
find_server() {
  local below=("$pid") next
  while [[ ${#below[@]} -gt 0 ]]; do
    next="${below[0]}" below=("${below[@]:1}")
    [[ "$(cat "/proc/$next/comm" 2> /dev/null)" != plumescout-serv ]] || { echo "$next"; return; }
    below+=($(cat /proc/"$next"/task/*/children 2> /dev/null))
  done
}
start_server() {
  "${run[@]}" plumescout-server --config /etc/plumescout/plumescout.yaml \
    > "$work/server.out" 2> "$work/server.log" &
  pid=$!
  for _ in $(seq 150); do
    grep -q '^listening on ' "$work/server.out" && break
    kill -0 "$pid" || { cat "$work/server.log"; exit 1; }
    sleep 0.2
  done
  server="$(find_server)" && [[ -n "$server" ]]
  for _ in $(seq 150); do
    "${run[@]}" bash -c "$check" 2> /dev/null && return
    sleep 0.2
  done
  echo "the health check does not pass" >&2
  exit 1
}
start_server

say "A robot from outside"
rm -rf "$work/buildings" "$work/robot"
"$programs/plumescout-lab" scene generate --seed 1 --count 1 --out "$work/buildings" > /dev/null
scene="$(dirname "$(find "$work/buildings" -name scene.json | head -n 1)")"
"$programs/plumescout-lab" robot --scene "$scene" --out "$work/robot" --mission hall --duration 15 \
  --server 127.0.0.1:50551
kill -9 "$server"
wait "$pid" || true
if "${run[@]}" bash -c "$check" 2> /dev/null; then
  echo "healthy without a server" >&2
  exit 1
fi
start_server
grep -q 'hall' "$work/server.log" || { cat "$work/server.log"; exit 1; }
"$programs/plumescout-lab" robot --scene "$scene" --out "$work/robot" --mission hall --duration 5 \
  --server 127.0.0.1:50551
kill "$server"
wait "$pid" || true
pid="" server=""
say "By runc"
"$root/tests/deploy/runc.sh" "$mounted" "$work/runc"
say "The image serves a mission, is killed, and has it again"
