#!/usr/bin/env bash
# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
# packages.sh FOLDER [PEER]: installs each package of the folder in a fresh Debian 12, and all
# together in one, where a server and a simulated robot run a mission that plumescoutctl then asks
# about; once more with systemd at work. PEER, the program plumescout-ros2-peer: also a mission of it
# by DDS, with plumescout-ros2. What needs a package that is not there is left out. Needs root,
# mmdebstrap, systemd-nspawn, and a mirror of Debian. scripts/packages --try runs it.
set -euo pipefail
packages="$(realpath "$1")"
peer="${2:-}"
here="$(cd "$(dirname "$0")" && pwd)"
work="$packages/../packages-root"
base="$work/base.tar"
mkdir -p "$work"
say() { printf '\033[1m==> %s\033[0m\n' "$*"; }

if [[ ! -f "$base" ]]; then
  say "A fresh Debian 12"
  mmdebstrap --quiet --variant=minbase --include=ca-certificates bookworm "$base"
fi

root=""
clean_up() {
  [[ -z "$root" ]] || { umount -q "$root/proc" || true; rm -rf "$root"; }
  root=""
}
trap clean_up EXIT
fresh_root() {
  clean_up
  root="$(mktemp -d "$work/root.XXXX")"
  tar -C "$root" -xf "$base"
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  mkdir "$root/packages"
  cp "$packages"/*.deb "$root/packages/"
  mount -t proc proc "$root/proc"
}
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive \
  HOME=/root LC_ALL=C.UTF-8 "$@"; }
install_packages() {
  inside apt-get update -qq
  inside sh -c "apt-get install -y -qq --no-install-recommends $*" > "$work/install.log" 2>&1 ||
    { tail -n 20 "$work/install.log"; exit 1; }
}

for package in "$packages"/*.deb; do
  name="$(dpkg-deb -f "$package" Package)"
  say "$name alone"
  fresh_root
  install_packages "/packages/${package##*/}"
  case "$name" in
    plumescout-ros2)
      # A robot that is not there is named; one that is there is driven below.
      ! inside plumescout-ros2 --check --for 1 2> "$work/check.log"
      grep -q 'missing: nobody publishes /scan' "$work/check.log"
      inside sh -c 'zcat /usr/share/man/man1/plumescout-ros2.1.gz' | grep -q -- scan.*topic
      ;;&
    plumescout-*) inside "$name" --help > /dev/null ;;
    python3-plumescout) inside plumescoutctl --help > /dev/null ;;
    libplumescout-client-dev)
      install_packages g++ cmake make pkg-config
      cp -r "$here/../../client/examples/cpp" "$root/example"
      inside sh -c "cmake -S /example -B /example/build && cmake --build /example/build" > /dev/null
      ;;
  esac
  inside dpkg --purge "$name" > /dev/null
  left="$(find "$root/usr" -name '*plumescout*' | head -n 3)"
  [[ -z "$left" ]] || { echo "$name leaves behind: $left" >&2; exit 1; }
done

if [[ -x "$peer" && -n "$(find "$packages" -name 'plumescout-ros2_*')" ]]; then
  say "A robot of ROS 2 by Fast DDS"
  fresh_root
  # What the simulated robot is linked with, beside what the packages bring. (dpkg knows some of the
  # libraries by another path; those are of every system.)
  others="$(ldd "$peer" | sed -n 's/.*=> \([^ ]*\) .*/\1/p' | xargs -n 1 realpath |
    { xargs dpkg -S 2> /dev/null || true; } | cut -d: -f1 | sort -u | tr '\n' ' ')"
  install_packages /packages/plumescout-server_* /packages/plumescout-ros2_* \
    /packages/python3-plumescout_* iproute2 "$others"
  cp "$here/packages_ros2.sh" "$here/../ros2_peer/loopback.xml" "$peer" "$root/packages/"
  inside unshare --net bash /packages/packages_ros2.sh
fi

if [[ -z "$(find "$packages" -name 'plumescout-lab_*')" ]]; then
  say "All packages of the folder installed"
  exit
fi
say "A mission"
fresh_root
install_packages /packages/plumescout-server_* /packages/plumescout-lab_* \
  /packages/python3-plumescout_*
cp "$here/packages_mission.sh" "$root/packages/"
inside bash /packages/packages_mission.sh
say "By systemd"
fresh_root
install_packages systemd systemd-sysv dbus /packages/plumescout-server_* /packages/plumescout-lab_* \
  /packages/python3-plumescout_*
umount "$root/proc"
"$here/systemd.sh" "$root"
say "All packages installed, and a mission ran"
