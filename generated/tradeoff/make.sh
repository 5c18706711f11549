#!/usr/bin/env bash
# Finds what accuracy costs of the PUMA 560, the UR10 and the Panda: tables and charts in this
# folder, relative to the actuators' limits, which two of the robot files do not have.
#
#   generated/tradeoff/make.sh            all of them anew: minutes each
#   generated/tradeoff/make.sh --check    a quick run of the PUMA against its table: where it
#                                         leaves a tenth more operations, that is an error
set -eu
cd "$(dirname "$0")/../.."
here=generated/tradeoff
made=target/tradeoff
mkdir -p "$made"

tradeoff() { cargo run --release --quiet -p dalembert-cli -- tradeoff "$@"; }

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

# The operations of the f64 variant that calls its sines, by tolerance.
counts() { awk -F, '$2 == "f64" && $3 == "libm" { print $1, $4 + $5 }' "$1"; }

if [ "${1-}" = --check ]; then
    tradeoff generated/robots/puma560.toml --tolerances 5e-2,1e-1 --samples 0 -o "$made/check"
    counts "$here/puma560.csv" >"$made/known.txt"
    counts "$made/check/tradeoff.csv" | awk '
        NR == FNR { known[$1] = $2; next }
        $1 != "0e0" && !($1 in known) { print $1 " is not in the table"; bad = 1 }
        $1 in known && $2 > 1.1 * known[$1] {
            print "within " $1 ": " $2 " operations, and " known[$1] " in the table"; bad = 1
        }
        END { exit bad }' "$made/known.txt" -
    exit
fi

limited ur10 2 10 330,330,150,56,56,56
limited panda 2.175 10 87,87,87,87,12,12,12
cp generated/robots/puma560.toml generated/robots/puma560.plan "$made"
for robot in puma560 ur10 panda; do
    tradeoff "$made/$robot.toml" --tolerances 1e-4,1e-3,1e-2,5e-2,1e-1 -o "$made/$robot"
    cp "$made/$robot/tradeoff.csv" "$here/$robot.csv"
    cp "$made/$robot/tradeoff.svg" "$here/$robot.svg"
done
