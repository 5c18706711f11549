"""`peers.py counts ROBOT…`: what CasADi's functions cost, as JSON.
`peers.py run WORK BINARY`: C for the four robots, agreement of all, times, table.

Everything is checked against Pinocchio before it is timed, to 1e-12 of the largest
result. Programs take turns, so that a busy machine is busy for all; what is
reported are medians and ratios of one run.
"""

import json
import os
import platform
import statistics
import subprocess
import sys
from pathlib import Path

import numpy as np

import bars
from model import Arm
from symbolic import Chain, counts

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
ROBOTS = ["puma560", "stanford", "ur10", "panda"]
TIMED = [
    "inverse_dynamics",
    "forward_dynamics",
    "inverse_dynamics_derivatives",
    "forward_dynamics_derivatives",
]
TURNS = 11
# Compared with `mul_add`, since the C is compiled with it; then with every operation rounded.
OURS = "dalembert"
FLAGS = ["-O3", "-march=native", "-ffp-contract=fast"]


def lines(rows):
    return "".join(" ".join(repr(float(x)) for x in row) + "\n" for row in rows)


def expected(arm, function, states):
    """By Pinocchio; friction and armature are none in these robots."""
    import pinocchio as pin

    assert not any(arm.viscous) and not any(arm.armature)
    model = arm.pinocchio()
    data, n = model.createData(), arm.n
    for s in states:
        q, qd, x = s[:n], s[n : 2 * n], s[2 * n :]
        if function == "inverse_dynamics":
            yield pin.rnea(model, data, q, qd, x).copy()
            continue
        if function == "forward_dynamics":
            yield pin.aba(model, data, q, qd, x).copy()
            continue
        d = pin.crba(model, data, q)
        d = np.triu(d) + np.triu(d, 1).T
        if function == "inverse_dynamics_derivatives":
            dq, dqd, _ = pin.computeRNEADerivatives(model, data, q, qd, x)
            yield np.concatenate([m.flatten() for m in (dq, dqd, d)])
        else:
            dq, dqd, dtau = pin.computeABADerivatives(model, data, q, qd, x)
            dtau = np.triu(dtau) + np.triu(dtau, 1).T
            yield np.concatenate([m.flatten() for m in (dq, dqd, dtau)])


def said(command):
    out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return np.array([[float(x) for x in line.split()] for line in out.splitlines()])


def prepared(work, robot, random):
    """A robot and states of it; both are in the folder, too."""
    arm = Arm(ROOT / "generated/robots" / f"{robot}.toml")
    states = random.uniform(-3, 3, (200, 3 * arm.n))
    (work / f"{robot}.states").write_text(lines(states))
    (work / f"{robot}.urdf").write_text(arm.urdf())
    return arm, states


def built(compiler, work, program, source, name, arm, results, more=()):
    """Compiles a function in C into a program that computes and times it."""
    define = [f'-DSOURCE="{source}"', f"-DNAME={name}", f"-DJOINTS={arm.n}", f"-DRESULTS={results}"]
    command = [compiler, *FLAGS, *define, *more, f"-I{work}", str(HERE / "time.c"), "-lm"]
    subprocess.run([*command, "-o", program], check=True, cwd=work)


def agrees(command, truth, robot, library, function):
    """Compares values: what inverts D is that much off for every library, Pinocchio too."""
    pairs = zip(said([command[0], "values", *command[1:]]), truth)
    off = max(np.abs(found - true).max() / np.abs(true).max() for found, true in pairs)
    print(f"{robot} {function} {library}: agrees to {off:.0e}", file=sys.stderr)
    if off > (1e-12 if function.startswith("inverse") else 1e-9):
        raise SystemExit(f"{robot}: {library}'s {function} is off by {off:.1e}")


def machine():
    """The processor."""
    cpus = Path("/proc/cpuinfo").read_text().splitlines()
    names = (line.split(":")[1].strip() for line in cpus if line.startswith("model name"))
    return next(names, platform.processor())


def compilers():
    for name in ("gcc", "clang"):
        try:
            first = subprocess.run([name, "--version"], capture_output=True, text=True)
            yield name, first.stdout.splitlines()[0]
        except FileNotFoundError:
            print(f"{name}: not on this machine", file=sys.stderr)


def run(work, binary):
    work = Path(work)
    work.mkdir(parents=True, exist_ok=True)
    said_by = dict(compilers())
    rows, random = [], np.random.default_rng(20)
    for robot in ROBOTS:
        arm, states = prepared(work, robot, random)
        chain = [
            [slides, *r.flatten(), *p, m, *c, *i.flatten()]
            for slides, (r, p), m, c, i in zip(
                arm.prismatic, arm.place, arm.mass, arm.com, arm.inertia
            )
        ]
        (work / f"{robot}.chain").write_text(lines([arm.gravity, *chain]))
        functions = Chain(arm).functions()
        for name in TIMED:
            truth = list(expected(arm, name, states))
            os.chdir(work)
            source = f"{robot}_{name}.c"
            functions[name].generate(source)
            commands = {
                OURS: [binary, robot, name, "dalembert_fma", "."],
                "each rounded": [binary, robot, name, "dalembert", "."],
            }
            for compiler in said_by:
                program = f"./{robot}_{name}_{compiler}"
                built(compiler, work, program, source, name, arm, len(truth[0]))
                commands[f"CasADi, {compiler}"] = [program, f"{robot}.states"]
            if name in TIMED[:2]:
                for crate in ("dynibo", "phyz"):
                    commands[crate] = [binary, robot, name, crate, "."]
            for library, command in commands.items():
                good = truth
                if library == "dynibo":
                    other = Arm(ROOT / "generated/robots" / f"{robot}.toml")
                    other.gravity = np.array([0, 0, -9.80665])
                    good = list(expected(other, name, states))
                agrees(command, good, robot, library, name)
            times = {library: [] for library in commands}
            for _ in range(TURNS):
                for library, command in commands.items():
                    times[library].append(float(said([command[0], "time", *command[1:]])[0][0]))
            ours = times[OURS]
            row = {"robot": robot, "function": name, "ns": {}, "ratio": {}}
            row["casadi_counts"] = counts(functions[name])
            for library, own in times.items():
                row["ns"][library] = statistics.median(own)
                ratios = [a / b for a, b in zip(own, ours)]
                row["ratio"][library] = statistics.median(ratios)
            rows.append(row)
            print(json.dumps(row), file=sys.stderr, flush=True)
    import casadi
    import pinocchio

    rustc = subprocess.run(["rustc", "--version"], capture_output=True, text=True).stdout.strip()
    about = [
        machine(),
        rustc + ", release, target-cpu=native",
        *(f"{v}, {' '.join(FLAGS)}" for v in said_by.values()),
        f"CasADi {casadi.__version__}, Pinocchio {pinocchio.__version__}",
        subprocess.run(["date", "-u", "+%F"], capture_output=True, text=True).stdout.strip(),
    ]
    write(rows, about)


def write(rows, about):
    rows = sorted(rows, key=lambda row: TIMED.index(row["function"]))
    libraries = list(dict.fromkeys(x for row in rows for x in row["ns"]))
    text = [
        "# Times beside the peers'",
        "",
        "Made by `benches/peers.sh`: " + "; ".join(about) + ".",
        "",
        "Nanoseconds a call, one core, sines and cosines included, and in brackets how many",
        "times ours that is: medians of programs that took turns. Read the ratios. Ours makes one",
        "operation of a product and its sum (`fma: on`), as `-ffp-contract=fast` does of the C;",
        "*each rounded* is ours without.",
        "",
        "![The table as bars](results.svg)",
        "",
        "| function | robot | " + " | ".join(libraries) + " |",
        "|---" * (len(libraries) + 2) + "|",
    ]
    for row in rows:
        cells = []
        for library in libraries:
            if library not in row["ns"]:
                cells.append("–")
            elif library == OURS:
                cells.append(f"{row['ns'][library]:.0f}")
            else:
                cells.append(f"{row['ns'][library]:.0f} ({row['ratio'][library]:.1f})")
        text.append(f"| `{row['function']}` | {row['robot']} | " + " | ".join(cells) + " |")
    (HERE / "RESULTS.md").write_text("\n".join(text) + "\n")
    bars.main()


def main():
    what, *rest = sys.argv[1:]
    if what == "counts":
        for path in rest:
            arm = Arm(path)
            chain = Chain(arm)
            functions = chain.functions() | chain.second_derivatives()
            if arm.is_serial:
                functions |= chain.operational()
            print(json.dumps({"robot": arm.name, **{k: counts(f) for k, f in functions.items()}}))
    else:
        run(*rest)


if __name__ == "__main__":
    main()
