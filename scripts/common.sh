# Sourced by the scripts beside it: where things are, and how they talk.
set -euo pipefail
ROOT="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
PRESET="${PLUMESCOUT_PRESET:-release}"
BUILD="$ROOT/build/$PRESET"
export OPENBLAS_NUM_THREADS=1

say() { printf '\033[1m==> %s\033[0m\n' "$*"; }

# Quietly unless something is wrong.
configure() {
  cmake --preset "$PRESET" -S "$ROOT" > "$ROOT/build/$PRESET-configure.log" 2>&1 || {
    cat "$ROOT/build/$PRESET-configure.log"
    exit 1
  }
}

# Configures and builds the given targets (all if none).
build() {
  configure
  cmake --build "$BUILD" ${1:+--target "$@"}
}
mkdir -p "$ROOT/build"
