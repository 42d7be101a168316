#!/usr/bin/env bash
# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
# installed_package_test.sh BUILD SERVER COMPILER: installs the client library from a build folder,
# builds client/examples/cpp against it, away from the source tree, and has the examples talk to a
# server.
set -euo pipefail
build="$1" server="$2" compiler="$3"
examples="$(cd "$(dirname "$0")/../.." && pwd)/client/examples/cpp"
work="$(mktemp -d)"
server_pid=
clean_up() {
  [[ -z "$server_pid" ]] || kill "$server_pid"
  rm -rf "$work"
}
trap clean_up EXIT
fail() {
  echo "$*" >&2
  exit 1
}

cmake --install "$build" --prefix "$work/prefix" --component client > "$work/install.log"

# Every header that an installed one includes by a path of ours is there.
root="$work/prefix/include/plumescout"
missing="$(cd "$root" && grep -rhoP '^#include "\K(client|core|plumescout|proto|formats)/[^"]+' . |
  sort -u | while read -r header; do [[ -f "$header" ]] || echo "$header"; done)"
[[ -z "$missing" ]] || fail "installed headers include what is not installed: $missing"
[[ -f "$work/prefix/share/plumescout/proto/plumescout/v1/types.proto" ]] || fail "no .proto files"

cp -r "$examples" "$work/source"
cmake -S "$work/source" -B "$work/examples" -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" > "$work/configure.log" ||
  fail "$(cat "$work/configure.log")"
cmake --build "$work/examples" > "$work/build.log" || fail "$(cat "$work/build.log")"

exec 3< <(exec "$server" --listen 127.0.0.1:0 --set observe.http_listen=127.0.0.1:0 --store none \
  2> "$work/server.log")
server_pid=$!
target=
while [[ -z "$target" ]] && read -r -u 3 line; do
  [[ "$line" == "listening on "* ]] && target="${line#listening on }"
done
[[ -n "$target" ]] || fail "$(cat "$work/server.log")"

told="$("$work/examples/toy_robot" "$target" toy)"
[[ "$told" == *Drive* ]] || fail "the robot drove nowhere: $told"
seen="$("$work/examples/watch_map" "$target" toy 1)"
[[ "$seen" == *"m2 free"* ]] || fail "no map was seen: $seen"
