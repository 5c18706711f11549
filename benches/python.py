"""The Python package beside Pinocchio and CasADi: medians of programs that take turns.

In an environment that has `dalembert`, `pin` and, for the comparison with compiled C,
`casadi` and a C compiler; `dynibo` where it is installed:

    python benches/python.py [--urdf import/tests/data/panda.urdf] [--rust NS]

`--rust` takes the time of a state of the Rust batch, as `cargo bench --bench batch` measures
it on the same machine. Read the ratios: the times are this machine's, and of its load.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
STATES = 100_000


def rounds(programs: dict, count: int) -> dict[str, float]:
    """Run the programs in turns; return the median seconds of each."""
    times: dict[str, list[float]] = {name: [] for name in programs}
    for _ in range(count):
        for name, program in programs.items():
            begin = time.process_time()
            program()
            times[name].append(time.process_time() - begin)
    return {name: statistics.median(own) for name, own in times.items()}


def pinocchio_of(path: Path, joints: list[str]):
    """The URDF as Pinocchio reads it, all other joints locked at zero."""
    import pinocchio as pin

    model = pin.buildModelFromUrdf(str(path))
    others = [model.getJointId(name) for name in model.names[1:] if name not in joints]
    return pin.buildReducedModel(model, others, pin.neutral(model))


def repeated(program, count: int):
    def run() -> None:
        for _ in range(count):
            program()

    return run


def compiled_by_casadi(model):
    """Pinocchio's recursion as CasADi's C, compiled at -O3, mapped over the states."""
    import casadi
    import pinocchio.casadi as cpin

    model = cpin.Model(model)
    data = model.createData()
    q, qd, qdd = (casadi.SX.sym(name, model.nv) for name in ("q", "qd", "qdd"))
    tau = cpin.rnea(model, data, q, qd, qdd)
    function = casadi.Function("rnea", [q, qd, qdd], [tau])
    mapped = function.map(STATES)
    with tempfile.TemporaryDirectory() as folder:
        here = os.getcwd()
        os.chdir(folder)
        try:
            function.generate("rnea.c")
            subprocess.run(
                ["cc", "-O3", "-march=native", "-shared", "-fPIC", "rnea.c", "-o", "rnea.so"],
                check=True,
            )
            mapped = casadi.external("rnea", "./rnea.so").map(STATES)
        finally:
            os.chdir(here)
    return mapped


def starts() -> None:
    """How long an import and loads take, each in a process of its own."""
    urdf = str(ROOT / "import" / "tests" / "data" / "panda.urdf")
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "DALEMBERT_CACHE": folder}
        load = (
            "import time, dalembert, numpy; t = time.perf_counter();"
            f"arm = dalembert.load({urdf!r}, tip='panda_link8', lock='*',"
            "outputs='inverse_dynamics');"
            "print(time.perf_counter() - t, time.process_time())"
        )
        code = "import time; t = time.perf_counter(); import dalembert; print(time.perf_counter() - t)"
        for name, program, count in [
            ("import dalembert", code, 9),
            ("load(panda.urdf), torques", load, 1),
            ("the same from the cache", load, 9),
        ]:
            times = []
            for _ in range(count):
                said = subprocess.run(
                    [sys.executable, "-c", program],
                    env=environment, capture_output=True, text=True, check=True,
                ).stdout
                times.append(float(said.split()[0]))
            print(f"{name:36} {1e3 * statistics.median(times):9.1f} ms, least {1e3 * min(times):.1f}")


def main() -> None:
    options = argparse.ArgumentParser()
    options.add_argument("--urdf", type=Path, default=ROOT / "import/tests/data/panda.urdf")
    options.add_argument("--tip", default="panda_link8")
    options.add_argument("--rust", type=float, help="ns a state of the Rust batch")
    options.add_argument("--rounds", type=int, default=15)
    given = options.parse_args()

    import dalembert
    import pinocchio as pin

    arm = dalembert.load(
        given.urdf, tip=given.tip, lock="*", outputs="inverse_dynamics", exact=True
    )
    n = len(arm.joints)
    model = pinocchio_of(given.urdf, [joint.name for joint in arm.joints])
    data = model.createData()
    if n != model.nv:
        raise SystemExit(f"{given.urdf}: dalembert has {n} joints, Pinocchio {model.nv}")
    q, qd, qdd = (np.random.default_rng(k).normal(size=(STATES, n)) for k in range(3))
    one = q[0].copy(), qd[0].copy(), qdd[0].copy()
    difference = arm.inverse_dynamics(*one) - pin.rnea(model, data, *one)
    print(f"{arm.name}: largest difference of a torque {np.abs(difference).max():.1e} N·m")

    out = np.empty(n)
    single = rounds(
        {
            "dalembert": repeated(lambda: arm.inverse_dynamics(*one), 2000),
            "dalembert, out=": repeated(lambda: arm.inverse_dynamics(*one, out=out), 2000),
            "pin.rnea": repeated(lambda: pin.rnea(model, data, *one), 2000),
        },
        given.rounds,
    )
    print("\none state, from Python")
    show(single, 2000, "dalembert")

    few = 5000
    scale = STATES / few

    def loop() -> None:
        for k in range(few):
            pin.rnea(model, data, q[k], qd[k], qdd[k])

    result = np.empty((STATES, n))
    columns = [np.asfortranarray(x) for x in (q, qd, qdd)]
    programs = {
        "dalembert": lambda: arm.inverse_dynamics(q, qd, qdd, out=result),
        "dalembert, columns": lambda: arm.inverse_dynamics(*columns),
        f"loop of pin.rnea, {few} states": loop,
    }
    try:
        mapped = compiled_by_casadi(model)
        transposed = [x.T.copy() for x in (q, qd, qdd)]
        programs["CasADi's map of compiled C"] = lambda: mapped(*transposed)
    except ImportError as error:
        print(f"no CasADi: {error}")
    many = rounds(programs, given.rounds)
    many = {k: v * (scale if "loop" in k else 1) for k, v in many.items()}
    if given.rust:
        many["Rust batch, as given"] = given.rust * 1e-9 * STATES
    print(f"\n{STATES} states in one call, one thread, ns a state")
    show(many, STATES, "dalembert")
    print()
    starts()


def show(times: dict[str, float], each: int, own: str) -> None:
    for name, seconds in times.items():
        print(f"{name:36} {1e9 * seconds / each:9.1f} ns {seconds / times[own]:7.2f} ×")


if __name__ == "__main__":
    main()
