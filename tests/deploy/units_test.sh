#!/usr/bin/env bash
# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
# units_test.sh SYSTEMD_ANALYZE: the unit is what systemd takes, and as hard as operations.md says:
# exposure of 2.0 at most.
set -euo pipefail
analyze="$1"
cd "$(dirname "$0")/../.."
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
sed 's|^ExecStart=/usr/bin/plumescout-server|ExecStart=/bin/true|; /^Documentation=/d' \
  deploy/systemd/plumescout-server.service > "$work/plumescout-server.service"
complaints="$("$analyze" verify "$work/plumescout-server.service" 2>&1 | grep plumescout || true)"
[[ -z "$complaints" ]] || { echo "$complaints"; exit 1; }
"$analyze" security --offline=true --threshold=20 "$work/plumescout-server.service" > "$work/report" ||
  { cat "$work/report"; exit 1; }
tail -n 1 "$work/report"
