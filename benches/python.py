"""The Python package beside Pinocchio, CasADi, dynibo and the Rust batch: medians of programs
that take turns, in processor time.

In an environment with `dalembert`, `pin`, `casadi`, `dynibo` and `setuptools`, a C compiler
and cargo; what is missing is left out, and said:

    python benches/python.py

Read the ratios: the times are this machine's, and of its load.
"""

from __future__ import annotations

import argparse
import ctypes
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
STATES = 100_000
# So many of them are enough where Python loops.
FEW = 2_000


def rounds(programs: dict, count: int) -> dict[str, float]:
    """Run the programs in turns; return the median nanoseconds of each for a state."""
    times: dict[str, list[float]] = {name: [] for name in programs}
    for _ in range(count):
        for name, (states, program) in programs.items():
            begin = time.process_time()
            program()
            times[name].append(1e9 * (time.process_time() - begin) / states)
    return {name: statistics.median(own) for name, own in times.items()}


def repeated(program):
    def run() -> None:
        for _ in range(FEW):
            program()

    return FEW, run


def pinocchio_of(path: Path, joints: list[str]):
    """Return the URDF as Pinocchio reads it, all other joints locked at zero."""
    import pinocchio as pin

    model = pin.buildModelFromUrdf(str(path))
    others = [model.getJointId(name) for name in model.names[1:] if name not in joints]
    return pin.buildReducedModel(model, others, pin.neutral(model))


def torques_by_casadi(path: Path):
    """Return a robot file's torques but for damping, as `peers` writes them over CasADi's symbols."""
    import casadi

    sys.path.insert(0, str(ROOT / "benches/peers"))
    from model import Arm
    from symbolic import Chain

    arm = Arm(path)
    # A URDF's 1.57079632679 is a right angle to whoever counts operations.
    arm.place = [(np.round(rotation, 9), place) for rotation, place in arm.place]
    chain = Chain(arm)
    q, qd, qdd = chain.q, chain.qd, chain.qdd
    torques = chain.newton_euler(qd, qdd, arm.gravity, None)
    function = casadi.Function("rnea", [q, qd, qdd], [torques])
    with tempfile.TemporaryDirectory() as folder:
        here = os.getcwd()
        os.chdir(folder)
        try:
            function.generate("rnea.c")
            command = ["cc", "-O3", "-march=native", "-shared", "-fPIC", "rnea.c", "-o", "rnea.so"]
            subprocess.run(command, check=True)
            return casadi.external("rnea", "./rnea.so")
        finally:
            os.chdir(here)


def dynibo_of(path: Path, joints: list[str]):
    """Return the URDF as dynibo reads it, all other joints fixed."""
    import dynibo

    def fixed(found: re.Match[str]) -> str:
        other = found["name"] not in joints
        return re.sub('type="[a-z]+"', 'type="fixed"', found[0]) if other else found[0]

    text = re.sub("<mimic[^>]*>", "", path.read_text())
    text = re.sub('<joint name="(?P<name>[^"]*)"[^>]*>', fixed, text)
    with tempfile.NamedTemporaryFile("w", suffix=".urdf") as file:
        file.write(text)
        file.flush()
        return dynibo.Robot.from_urdf(file.name)


def rust_batch(arm, folder: Path):
    """Return the Rust batch of the folder's `arm.toml`, compiled for AVX2."""
    n = len(arm.joints)
    generate = "generate arm.toml -o batch.rs --batch --sincos together --scalar f64"
    command = [sys.executable, "-m", "dalembert", *generate.split(), "--outputs=inverse_dynamics"]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    crates = ROOT / "crates"
    paths = "".join(
        f'dalembert-{name} = {{ path = "{crates / name}", default-features = false }}\n'
        for name in ("batch", "sines")
    )
    (folder / "Cargo.toml").write_text(
        '[package]\nname = "batch"\nversion = "0.0.0"\nedition = "2024"\n[workspace]\n'
        f'[lib]\npath = "lib.rs"\ncrate-type = ["cdylib"]\n[dependencies]\n{paths}'
    )
    (folder / "lib.rs").write_text(
        "mod batch;\nuse std::slice::{from_raw_parts, from_raw_parts_mut};\n"
        f"const N: usize = {n};\n"
        "unsafe fn columns<'a>(x: *const f64, count: usize) -> [&'a [f64]; N] {\n"
        " std::array::from_fn(|i| unsafe { from_raw_parts(x.add(i * count), count) })\n}\n"
        "#[unsafe(no_mangle)]\n"
        "unsafe extern \"C\" fn run(q: *const f64, qd: *const f64, qdd: *const f64, "
        "out: *mut f64, count: usize) {\n unsafe {\n"
        "  let mut out: [&mut [f64]; N] =\n"
        "   std::array::from_fn(|i| from_raw_parts_mut(out.add(i * count), count));\n"
        "  let [q, qd, qdd] = [q, qd, qdd].map(|x| columns(x, count));\n"
        "  batch::inverse_dynamics_columns(&q, &qd, &qdd, &mut out).unwrap();\n }\n}\n"
    )
    subprocess.run(
        ["cargo", "build", "--release", "--quiet"],
        cwd=folder,
        env={**os.environ, "RUSTFLAGS": "-Ctarget-cpu=x86-64-v3", "CARGO_TARGET_DIR": "target"},
        check=True,
    )
    return ctypes.CDLL(str(folder / "target" / "release" / "libbatch.so")).run


def starts(urdf: Path, tip: str) -> None:
    """Print how long an import and loads take, each in a process of its own."""
    load = (
        "import time, dalembert, numpy; t = time.perf_counter();"
        f"dalembert.load({str(urdf)!r}, tip={tip!r}, lock='*', outputs='inverse_dynamics');"
        "print(time.perf_counter() - t)"
    )
    code = "import time; t = time.perf_counter(); import dalembert; print(time.perf_counter() - t)"
    with tempfile.TemporaryDirectory() as cache:
        for name, program, count in [
            ("import dalembert", code, 11),
            ("load, searched, proved and compiled", load, 5),
            ("load from the cache", load, 11),
        ]:
            times = []
            for _ in range(count):
                if count == 5:
                    for file in Path(cache).iterdir():
                        file.unlink()
                done = subprocess.run(
                    [sys.executable, "-c", program],
                    env={**os.environ, "DALEMBERT_CACHE": cache},
                    capture_output=True,
                    text=True,
                    check=True,
                )
                times.append(1e3 * float(done.stdout))
            print(f"{name:40} {statistics.median(times):9.1f} ms, least {min(times):.1f}")


def show(times: dict[str, float]) -> None:
    first = next(iter(times.values()))
    for name, own in times.items():
        print(f"{name:40} {own:9.1f} ns {own / first:8.2f} ×")


def main() -> None:
    options = argparse.ArgumentParser()
    options.add_argument("--urdf", type=Path, default=ROOT / "crates/import/tests/data/panda.urdf")
    options.add_argument("--tip", default="panda_link8")
    options.add_argument("--rounds", type=int, default=21)
    given = options.parse_args()

    import dalembert
    import pinocchio as pin

    arm = dalembert.load(
        given.urdf, tip=given.tip, lock="*", outputs="inverse_dynamics", exact=True, cache=False
    )
    names = [joint.name for joint in arm.joints]
    model = pinocchio_of(given.urdf, names)
    data = model.createData()
    n = model.nv
    assert names == list(model.names[1:]), (names, list(model.names))
    q, qd, qdd = (np.random.default_rng(k).normal(size=(STATES, n)) for k in range(3))
    one = q[0].copy(), qd[0].copy(), qdd[0].copy()
    print(f"{arm.name}: {arm.counts['inverse_dynamics']}")

    def loop(program):
        def run() -> None:
            for k in range(FEW):
                program(q[k], qd[k], qdd[k])

        return FEW, run

    out, result, rust = np.empty(n), np.empty((STATES, n)), np.empty((STATES, n))
    columns = [np.asfortranarray(x) for x in (q, qd, qdd)]
    single = {
        "dalembert": repeated(lambda: arm.inverse_dynamics(*one)),
        "dalembert, out=": repeated(lambda: arm.inverse_dynamics(*one, out=out)),
        "pin.rnea": repeated(lambda: pin.rnea(model, data, *one)),
    }
    many = {
        "dalembert": (STATES, lambda: arm.inverse_dynamics(q, qd, qdd)),
        "dalembert, out=": (STATES, lambda: arm.inverse_dynamics(q, qd, qdd, out=result)),
        "dalembert, columns": (STATES, lambda: arm.inverse_dynamics(*columns)),
        "loop of pin.rnea": loop(lambda *state: pin.rnea(model, data, *state)),
    }
    # Torques of ours have the damping that the URDF gives; those of others may not.
    damping = model.damping * one[1]
    results = {"pin.rnea with damping": pin.rnea(model, data, *one) + damping}
    with tempfile.TemporaryDirectory() as folder:
        arm.save(Path(folder) / "arm.toml")
        try:
            function = torques_by_casadi(Path(folder) / "arm.toml")
            mapped, transposed = function.map(STATES), [x.T.copy() for x in (q, qd, qdd)]
            many["CasADi's map of compiled C"] = (STATES, lambda: mapped(*transposed))
            results["CasADi with damping"] = np.array(function(*one)).ravel() + damping
        except (ImportError, OSError) as error:
            print(f"without CasADi: {error}")
        try:
            robot = dynibo_of(given.urdf, names)
            single["dynibo"] = repeated(lambda: robot.inverse_dynamics(*one))
            many["loop of dynibo"] = loop(robot.inverse_dynamics)
            results["dynibo"] = robot.inverse_dynamics(*one)
        except ImportError as error:
            print(f"without dynibo: {error}")
        try:
            run = rust_batch(arm, Path(folder))
            columns = [np.ascontiguousarray(x.T) for x in (q, qd, qdd, rust)]
            arrays = [ctypes.c_void_p(x.ctypes.data) for x in columns]
            count = ctypes.c_size_t(STATES)
            many["Rust batch, AVX2"] = (STATES, lambda: run(*arrays, count))
            run(*arrays, count)
            results["Rust batch"] = columns[3][:, 0]
        except OSError as error:
            print(f"without the Rust batch: {error}")
        for name, other in results.items():
            difference = np.abs(arm.inverse_dynamics(*one) - other).max()
            print(f"largest difference of a torque from {name}: {difference:.1e} N·m")
        print("\none state, from Python")
        show(rounds(single, given.rounds))
        print(f"\n{STATES} states in one call on one thread, a state")
        show(rounds(many, given.rounds))
    print()
    starts(given.urdf, given.tip)


if __name__ == "__main__":
    main()
