#!/usr/bin/env bash
# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
# container.sh FOLDER: makes the image plumescout-server of the packages in the folder, without a
# registry: its base is a fresh Debian 12. Starts it as a user without rights on a root that it cannot
# write, asks for its health, and says how large it is. Needs root. scripts/packages --container runs it.
set -euo pipefail
packages="$(realpath "$1")"
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
image bud --isolation chroot --pull-never --format docker --quiet --build-arg BASE=debian:12 \
  --build-arg PACKAGES="${packages#"$root"/}" -t plumescout-server \
  -f "$root/deploy/container/Dockerfile" "$root" > "$work/image"
bytes="$(image inspect --type image --format '{{.Docker.Size}}' plumescout-server 2> /dev/null || true)"

say "Running it"
container="$(image from --pull-never plumescout-server)"
mounted="$(image mount "$container")"
clean_up() {
  [[ -z "${pid:-}" ]] || { kill "$pid" && wait "$pid"; } || true
  image rm "$container" > /dev/null
}
trap clean_up EXIT
echo "size: $(du -sm "$mounted" | cut -f1) MB${bytes:+ ($bytes bytes by the image)}"
image run --isolation chroot "$container" -- plumescout-server --version
image run --isolation chroot "$container" -- plumescout-server \
  --config /etc/plumescout/plumescout.yaml > "$work/server.out" 2> "$work/server.log" &
pid=$!
for _ in $(seq 150); do
  grep -q '^listening on ' "$work/server.out" && break
  kill -0 "$pid" || { cat "$work/server.log"; exit 1; }
  sleep 0.2
done
image run --isolation chroot "$container" -- bash -c \
  "exec 3<>/dev/tcp/127.0.0.1/50552 && printf 'GET /readyz HTTP/1.0\r\n\r\n' >&3 && read -r line <&3 && echo \"\$line\""
image run --isolation chroot "$container" -- id -un
