"""`c.py WORK DALEMBERT`: our C beside CasADi's and Pinocchio's, all by gcc: times, code, stack
and how long gcc takes. Pinocchio's is there if `WORK/pinocchio` is, the program of pinocchio.cpp.

Everything is checked against Pinocchio before it is timed. Programs take turns.
Writes RESULTS_C.md.
"""

import re
import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from peers import FLAGS, HERE, ROBOTS, ROOT, TIMED, TURNS, agrees, built, expected, machine, prepared, said
from symbolic import Chain

OUTPUTS = ",".join(TIMED)
OURS, ROUNDED, CASADI, PINOCCHIO = "dalembert, fma", "dalembert", "CasADi", "Pinocchio"
COMPILED = 3


def header(work, dalembert, robot, fma):
    """Our header of a robot; the names of its functions."""
    for end in ("toml", "plan"):
        shutil.copy(ROOT / "generated/robots" / f"{robot}.{end}", work)
    file = work / f"{robot}{'_fma' if fma else ''}.h"
    if not file.exists():
        options = ["--language", "c", "--scalar", "f64", "--sincos", "together", "--outputs", OUTPUTS]
        command = [dalembert, "generate", work / f"{robot}.toml", *options, "-o", file]
        subprocess.run([*command, *(["--fma"] if fma else [])], check=True, capture_output=True)
    found = re.findall(r"^static inline void (\w+dyn\w*)\(", file.read_text(), re.M)
    kind = lambda name: ("deriv" in name, "inv" in name)  # Of shortened names too.
    return file.name, {f: next(own for own in found if kind(own) == kind(f)) for f in TIMED}


def pinocchios(work, robot):
    """The sources of Pinocchio's two functions, if its generator is there."""
    if not (work / "pinocchio").exists():
        return {}
    folders = [work / f"{robot}_rnea", work / f"{robot}_aba"]
    if not folders[0].exists():
        command = [work / "pinocchio", work / f"{robot}.urdf", *folders]
        subprocess.run(command, check=True, capture_output=True)
    found = {}
    for function, folder, name in zip(TIMED, folders, ("rnea", "aba")):
        [file] = [f for f in folder.iterdir() if f"{name}_forward_zero(" in f.read_text()]
        found[function] = (f"{folder.name}/{file.name}", f"{name}_forward_zero")
    return found


def compiled(work, program, source, name, arm, results, more):
    """Builds a program; seconds, bytes of code and bytes of stack of the function alone."""
    built("gcc", work, work / program, source, name, arm, results, more)
    alone = work / "alone.c"
    call = "void call(const double* s, double* r) { NAME(s, s + J, s + 2 * J, r%s); }"
    rest = ", r + J * J, r + 2 * J * J" if "-DOURS=3" in more else ""
    call = call % rest if more and more[0].startswith("-DOURS") else ""
    alone.write_text(f'#include "{source}"\n' + call.replace("NAME", name).replace("J", str(arm.n)))
    seconds = []
    for _ in range(COMPILED):
        start = time.perf_counter()
        command = ["gcc", *FLAGS, "-w", "-fstack-usage", "-c", "alone.c", "-o", "alone.o"]
        subprocess.run(command, check=True, cwd=work)
        seconds.append(time.perf_counter() - start)
    sections = subprocess.run(["size", "-A", "alone.o"], capture_output=True, text=True, cwd=work)
    sizes = [line.split()[:2] for line in sections.stdout.splitlines()]
    code = sum(int(s[1]) for s in sizes if s and s[0].startswith((".text", ".rodata")))
    # A function that gives sines is called by the other one.
    frames = [line.split("\t") for line in (work / "alone.su").read_text().splitlines()]
    sines = [int(size) for name, size, _ in frames if "_sines_" in name]
    stack = max(int(size) for name, size, _ in frames if "_sines_" not in name) + max(sines, default=0)
    return min(seconds), code, stack


def run(work, dalembert):
    work = Path(work).resolve()
    rows, random = [], np.random.default_rng(20)
    for robot in ROBOTS:
        arm, states = prepared(work, robot, random)
        ours = {fma: header(work, dalembert, robot, fma) for fma in (True, False)}
        functions, other = Chain(arm).functions(), pinocchios(work, robot)
        for function in TIMED:
            truth = list(expected(arm, function, states))
            arrays = f"-DOURS={3 if 'derivatives' in function else 1}"
            sources = {
                OURS: (ours[True][0], ours[True][1][function], [arrays]),
                ROUNDED: (ours[False][0], ours[False][1][function], [arrays]),
            }
            casadi = f"{robot}_{function}.c"
            subprocess.run(["rm", "-f", work / casadi], check=True)
            functions[function].generate(casadi, {"with_mem": False})
            shutil.move(casadi, work / casadi)
            sources[CASADI] = (casadi, function, [])
            if function in other:
                sources[PINOCCHIO] = (*other[function], ["-DPINOCCHIO"])
            row = {"robot": robot, "function": function}
            for library, (source, name, more) in sources.items():
                program = re.sub(r"\W", "_", f"{robot}_{function}_{library}")
                costs = compiled(work, program, source, name, arm, len(truth[0]), more)
                command = [work / program, work / f"{robot}.states"]
                agrees(command, truth, robot, library, function)
                row[library] = [command, [], *costs]
            for _ in range(TURNS):
                for library in sources:
                    [program, file], times = row[library][:2]
                    times.append(float(said([program, "time", file])[0][0]))
            rows.append(row)
            print(robot, function, {k: min(row[k][1]) for k in sources}, file=sys.stderr, flush=True)
    write(rows)


def write(rows):
    gcc = subprocess.run(["gcc", "--version"], capture_output=True, text=True).stdout
    today = subprocess.run(["date", "-u", "+%F"], capture_output=True, text=True).stdout.strip()
    text = [
        "# C beside the peers' C",
        "",
        f"Made by `benches/peers.sh` with {gcc.splitlines()[0]}, {' '.join(FLAGS)}, {machine()}, {today}. In brackets how many",
        "times *dalembert, fma* that is, the median over programs that took turns; gcc fuses products",
        "of the others as it likes, of *dalembert* none. Code is the function's own with its constants, stack its",
        "frame's and that of the function that gives its sines, and seconds are gcc's for it, at the least of three.",
        "",
        "| function | robot | C of | ns a call | bytes of code | bytes of stack | seconds |",
        "|---|---|---|---|---|---|---|",
    ]
    for row in sorted(rows, key=lambda row: TIMED.index(row["function"])):
        first = f"| `{row['function']}` | {row['robot']} |"
        for library in (OURS, ROUNDED, CASADI, PINOCCHIO):
            if library not in row:
                continue
            _, times, seconds, code, stack = row[library]
            ratio = statistics.median(a / b for a, b in zip(times, row[OURS][1]))
            shown = f"{min(times):.0f}" + ("" if library == OURS else f" ({ratio:.1f})")
            text.append(f"{first} {library} | {shown} | {code} | {stack} | {seconds:.2f} |")
            first = "| | |"
    (HERE / "RESULTS_C.md").write_text("\n".join(text) + "\n")


if __name__ == "__main__":
    run(*sys.argv[1:])
