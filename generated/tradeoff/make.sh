#!/usr/bin/env bash
# Finds what accuracy costs of the PUMA 560, the UR10 and the Panda: tables and charts in this
# folder, relative to the actuators' limits, which two of the robot files do not have.
#
#   generated/tradeoff/make.sh               all of them anew: minutes each
#   cargo test -p dalembert-cli --lib chart  the charts alone, from the tables
#   generated/tradeoff/make.sh --check       a run of each at 5e-2 alone against its table: where
#                                            it leaves 5 % more operations, that is an error; of one
#                                            robot alone if its name follows
#   generated/tradeoff/make.sh --neighbours  ten tolerances within 2 % of 1e-2 and of 5e-2, of the
#                                            PUMA, each by itself: operations left, and an error
#                                            where the most is over 5 % above the least
set -eu
cd "$(dirname "$0")/../.."
here=generated/tradeoff
made=target/tradeoff
mkdir -p "$made"

# shellcheck disable=SC2086
tradeoff() { ${DALEMBERT:-cargo run --release --quiet -p dalembert-cli --} tradeoff "$@"; }

# The robot file with limits of motion and torque: a velocity, an acceleration, torques.
limited() {
    awk -v velocity="$2" -v acceleration="$3" -v torques="$4" '
        BEGIN { split(torques, torque, ",") }
        /^\[scene/ { exit }
        /^limits = / {
            sub(/ }$/, ", velocity = " velocity ", acceleration = " acceleration \
                ", torque = " torque[++joint] " }")
        }
        { print }' "generated/robots/$1.toml" >"$made/$1.toml"
}

limited ur10 2 10 330,330,150,56,56,56
limited panda 2.175 10 87,87,87,87,12,12,12
cp generated/robots/puma560.toml generated/robots/puma560.plan "$made"

# The operations of the f64 variant that calls its sines, by tolerance.
counts() { awk -F, '$2 == "f64" && $3 == "libm" { print $1, $4 + $5 }' "$1"; }

case "${1-}" in
--check)
    for table in "$here"/*.csv; do
        robot=$(basename "$table" .csv)
        [ "${2-$robot}" = "$robot" ] || continue
        tradeoff "$made/$robot.toml" --tolerances 5e-2 --samples 0 -o "$made/check" >"$made/check.txt"
        counts "$table" >"$made/known.txt"
        counts "$made/check/tradeoff.csv" | awk -v robot="$robot" '
            NR == FNR { known[$1] = $2; next }
            $1 != "0e0" && !($1 in known) { print robot ": " $1 " is not in the table"; bad = 1 }
            $1 in known && $2 > 1.05 * known[$1] {
                print robot " within " $1 ": " $2 " operations, and " known[$1] " in the table"
                bad = 1
            }
            END { exit bad }' "$made/known.txt" -
    done
    ;;
--neighbours)
    for near in 1e-2 5e-2; do
        for part in 0.98 0.984 0.988 0.992 0.996 1 1.004 1.008 1.012 1.016; do
            one=$(awk -v near=$near -v part=$part 'BEGIN { print near * part }')
            tradeoff "$made/puma560.toml" --tolerances "$one" --samples 0 -o "$made/near" >"$made/near.txt"
            counts "$made/near/tradeoff.csv" | grep -v '^0e0 '
        done | awk '
            { print; if (!least || $2 < least) least = $2; if ($2 > most) most = $2 }
            END { if (most > 1.05 * least) { print least " to " most " operations"; exit 1 } }'
    done
    ;;
"")
    for robot in puma560 ur10 panda; do
        tradeoff "$made/$robot.toml" --tolerances 1e-4,1e-3,1e-2,5e-2,1e-1 -o "$made/$robot"
        cp "$made/$robot/tradeoff.csv" "$here/$robot.csv"
        cp "$made/$robot/tradeoff.svg" "$here/$robot.svg"
    done
    ;;
*)
    echo "make.sh [--check | --neighbours]" >&2
    exit 2
    ;;
esac
