#!/usr/bin/env bash
# promtool_test.sh PROMTOOL PLUMESCOUT_SERVER: what is shipped for Prometheus is what Prometheus takes,
# and so is what a running server tells it.
set -euo pipefail
cd "$(dirname "$0")/../.."
promtool="$1" server="$2"

"$promtool" check config deploy/prometheus/prometheus.yml
"$promtool" check rules deploy/prometheus/alerts.yml
"$promtool" test rules tests/deploy/alerts_test.yml

output="$(mktemp -d)"
"$server" --listen 127.0.0.1:0 --store none > "$output/stdout" 2> "$output/stderr" &
pid=$!
trap 'kill "$pid"; wait "$pid" || true; rm -r "$output"' EXIT
for _ in $(seq 100); do
  grep -q '^listening on ' "$output/stdout" && break
  kill -0 "$pid"
  sleep 0.1
done
port="$(sed -n 's/^metrics on .*://p' "$output/stdout")"
exec 3<> "/dev/tcp/127.0.0.1/$port"
printf 'GET /metrics HTTP/1.1\r\nHost: x\r\n\r\n' >&3
sed '1,/^\r$/d' <&3 > "$output/metrics"
grep -q '^plumescout_uptime_seconds ' "$output/metrics"
"$promtool" check metrics < "$output/metrics"
