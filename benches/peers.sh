#!/usr/bin/env bash
# Times generated functions beside what others offer: C that CasADi writes, by gcc
# and by clang where they are, and the crates dynibo and phyz-rigid. Fetches `pin`
# and `casadi` from the Python registry. Writes benches/peers/RESULTS.md and results.svg.
set -eu
cd "$(dirname "$0")/peers"
work=${1:-$PWD/target/work}
mkdir -p "$work"
work=$(cd "$work" && pwd)
[ -x "$work/python/bin/python" ] || python3 -m venv "$work/python"
"$work/python/bin/pip" install --quiet pin==4.1.0 casadi==3.8.2
RUSTFLAGS="-C target-cpu=native" cargo build --release --quiet --target-dir "$work/target"
"$work/python/bin/python" peers.py run "$work" "$work/target/release/peers"
