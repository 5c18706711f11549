"""Writes second derivatives of the torques and accelerations of robots into a file a robot
beside this one. `pinocchio.cpp` has what Pinocchio's Python lacks:

    pip install pin==4.1.0 casadi==3.8.2 mpmath numpy
    P=$(python -c "import cmeel, pathlib; print(pathlib.Path(cmeel.__path__[0]).parent / 'cmeel.prefix')")
    g++ -O1 -w -std=c++17 -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS -DBOOST_MPL_LIMIT_LIST_SIZE=30 \\
        -DBOOST_FUSION_INVOKE_MAX_ARITY=10 -I$P/include -I/usr/include/eigen3 pinocchio.cpp \\
        -o second -L$P/lib -lpinocchio_default -Wl,-rpath,$P/lib
    python make.py ./second

Those of the torques are Pinocchio's tensors times λ. Those of the accelerations that follow from
these have lost three or four digits where a wrist is lighter than its arm by orders, so they
are CasADi's, which differentiates articulated bodies, in forty digits.
"""

import json
import subprocess
import sys
from pathlib import Path

import casadi as ca
import mpmath as mp
import numpy as np
import pinocchio as pin

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[3]
sys.path.insert(0, str(ROOT / "benches/peers"))
from model import Arm  # noqa: E402
from symbolic import Chain, made  # noqa: E402

mp.mp.dps = 40

NAMES = ["planar2r", "planar3r", "puma560", "stanford", "ur10", "panda"]
STATES = 5


def tensors(program, arm, states):
    """∂²τ by q and q, q̇ and q̇, q and q̇, q̈ and q, of each state (q, q̇, q̈)."""
    n = arm.n
    rows = [[n, len(states)], arm.gravity]
    for i in range(n):
        rotation, offset = arm.place[i]
        own = [arm.mass[i], *arm.com[i], *arm.inertia[i].flatten()]
        rows.append([int(arm.prismatic[i]), *rotation.flatten(), *offset, *own])
    rows += [np.concatenate(state) for state in states]
    text = "\n".join(" ".join(repr(float(x) if x % 1 else int(x)) for x in row) for row in rows)
    said = subprocess.run([program], input=text, check=True, capture_output=True, text=True)
    for line in said.stdout.splitlines():
        yield np.array([float(x) for x in line.split()]).reshape(4, n, n, n)


def of_accelerations(chain):
    """∂²(λᵀf) by q and q, q and q̇, q̇ and q̇, τ and q, as CasADi differentiates articulated bodies."""
    multiplier = ca.SX.sym("multiplier", chain.n)
    q, qd, tau = chain.q, chain.qd, chain.tau
    value = ca.dot(multiplier, chain.articulated())
    by_q = ca.gradient(value, q)
    parts = [
        ca.hessian(value, q)[0],
        ca.jacobian(by_q, qd),
        ca.hessian(value, qd)[0],
        ca.jacobian(ca.gradient(value, tau), q),
    ]
    return made("second", [q, qd, tau, multiplier], *parts)


def exact(function, arguments):
    """A function's values in forty digits, rounded once."""
    at, results = {}, {}
    two = {ca.OP_ADD: mp.fadd, ca.OP_SUB: mp.fsub, ca.OP_MUL: mp.fmul, ca.OP_DIV: mp.fdiv}
    one = {
        ca.OP_NEG: mp.fneg,
        ca.OP_SQ: lambda x: x * x,
        ca.OP_TWICE: lambda x: x + x,
        ca.OP_INV: lambda x: 1 / x,
        ca.OP_SIN: mp.sin,
        ca.OP_COS: mp.cos,
        ca.OP_ASSIGN: mp.mpf,
    }
    for k in range(function.n_instructions()):
        op = function.instruction_id(k)
        to, of = function.instruction_output(k), function.instruction_input(k)
        if op == ca.OP_CONST:
            at[to[0]] = mp.mpf(function.instruction_constant(k))
        elif op == ca.OP_INPUT:
            at[to[0]] = mp.mpf(arguments[of[0]][of[1]])
        elif op == ca.OP_OUTPUT:
            results[to[1]] = float(at[of[0]])
        else:
            call = (two if op in two else one)[op]
            at[to[0]] = call(*(at[x] for x in of))
    # What is zero by structure is not said.
    return [results.get(k, 0.0) for k in range(function.nnz_out())]


def main():
    for seed, name in enumerate(NAMES):
        arm = Arm(ROOT / "generated/robots" / f"{name}.toml")
        n = arm.n
        draw = np.random.default_rng(0x3264 + seed)
        drawn = [
            [draw.uniform(-x, x, n) for x in (3, 2, 5, 50, 1)] for _ in range(STATES)
        ]
        known = tensors(sys.argv[1], arm, [state[:3] for state in drawn])
        other = of_accelerations(Chain(arm))
        states = []
        for (q, qd, qdd, tau, multiplier), (qq, vv, qv, aq) in zip(drawn, known):
            of = lambda tensor: np.einsum("i,ijk->jk", multiplier, tensor).flatten().tolist()
            state = dict(q=q, qd=qd, qdd=qdd, torque=tau, multiplier=multiplier)
            state = {key: values.tolist() for key, values in state.items()}
            keys = ("dq_dq", "dq_dqd", "dqd_dqd")
            state |= {f"d2tau_{key}": of(x) for key, x in zip((*keys, "dqdd_dq"), (qq, qv, vv, aq))}
            values = exact(other, (q, qd, tau, multiplier))
            for place, key in enumerate((*keys, "dtau_dq")):
                state[f"d2qdd_{key}"] = values[place * n * n : (place + 1) * n * n]
            states.append(state)
        file = {"by": f"Pinocchio {pin.__version__}, CasADi {ca.__version__}", "states": states}
        (HERE / f"{name}.json").write_text(json.dumps(file) + "\n")


main()
