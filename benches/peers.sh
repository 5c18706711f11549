#!/usr/bin/env bash
# Times generated functions beside what others offer: C that CasADi writes, by gcc
# and by clang where they are, and the crates dynibo and phyz-rigid; then our C beside that
# of CasADi and Pinocchio, by gcc. Fetches `pin`, its code generation and `casadi` from the
# Python registry; last a quadruped. Writes benches/peers/RESULTS.md, RESULTS_C.md, RESULTS_LEGGED.md and
# results.svg.
set -eu
cd "$(dirname "$0")/peers"
work=${1:-$PWD/target/work}
mkdir -p "$work"
work=$(cd "$work" && pwd)
[ -x "$work/python/bin/python" ] || python3 -m venv "$work/python"
"$work/python/bin/pip" install --quiet pin==4.1.0 casadi==3.8.2
RUSTFLAGS="-C target-cpu=native" cargo build --release --quiet --target-dir "$work/target"
"$work/python/bin/python" peers.py run "$work" "$work/target/release/peers"

# Pinocchio's code generator is compiled where Debian's libeigen3-dev and liburdfdom-headers-dev are.
if [ ! -x "$work/pinocchio" ]; then
    "$work/python/bin/pip" install --quiet cmeel-cppad==20250000.2 cmeel-cppadcodegen==2.4.3
    prefix=$(echo "$work"/python/lib/python3*/site-packages/cmeel.prefix)
    g++ -std=c++17 -O1 -w -DBOOST_MPL_LIMIT_LIST_SIZE=30 -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS \
        -DBOOST_FUSION_INVOKE_MAX_ARITY=10 "-I$prefix/include" -I/usr/include/eigen3 pinocchio.cpp \
        -o "$work/pinocchio" "-L$prefix/lib" "-Wl,-rpath,$prefix/lib" -lpinocchio_parsers \
        -lpinocchio_default -lcppad_lib -lboost_filesystem -lboost_serialization -ldl ||
        echo "Pinocchio's code generator cannot be compiled here: its C is not compared"
fi
cargo build --release --quiet --manifest-path ../../Cargo.toml -p dalembert-cli
dalembert=${CARGO_TARGET_DIR:-$PWD/../../target}/release/dalembert
"$work/python/bin/python" c.py "$work" "$dalembert"
"$work/python/bin/python" legged.py run "$work" "$dalembert"
