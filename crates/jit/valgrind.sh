#!/usr/bin/env bash
# Machine code, its calls and its memory under valgrind, where that is installed.
set -eu
cd "$(dirname "$0")"
if ! command -v valgrind >/dev/null; then
    echo "valgrind is not installed here: nothing is said of memory"
    exit 0
fi
# The tests' executable, as cargo names it: of the whole workspace, so that nothing is compiled
# with other features.
tests=$(cargo test --workspace --no-run --message-format=json --quiet |
    sed -n '/crates\/jit#/s/.*"executable":"\([^"]*\/all-[^"]*\)".*/\1/p' | tail -1)
# valgrind knows code that is written once, and has no AVX-512.
exec valgrind --quiet --error-exitcode=1 --leak-check=no --smc-check=all-non-file \
    --suppressions=valgrind.supp \
    "$tests" --test-threads=1 calls::
