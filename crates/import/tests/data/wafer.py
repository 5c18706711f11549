"""Writes values of the arm wafer.urdf, of which three joints mimic others, by Pinocchio.

    pip install pin numpy
    python crates/import/tests/data/wafer.py

Torques, M, gravity loads and Jacobians are those of its own mimic joints, and are held
against the chain rule on the arm with all joints free: q = S c + o, M_c = Sᵀ M S and so on. What
Pinocchio does not have for mimic joints follows from the free arm by that rule.
"""

import json
from pathlib import Path

import numpy as np
import pinocchio as pin

HERE = Path(__file__).parent
FILE = str(HERE / "wafer.urdf")
AXES = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
# turn, lift, shoulder, tilt
S = np.zeros((7, 4))
S[0, 0] = S[1, 1] = S[3, 2] = S[6, 3] = 1
S[2, 1], S[4, 2], S[5, 2] = 0.75, -2, 1
O = np.array([0, 0, 0.02, 0, 0.1, 0, 0])
B = np.array([0.4, 12, 8, 0.2, 0.1, 0.05, 0.02])
LIMITS = np.array([[-3, 3], [0, 0.4], [-1.4, 1.4], [-1, 1]])


def known(own, free, state):
    c, cd, cdd, tau, wrench = (
        np.array(state[key]) for key in ("q", "qd", "qdd", "torque", "hand_wrench")
    )
    square = state["damping"]
    q, qd, qdd = S @ c + O, S @ cd, S @ cdd
    data = free.createData()
    hand = free.getFrameId("blade")
    pin.computeJointJacobiansTimeVariation(free, data, q, qd)
    pin.framesForwardKinematics(free, data, q)
    j = pin.getFrameJacobian(free, data, hand, AXES) @ S
    rate = pin.getFrameJacobianTimeVariation(free, data, hand, AXES) @ qd
    pose = data.oMf[hand].copy()
    m = pin.crba(free, free.createData(), q)
    m = S.T @ (np.triu(m) + np.triu(m, 1).T) @ S
    torques = lambda rates, growth: S.T @ pin.rnea(free, free.createData(), q, rates, growth)
    gravity = torques(0 * qd, 0 * qd)
    bias = torques(qd, 0 * qd)
    damping = S.T @ (B * qd)

    # Its own mimic joints say the same.
    theirs = own.createData()
    near = lambda a, b: np.testing.assert_allclose(a, b, rtol=0, atol=1e-11 * np.abs(b).max())
    near(pin.rnea(own, theirs, c, cd, cdd), torques(qd, qdd))
    near(pin.rnea(own, own.createData(), c, 0 * cd, 0 * cd), gravity)
    mine = pin.crba(own, own.createData(), c)
    near(np.triu(mine) + np.triu(mine, 1).T, m)
    theirs = own.createData()
    near(pin.computeFrameJacobian(own, theirs, c, own.getFrameId("blade"), AXES), j)

    def derivatives(growth):
        data = free.createData()
        return [by.copy() for by in pin.computeRNEADerivatives(free, data, q, qd, growth)[:2]]

    by_q, by_qd = derivatives(qdd)
    slopes = lambda by, more=0: S.T @ (by + more) @ S
    acceleration = lambda tau: np.linalg.solve(m, tau - bias - damping)
    at = S @ acceleration(tau)
    by_q_at, by_qd_at = derivatives(at)
    mobility = j @ np.linalg.solve(m, j.T)
    damped = mobility + square * np.eye(6)
    inverse = np.linalg.solve(m, np.linalg.solve(damped, j).T)
    coriolis = pin.computeCoriolisMatrix(free, data, q, qd).copy()
    return {
        "tau": torques(qd, qdd) + damping,
        "D": m,
        "h": bias - gravity,
        "c": gravity,
        "kinetic": 0.5 * cd @ m @ cd,
        "pose": np.hstack([pose.rotation, pose.translation[:, None]]),
        "jacobian": j,
        "jacobian_rate_qd": rate,
        "dtau_dq": slopes(by_q),
        "dtau_dqd": slopes(by_qd, np.diag(B)),
        "forward_dynamics": acceleration(tau),
        "inertia_inverse": np.linalg.inv(m),
        "dqdd_dq": -np.linalg.solve(m, slopes(by_q_at)),
        "dqdd_dqd": -np.linalg.solve(m, slopes(by_qd_at, np.diag(B))),
        "momentum_drift": S.T @ (coriolis.T @ qd) - gravity - damping,
        "tau_with_wrench": torques(qd, qdd) + damping - j.T @ wrench,
        "qdd_with_wrench": acceleration(tau + j.T @ wrench),
        "operational_inertia_inverse": mobility,
        "operational_inertia": np.linalg.inv(damped),
        "consistent_inverse": inverse,
        "null_space_projector": np.eye(4) - inverse @ j,
        "operational_bias": np.linalg.solve(damped, j @ np.linalg.solve(m, bias) - rate),
        "contact_wrench": np.linalg.solve(j @ j.T + square * np.eye(6), j @ tau),
    }


def main():
    own, free = pin.buildModelFromUrdf(FILE, True), pin.buildModelFromUrdf(FILE)
    draw = np.random.default_rng(0x776166)
    states = []
    for _ in range(5):
        state = {
            "q": draw.uniform(*LIMITS.T).tolist(),
            "qd": draw.uniform(-2, 2, 4).tolist(),
            "qdd": draw.uniform(-5, 5, 4).tolist(),
            "torque": draw.uniform(-50, 50, 4).tolist(),
            "hand_wrench": draw.uniform(-30, 30, 6).tolist(),
            "damping": draw.uniform(0.01, 0.2),
        }
        values = known(own, free, state)
        states.append(state | {key: np.ravel(value).tolist() for key, value in values.items()})
    made = {"by": f"Pinocchio {pin.__version__}", "states": states}
    (HERE / "wafer.golden.json").write_text(json.dumps(made) + "\n")


main()
