#!/usr/bin/env bash
# What the README says was measured: processor time of residuals and fits against the engine's
# scan, the memory that many states take, and two executors against one. Writes the logs into a
# folder that it removes: 200 bytes a state where they are timed, less where they are many.
#
#     fleet/measure.sh [MILLIONS OF STATES] [FLAGS OF CARGO]
set -eu
cd "$(dirname "$0")"
millions=${1:-100}
flags=(--release)
[ $# -gt 1 ] && flags=("${@:2}")
cargo build --quiet --features cluster "${flags[@]}" --bins --examples
built=${CARGO_TARGET_DIR:-target}/$([ "${flags[0]}" = --release ] && echo release || echo debug)
work=$(mktemp -d "${TMPDIR:-/tmp}/fleet-measure.XXXXXX")
started=()
cleanup() {
    for process in "${started[@]}"; do kill "$process" 2>/dev/null || true; done
    rm -rf "$work"
}
trap cleanup EXIT
robot=../generated/robots/ur10.toml

# Runs a command and says how long it took and how much memory at its peak.
measured() {
    local start=$SECONDS peak last=0 process
    "$@" >"$work/said" 2>"$work/notes" &
    process=$!
    while kill -0 "$process" 2>/dev/null; do
        peak=$(awk '/VmHWM/ { print $2 }' "/proc/$process/status" 2>/dev/null || true)
        [ -n "$peak" ] && last=$peak
        sleep 0.2
    done
    wait "$process" || { cat "$work/notes"; return 1; }
    echo "$((SECONDS - start)) s, $((last / 1024)) MiB at its peak"
}

fleet=$built/dalembert-fleet
echo "== processor time, one partition, 2 M states or fewer"
seconds=$((millions < 2 ? millions * 1000 : 2000))
"$fleet" simulate --robot $robot --exact --files 1 --seconds $seconds -o "$work/one" >"$work/said"
"$built/examples/speed" $robot "$work/one/log0000.parquet"

echo "== $millions M states of six joints, --memory 256M"
printf 'simulate: '
measured "$fleet" simulate --robot $robot --exact --zstd --files "$millions" --seconds 1000 -o "$work/many"
du -sh "$work/many"
for command in residual identify; do
    printf '%s: ' $command
    measured "$fleet" $command "$work/many/*.parquet" --robot $robot --memory 256M
done

echo "== executors of one thread each, identify over the same logs"
port=$((43000 + RANDOM % 1000))
"$fleet" scheduler --robot $robot --listen 127.0.0.1:$port 2>/dev/null &
started+=($!)
for count in 1 2; do
    "$fleet" executor --robot $robot --threads 1 --work "$work" \
        --scheduler 127.0.0.1:$port --listen 127.0.0.1:$((port + 10 * count)) 2>/dev/null &
    started+=($!)
    sleep 5
    printf '%s: ' $count
    measured "$fleet" identify "$work/many/*.parquet" --robot $robot --scheduler 127.0.0.1:$port
done
