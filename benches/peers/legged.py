"""`legged.py run WORK DALEMBERT`: a quadruped whose base floats: our C beside CasADi's and Pinocchio's
library, one core, one process. `legged.py counts ROBOT…`: what CasADi's functions of such robots cost, as JSON.

Everything is checked against Pinocchio before it is timed. Writes RESULTS_LEGGED.md.
"""

import json
import re
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

import casadi as ca
import numpy as np

from model import Arm
from peers import HERE, ROOT, machine
from symbolic import Chain, best, const, counts, cross, made

ROBOT = ROOT / "gallery/robots/go2.toml"
FLAGS = ["-O3", "-march=native", "-ffp-contract=fast"]
NAMES = {
    "inverse_dynamics": "inv_dyn",
    "inertia": "inertia",
    "inertia_blocks": "inertia_blocks",
    "forward_dynamics": "fwd_dyn",
    "inverse_dynamics_derivatives": "inv_dyn_deriv",
}
# What the peers have, too.
PEERS = [name for name in NAMES if name != "inertia_blocks"]
# Programs take turns in one process.
TURNS = 11


class Floating(Chain):
    """A tree on a base that floats: in the order and the axes of ours, linear over angular, base first."""

    def __init__(self, arm):
        super().__init__(arm)
        n = self.n
        self.qd, self.qdd, self.tau = (ca.SX.sym(x, 6 + n) for x in ("qd", "qdd", "tau"))
        self.g = ca.SX.sym("g", 3)

    def wrench(self, qd, qdd, links):
        """Force and moment on the base over the joints' torques."""
        v, w, dv, dw = qd[:3], qd[3:6], qdd[:3], qdd[3:6]
        motion = (w, dw, dv + cross(w, v) - self.g)
        torques, (f, k) = self.recursion(qd[6:], qdd[6:], motion, links)
        own = self.body(motion, links, self.links)
        return ca.vertcat(f + own[0], k + own[1], torques)

    def functions(self):
        q, qd, qdd, tau, g = self.q, self.qd, self.qdd, self.tau, self.g
        ways = (self.arm.about_origins(), self.arm.regrouped())
        torques = [self.wrench(qd, qdd, way) for way in ways]
        zero = ca.SX(6 + self.n, 1)
        matrices = [ca.jacobian(t, qdd) for t in torques]
        matrices += [self.bordered(way) for way in ways]
        loads = [self.wrench(qd, zero, way) for way in ways]
        state = [q, qd, qdd, g]
        own = lambda name, given, *matrices: made(f"c_{name}", given, *matrices)
        result = {
            "inverse_dynamics": best(*(own("inverse_dynamics", state, t) for t in torques)),
            "gravity": best(*(own("gravity", [q, g], self.wrench(zero, zero, way)) for way in ways)),
            "inertia": best(*(own("inertia", [q], d) for d in matrices)),
        }
        # Elimination from the last joint on leaves zeros between limbs, and ends at the base.
        solved = [self.factored(d, tau - load) for d in matrices for load in loads]
        name = "forward_dynamics"
        result[name] = best(*(own(name, [q, qd, tau, g], x) for x in solved))
        # Those by turns of the base and by the velocity of its origin, and D, are ours as well.
        name = "inverse_dynamics_derivatives"
        slopes = [(ca.jacobian(t, q), ca.jacobian(t, qd)[:, 3:]) for t in torques]
        result[name] = best(*(own(name, state, *both) for both in slopes))
        return result

    def bordered(self, links):
        """D by composite bodies."""
        own = [list(map(const, link)) for link in links]
        n, d = self.n, ca.SX(6 + self.n, 6 + self.n)
        for i in reversed(range(self.links)):
            m, mc, about = own[i]
            f, k = ca.vertcat(-mc[1], mc[0], 0), about[:, 2]
            j = i
            while j >= 0:
                entry = k[2] + (self.arm.armature[i] if i == j else 0)
                d[6 + i, 6 + j] = d[6 + j, 6 + i] = entry
                r, p = self.rotation[j], self.offset[j]
                f = r @ f
                k = r @ k + cross(p, f)
                j = self.arm.parent[j]
            d[:3, 6 + i], d[3:6, 6 + i] = f, k
            d[6 + i, :6] = d[:6, 6 + i].T
            r, p = self.rotation[i], self.offset[i]
            turned, mp = r @ mc, m * p
            hat = lambda x: ca.sparsify(ca.skew(x))
            cp = hat(turned) @ hat(p)
            before = own[self.arm.parent[i]]
            own[self.arm.parent[i]] = [
                before[0] + m,
                before[1] + turned + mp,
                before[2] + r @ about @ r.T - cp - cp.T - hat(mp) @ hat(p),
            ]
        m, mc, about = own[-1]
        hat = ca.sparsify(ca.skew(mc))
        d[:3, :3], d[:3, 3:6], d[3:6, :3], d[3:6, 3:6] = m * ca.SX.eye(3), -hat, hat, about
        return d


def expected(model, s, n):
    """Pinocchio's results at a state, in the order of `Floating.functions`."""
    import pinocchio as pin

    data, (q, qd, x, g) = model.createData(), np.split(s, [n, 2 * n + 6, 3 * n + 12])
    model.gravity.linear = g
    at = np.concatenate([[0, 0, 0, 0, 0, 0, 1], q])
    d = pin.crba(model, data, at)
    d = np.triu(d) + np.triu(d, 1).T
    dq, dqd, _ = pin.computeRNEADerivatives(model, data, at, qd, x)
    return {
        "inverse_dynamics": pin.rnea(model, data, at, qd, x),
        "inertia": d.flatten(),
        "inertia_blocks": np.concatenate([d[:6, :6].flatten(), d[:6, 6:].flatten(), *blocks(d[6:, 6:])]),
        "forward_dynamics": pin.aba(model, data, at, qd, x),
        "inverse_dynamics_derivatives": np.concatenate([dq.flatten(), dqd.flatten(), d.flatten()]),
        "casadi_derivatives": np.concatenate([dq[:, 6:].flatten(), dqd[:, 3:].flatten()]),
    }


def blocks(d):
    """Of D over joints a block a leg, each row by row."""
    legs = [slice(first, first + 3) for first in range(0, len(d), 3)]
    return [d[leg, leg].flatten() for leg in legs]


def header(work, dalembert, name, *options):
    """A header of ours, whose names begin with `name`: the functions' names in it."""
    command = [dalembert, "generate", ROBOT, "--language", "c", "--scalar", "f64", "--sincos", "together"]
    command += ["--outputs", ",".join(NAMES), "--name", name, *options, "-o", work / f"{name}.h"]
    if not (work / f"{name}.h").exists():
        subprocess.run(command, check=True, capture_output=True)
    text = (work / f"{name}.h").read_text()
    found = re.findall(r"^static inline void (\w+?)(?:_batch|_any)?\(", text, re.M)
    ends = {f: (f, short) for f, short in NAMES.items()}
    return {f: next(x for x in found if x in (f"{name}_{a}", f"{name}_{b}")) for f, (a, b) in ends.items()}


CALLS = {
    "inverse_dynamics": "(q[s], qd[s], x[s], g[s], out)",
    "inertia": "(q[s], out)",
    "inertia_blocks": "(q[s], out, out + 36, out + 36 + 6 * N)",
    "forward_dynamics": "(q[s], qd[s], x[s], g[s], out)",
    "inverse_dynamics_derivatives": "(q[s], qd[s], x[s], g[s], out, out + V * V, out + 2 * V * V)",
}
COLUMNS = {
    "inverse_dynamics": "(B, qs, qds, xs, gs, outs)",
    "inertia": "(B, qs, outs)",
    "inertia_blocks": "(B, qs, outs, outs + 36 * B, outs + (36 + 6 * N) * B)",
    "forward_dynamics": "(B, qs, qds, xs, gs, outs)",
    "inverse_dynamics_derivatives": "(B, qs, qds, xs, gs, outs, outs + B * V * V, outs + 2 * B * V * V)",
}
CASADI = {"inverse_dynamics": "q[s], qd[s], x[s], g[s]", "inertia": "q[s]"}


def program(names, n):
    """One program of all functions: `values` prints results, `time` nanoseconds a call."""
    rows, names = [], dict(names)
    batch = names.pop("batch")
    for function in NAMES:
        rows.append(f'BATCH("{function}", {batch[function]}_batch{COLUMNS[function]})')
        for kind, own in names.items():
            call = f"{own[function]}{CALLS[function]}"
            rows.append(f'RUN("{function}", "{kind}", {call})')
        if function not in PEERS:
            continue
        given = CASADI.get(function, "q[s], qd[s], x[s], g[s]")
        inner = f"const double *arg[8] = {{{given}}}; double *res[4] = {{out}}; c_{function}(arg, res, 0, work, 0)"
        rows.append(f'RUN("{function}", "CasADi", {{ {inner}; }})')
    nl = "\n"
    declared = "".join(
        f"int c_{f}(const double **, double **, long long *, double *, int);\n" for f in PEERS
    )
    heads = "".join(f'#include "{kind}.h"\n' for kind in (*names, "batch"))
    return f"""#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
{heads}{declared}
enum {{ N = {n}, V = {n + 6}, S = 256, B = 1024, ROUNDS = 41 }};
static double q[S][N], qd[S][V], x[S][V], g[S][3], out[3 * V * V], work[65536];
static double qs[N * B], qds[V * B], xs[V * B], gs[3 * B], outs[3 * V * V * B];
static double now(void) {{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1e9 + t.tv_nsec;
}}
static int order(const void *a, const void *b) {{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}}
#define RUN(function, library, ...) \\
    if (!strcmp(what, "values")) {{ \\
        for (int s = 0; s < 60; ++s) {{ \\
            memset(out, 0, sizeof out); \\
            __VA_ARGS__; \\
            printf("%s|%s", function, library); \\
            for (int k = 0; k < 3 * V * V; ++k) printf(" %.17g", out[k]); \\
            printf("\\n"); \\
        }} \\
    }} else {{ \\
        double times[ROUNDS]; \\
        for (int r = 0; r < ROUNDS; ++r) {{ \\
            const double start = now(); \\
            for (int s = 0; s < S; ++s) {{ \\
                __VA_ARGS__; \\
                __asm__ volatile("" : : "r"(out) : "memory"); \\
            }} \\
            times[r] = (now() - start) / S; \\
        }} \\
        qsort(times, ROUNDS, sizeof *times, order); \\
        printf("%s|%s %.17g\\n", function, library, times[ROUNDS / 2]); \\
    }}
#define BATCH(function, ...) \\
    if (!strcmp(what, "time")) {{ \\
        double times[ROUNDS]; \\
        for (int r = 0; r < ROUNDS; ++r) {{ \\
            const double start = now(); \\
            __VA_ARGS__; \\
            __asm__ volatile("" : : "r"(outs) : "memory"); \\
            times[r] = (now() - start) / B; \\
        }} \\
        qsort(times, ROUNDS, sizeof *times, order); \\
        printf("%s|batch %.17g\\n", function, times[ROUNDS / 2]); \\
    }}
void pinocchios(double *, double *, double *, double *, int, double *);
int main(int argc, char **argv) {{
    const char *what = argv[1];
    FILE *file = fopen(argv[2], "r");
    for (int s = 0; s < S; ++s) {{
        double *parts[] = {{q[s], qd[s], x[s], g[s]}};
        const int sizes[] = {{N, V, V, 3}};
        for (int p = 0; p < 4; ++p)
            for (int k = 0; k < sizes[p]; ++k)
                if (fscanf(file, "%lf", &parts[p][k]) != 1) return 2;
    }}
    for (int s = 0; s < B; ++s) {{
        for (int k = 0; k < N; ++k) qs[k * B + s] = q[s % S][k];
        for (int k = 0; k < V; ++k) qds[k * B + s] = qd[s % S][k], xs[k * B + s] = x[s % S][k];
        for (int k = 0; k < 3; ++k) gs[k * B + s] = g[s % S][k];
    }}
    {(nl + "    ").join(rows)}
#ifdef PINOCCHIO
    if (!strcmp(what, "time")) {{
        static const char *names[] = {{"inverse_dynamics", "inertia", "forward_dynamics", "inverse_dynamics_derivatives"}};
        double times[4];
        pinocchios(&q[0][0], &qd[0][0], &x[0][0], &g[0][0], S, times);
        for (int k = 0; k < 4; ++k) printf("%s|Pinocchio %.17g\\n", names[k], times[k]);
    }}
#endif
    return 0;
}}
"""


def cpp(arm):
    """Pinocchio's algorithms on the same robot, timed in the same process."""
    floats = lambda x: ", ".join(repr(float(y)) for y in np.asarray(x).flatten())
    row = lambda m: f"(Eigen::Matrix3d() << {floats(m)}).finished()"
    body = lambda m, c, i: f"Inertia({m!r}, Eigen::Vector3d({floats(c)}), {row(i)})"
    lines = [
        "std::vector<JointIndex> joint{model.addJoint(0, JointModelFreeFlyer(), SE3::Identity(), \"base\")};",
        f"model.appendBodyToJoint(joint[0], {body(*arm.base)}, SE3::Identity());",
    ]
    for i in range(arm.n):
        r, p = arm.place[i]
        parent = f"joint[{arm.parent[i] + 1}]"
        place = f"SE3({row(r)}, Eigen::Vector3d({floats(p)}))"
        own = body(arm.mass[i], arm.com[i], arm.inertia[i])
        lines.append(f'joint.push_back(model.addJoint({parent}, JointModelRZ(), {place}, "j{i}"));')
        lines.append(f"model.appendBodyToJoint(joint.back(), {own}, SE3::Identity());")
    build = "\n    ".join(lines)
    return f"""#include <pinocchio/fwd.hpp>
#include <pinocchio/multibody.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <algorithm>
#include <chrono>
#include <vector>
using namespace pinocchio;
static double kept;
template <class F> static double timed(int states, F call) {{
    std::vector<double> times;
    for (int r = 0; r < 41; ++r) {{
        const auto start = std::chrono::steady_clock::now();
        for (int s = 0; s < states; ++s) call(s);
        const std::chrono::duration<double, std::nano> all = std::chrono::steady_clock::now() - start;
        times.push_back(all.count() / states);
    }}
    std::sort(times.begin(), times.end());
    return times[20];
}}
extern "C" void pinocchios(double *q, double *qd, double *x, double *g, int states, double *times) {{
    enum {{ N = {arm.n}, V = {arm.n + 6} }};
    Model model;
    {build}
    Data data(model);
    std::vector<Eigen::VectorXd> at, v, a;
    for (int s = 0; s < states; ++s) {{
        Eigen::VectorXd own = neutral(model);
        own.tail(N) = Eigen::Map<Eigen::VectorXd>(q + s * N, N);
        at.push_back(own);
        v.push_back(Eigen::Map<Eigen::VectorXd>(qd + s * V, V));
        a.push_back(Eigen::Map<Eigen::VectorXd>(x + s * V, V));
    }}
    times[0] = timed(states, [&](int s) {{ kept += rnea(model, data, at[s], v[s], a[s])[3]; }});
    times[1] = timed(states, [&](int s) {{ crba(model, data, at[s]); kept += data.M(3, 4); }});
    times[2] = timed(states, [&](int s) {{ kept += aba(model, data, at[s], v[s], a[s])[3]; }});
    times[3] = timed(states, [&](int s) {{
        data.M.setZero();
        computeRNEADerivatives(model, data, at[s], v[s], a[s]);
        kept += data.dtau_dq(3, 8);
    }});
}}
"""


def compiled(work, arm, names, casadi):
    """Builds the program, with Pinocchio where it can be compiled, and by clang where that is: their names."""
    (work / "legged.c").write_text(program(names, arm.n))
    (work / "legged.cpp").write_text(cpp(arm))
    for function, own in casadi.items():
        own.generate(f"c_{function}.c", {"with_mem": False})
        shutil.move(f"c_{function}.c", work / f"c_{function}.c")
        subprocess.run(["gcc", *FLAGS, "-w", "-c", f"c_{function}.c"], check=True, cwd=work)
    site = Path(ca.__file__).parent
    prefix = site.parent / "cmeel.prefix"
    eigen = Path("/usr/include/eigen3")
    eigen = eigen if eigen.exists() else site / "include/eigen3"
    limits = ["-DBOOST_MPL_LIMIT_LIST_SIZE=30", "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30"]
    limits += ["-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS", "-DBOOST_FUSION_INVOKE_MAX_ARITY=12"]
    command = ["g++", "-std=c++17", *FLAGS, "-w", "-DNDEBUG", "-DEIGEN_MAX_ALIGN_BYTES=16", *limits]
    command += [f"-I{prefix}/include", f"-I{eigen}", "-c", "legged.cpp", "-o", "pinocchio.o"]
    has_pinocchio = subprocess.run(command, cwd=work).returncode == 0
    objects = [f"c_{f}.o" for f in casadi]
    subprocess.run(
        ["gcc", *FLAGS, "-w", *(["-DPINOCCHIO"] if has_pinocchio else []), "-c", "legged.c"],
        check=True,
        cwd=work,
    )
    more = ["legged.o", *objects, "-o", "legged", "-lm"]
    if has_pinocchio:
        more += ["pinocchio.o"]
        more += [f"-L{prefix}/lib", f"-Wl,-rpath,{prefix}/lib", "-lpinocchio_default"]
    subprocess.run(["g++", *more], check=True, cwd=work)
    if not shutil.which("clang"):
        return ["legged"]
    # clang's fast contraction overrides the header's pragma: no other flag.
    subprocess.run(["clang", *FLAGS[:2], "-w", "-c", "legged.c", "-o", "clang.o"], check=True, cwd=work)
    subprocess.run(["gcc", "clang.o", *objects, "-o", "clang", "-lm"], check=True, cwd=work)
    return ["legged", "clang"]


def check(work, built, model, states, n):
    out = subprocess.run([f"./{built}", "values", "legged.states"], check=True, capture_output=True, text=True, cwd=work)
    lines, off = {}, {}
    for line in out.stdout.splitlines():
        key, *values = line.split()
        lines.setdefault(key, []).append(np.array([float(x) for x in values]))
    for key, found in lines.items():
        function, library = key.split("|")
        name = function
        if library == "CasADi" and function == "inverse_dynamics_derivatives":
            name = "casadi_derivatives"
        for s, own in zip(states, found):
            true = expected(model, s, n)[name]
            own = own[: len(true)]
            off[key] = max(off.get(key, 0), np.abs(own - true).max() / np.abs(true).max())
    for key, own in off.items():
        print(f"{key}: agrees to {own:.0e}", file=sys.stderr)
        if own > (1e-9 if key.startswith("forward") else 1e-12):
            raise SystemExit(f"{key} is off by {own:.1e}")


def run(work, dalembert):
    work = Path(work).resolve()
    arm = Arm(ROBOT)
    random = np.random.default_rng(20)
    sizes = [arm.n, 6 + arm.n, 6 + arm.n, 3]
    states = np.hstack([random.uniform(-3, 3, (256, k)) for k in sizes])
    (work / "legged.states").write_text("\n".join(" ".join(map(repr, map(float, s))) for s in states))
    names = {
        "lanes_fma": header(work, dalembert, "lanes_fma", "--fma"),
        "lanes": header(work, dalembert, "lanes"),
        "apart": header(work, dalembert, "apart", "--limbs", "apart"),
        "batch": header(work, dalembert, "batch", "--fma", "--batch"),
    }
    casadi = Floating(arm).functions()
    gravity = casadi.pop("gravity")
    programs = compiled(work, arm, names, casadi)
    for built in programs:
        check(work, built, arm.pinocchio(), states[:60], arm.n)
    times = {}
    for built in programs * TURNS:
        command = [f"./{built}", "time", "legged.states"]
        out = subprocess.run(command, check=True, capture_output=True, text=True, cwd=work)
        for line in out.stdout.splitlines():
            key, time = line.split()
            function, library = key.split("|")
            if built == "clang" and library == "lanes_fma":
                times.setdefault((function, built), []).append(float(time))
            elif built != "clang":
                times.setdefault((function, library), []).append(float(time))
    write(times, casadi | {"gravity": gravity})


def write(times, casadi):
    version = lambda name: subprocess.run([name, "--version"], capture_output=True, text=True).stdout.splitlines()[0]
    compilers = " and ".join(map(version, filter(shutil.which, ["gcc", "clang"])))
    today = subprocess.run(["date", "-u", "+%F"], capture_output=True, text=True).stdout.strip()
    titles = {
        "lanes_fma": "dalembert, `--fma`",
        "clang": "the same by clang",
        "lanes": "dalembert",
        "apart": "`--limbs apart`",
        "batch": "1024 states, `--batch --fma`",
        "CasADi": "CasADi's C",
        "Pinocchio": "Pinocchio",
    }
    shown = [x for x in titles if any(key[1] == x for key in times)]
    text = [
        "# A quadruped beside the peers",
        "",
        f"Made by `benches/peers.sh` with {compilers}, {' '.join(FLAGS)}, {machine()}, {today}.",
        "Unitree's Go2 of the gallery, its base floating: nanoseconds a call with sines, one core, all in one process,",
        "the least of the medians of programs that took turns, and in brackets how many times the first column that is.",
        "Results are checked against Pinocchio's at 60 states. Legs are lanes of loops, but for *apart* and for batches,",
        "whose vectors are of states: columns of 1024 doubles share lines of the cache, and of 1000 they take two thirds of",
        "that time, or a third. Slopes of CasADi are by q, ω and the joints' rates; ours, as Pinocchio's, also by turns and",
        "velocities of the base, with D. `inertia_blocks` is D without the zeros between legs.",
        "",
        "| function | " + " | ".join(titles[x] for x in shown) + " |",
        "|---" * (len(shown) + 1) + "|",
    ]
    for function in NAMES:
        first, cells = times[function, "lanes_fma"], []
        for library in shown:
            own = times.get((function, library))
            if own is None:
                cells.append("–")
                continue
            ratio = statistics.median(a / b for a, b in zip(own, first))
            cells.append(f"{min(own):.0f}" + ("" if library == "lanes_fma" else f" ({ratio:.1f})"))
        text.append(f"| `{function}` | " + " | ".join(cells) + " |")
    text += ["", "CasADi's multiplications/additions/divisions: "]
    text[-1] += "; ".join(f"`{k}` " + "/".join(map(str, counts(f)[:3])) for k, f in casadi.items()) + "."
    (HERE / "RESULTS_LEGGED.md").write_text("\n".join(text) + "\n")


if __name__ == "__main__":
    what, *rest = sys.argv[1:]
    if what == "run":
        run(*rest)
    for robot in rest if what == "counts" else []:
        functions = Floating(Arm(robot)).functions()
        print(json.dumps({"robot": robot, **{k: counts(f) for k, f in functions.items()}}))
