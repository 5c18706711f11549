"""Writes second derivatives of the torques and accelerations of robots, by Pinocchio, into a
file a robot beside this one. `pinocchio.cpp` has what Pinocchio's Python lacks:

    pip install pin==4.1.0 numpy
    P=$(python -c "import cmeel, pathlib; print(pathlib.Path(cmeel.__path__[0]).parent / 'cmeel.prefix')")
    g++ -O1 -w -std=c++17 -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS -DBOOST_MPL_LIMIT_LIST_SIZE=30 \\
        -DBOOST_FUSION_INVOKE_MAX_ARITY=10 -I$P/include -I/usr/include/eigen3 pinocchio.cpp \\
        -o second -L$P/lib -lpinocchio_default -Wl,-rpath,$P/lib
    python make.py ./second

Those of the torques are Pinocchio's tensors times λ. Those of the accelerations follow, by
numpy: f(q, q̇, τ) solves τ(q, q̇, f) = τ, which is differentiated twice, all n³ numbers of it.
"""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pinocchio as pin

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[3]
sys.path.insert(0, str(ROOT / "benches/peers"))
from model import Arm  # noqa: E402

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


def of_accelerations(second, slopes, inverse):
    """∂²f by q and q, q and q̇, q̇ and q̇, τ and q from those of τ at q̈ = f."""
    qq, vv, qv, aq = second
    by_q, by_v = (-inverse @ slope for slope in slopes)
    # Of τ_i by q_j along f: ∂D_ia/∂q_j ∂f_a/∂x_k.
    along = lambda other: np.einsum("iaj,ak->ijk", aq, other)
    both = along(by_q) + along(by_q).transpose(0, 2, 1)
    lead = lambda tensor: -np.einsum("mi,ijk->mjk", inverse, tensor)
    # By τ_j and q_k, from that by q_k and τ_j.
    driven = lead(along(inverse)).transpose(0, 2, 1)
    return lead(qq + both), lead(qv + along(by_v)), lead(vv), driven


def main():
    for seed, name in enumerate(NAMES):
        arm = Arm(ROOT / "generated/robots" / f"{name}.toml")
        model, n = arm.pinocchio(), arm.n
        draw = np.random.default_rng(0x3264 + seed)
        drawn = [
            [draw.uniform(-x, x, n) for x in (3, 2, 5, 50, 1)] for _ in range(STATES)
        ]
        damping = np.array(arm.viscous)
        given, moving = [], []
        for q, qd, qdd, tau, _ in drawn:
            m = pin.crba(model, model.createData(), q)
            m = np.triu(m) + np.triu(m, 1).T + np.diag(arm.armature)
            load = tau - damping * qd - pin.rnea(model, model.createData(), q, qd, np.zeros(n))
            f = np.linalg.solve(m, load)
            data = model.createData()
            by_q, by_v, _ = pin.computeRNEADerivatives(model, data, q, qd, f)
            given += [(q, qd, qdd), (q, qd, f)]
            moving.append((by_q.copy(), by_v + np.diag(damping), np.linalg.inv(m)))
        known = list(tensors(sys.argv[1], arm, given))
        states = []
        for k, (q, qd, qdd, tau, multiplier) in enumerate(drawn):
            of = lambda tensor: np.einsum("i,ijk->jk", multiplier, tensor).flatten().tolist()
            qq, vv, qv, aq = known[2 * k]
            by_q, by_v, inverse = moving[k]
            other = of_accelerations(known[2 * k + 1], (by_q, by_v), inverse)
            keys = ("dq_dq", "dq_dqd", "dqd_dqd")
            state = dict(q=q, qd=qd, qdd=qdd, torque=tau, multiplier=multiplier)
            state = {key: values.tolist() for key, values in state.items()}
            state |= {f"d2tau_{key}": of(x) for key, x in zip(keys, (qq, qv, vv))}
            state |= {f"d2qdd_{key}": of(x) for key, x in zip(keys, other)}
            state["d2tau_dqdd_dq"] = of(aq)
            state["d2qdd_dtau_dq"] = of(other[3])
            states.append(state)
        made = {"by": f"Pinocchio {pin.__version__}", "states": states}
        (HERE / f"{name}.json").write_text(json.dumps(made) + "\n")


main()
