"""Writes the values of outputs at frames, by Pinocchio, into a file a robot beside this one.

    pip install pin numpy
    python codegen/tests/data/frames/make.py

Of Pinocchio are poses, Jacobians and their rates in its three kinds of axes, M, the torques
without accelerations, and those under a wrench. What the operational space makes of these is
solved by numpy from its definition. Joints are built from the DH rows of generated/robots.
"""

import json
import math
import re
import tomllib
from pathlib import Path

import numpy as np
import pinocchio as pin

HERE = Path(__file__).parent
ROBOTS = HERE.parents[3] / "generated" / "robots"
NAMES = ["planar2r", "planar3r", "puma560", "stanford", "ur10", "panda"]
AXES = {
    "": pin.ReferenceFrame.LOCAL_WORLD_ALIGNED,
    ":local": pin.ReferenceFrame.LOCAL,
    ":world": pin.ReferenceFrame.WORLD,
}
STATES = 5


def number(value):
    """A number of a robot file; angles may be multiples of pi."""
    if isinstance(value, str):
        assert re.fullmatch(r"[-+*/0-9. pi]*", value), value
        return float(eval(value, {"pi": math.pi}))
    return float(value)


def turn(axis, angle):
    return pin.SE3(pin.AngleAxis(angle, np.eye(3)[axis]).toRotationMatrix(), np.zeros(3))


def shift(x, y, z):
    return pin.SE3(np.eye(3), np.array([x, y, z]))


def placement(table):
    xyz = [number(x) for x in table.get("xyz", [0, 0, 0])]
    roll, pitch, yaw = (number(x) for x in table.get("rpy", [0, 0, 0]))
    return shift(*xyz) * turn(2, yaw) * turn(1, pitch) * turn(0, roll)


def frames(n):
    """On the last link and on one in the middle, neither along any axis."""
    return [
        {"name": "camera", "link": n, "xyz": [0.03, -0.02, 0.11], "rpy": [0.3, "pi/2", -0.7]},
        {"name": "elbow", "link": (n + 1) // 2, "xyz": [0.1, 0.05, -0.02], "rpy": [0, 0.4, 0]},
    ]


def build(robot, fixed):
    model = pin.Model()
    model.gravity.linear = np.array([number(g) for g in robot["gravity"]])
    parent, before = 0, placement(robot.get("base", {}))
    for index, row in enumerate(robot["joint"]):
        get = lambda key: number(row.get(key, 0))
        slides = row["kind"] == "prismatic"
        theta, d = ("theta", "offset") if slides else ("offset", "d")
        twist = turn(0, get("alpha")), shift(get("a"), 0, 0)
        along = turn(2, get(theta)) * shift(0, 0, get(d))
        if robot["convention"] == "modified":
            before, after = before * twist[0] * twist[1], along
        else:
            after = along * twist[1] * twist[0]
        kind = pin.JointModelPZ() if slides else pin.JointModelRZ()
        parent = model.addJoint(parent, kind, before, f"joint{index}")
        entries = [number(x) for x in np.ravel(row.get("inertia", [0] * 6))]
        xx, yy, zz, xy, yz, xz = entries if len(entries) == 6 else [entries[i] for i in (0, 4, 8, 1, 5, 2)]
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        com = np.array([number(x) for x in row.get("com", [0, 0, 0])])
        model.appendBodyToJoint(parent, pin.Inertia(get("mass"), com, tensor), after)
        for frame in fixed:
            if frame["link"] == index + 1:
                pose = after * placement(frame)
                model.addFrame(pin.Frame(frame["name"], parent, 0, pose, pin.FrameType.OP_FRAME))
        before = after
    tool = before * placement(robot.get("tool", {}))
    model.addFrame(pin.Frame("hand", parent, 0, tool, pin.FrameType.OP_FRAME))
    return model


def value(model, robot, state):
    """What is known at a state."""
    n = model.nv
    damping = np.array([number(row.get("viscous", 0)) for row in robot["joint"]])
    armature = np.diag([number(row.get("armature", 0)) for row in robot["joint"]])
    q, qd, qdd, tau, wrench = (
        np.array(state[key]) for key in ("q", "qd", "qdd", "torque", "hand_wrench")
    )
    square = state["damping"]
    data = model.createData()
    pin.computeJointJacobiansTimeVariation(model, data, q, qd)
    pin.framesForwardKinematics(model, data, q)
    m = pin.crba(model, model.createData(), q)
    m = np.triu(m) + np.triu(m, 1).T + armature
    bias = pin.rnea(model, model.createData(), q, qd, np.zeros(n))
    drift = bias + damping * qd
    known = {}
    for frame in ("hand", "camera", "elbow"):
        index = model.getFrameId(frame)
        pose = data.oMf[index]
        known[f"pose@{frame}"] = np.hstack([pose.rotation, pose.translation[:, None]])
        for word, axes in AXES.items():
            at = f"@{frame}{word}"
            j = pin.getFrameJacobian(model, data, index, axes)
            rate = pin.getFrameJacobianTimeVariation(model, data, index, axes) @ qd
            known[f"jacobian{at}"] = j
            known[f"jacobian_rate_qd{at}"] = rate
            known[f"tau_with_wrench{at}"] = m @ qdd + drift - j.T @ wrench
            known[f"qdd_with_wrench{at}"] = np.linalg.solve(m, tau + j.T @ wrench - drift)
        for at, rows, axes in ((f"@{frame}", range(6), ""), (f"@{frame}:local:linear", range(3), ":local")):
            j = known[f"jacobian@{frame}{axes}"][rows, :]
            rate = known[f"jacobian_rate_qd@{frame}{axes}"][rows]
            mobility = j @ np.linalg.solve(m, j.T)
            damped = mobility + square * np.eye(len(j))
            inverse = np.linalg.solve(m, np.linalg.solve(damped, j).T)
            known[f"operational_inertia_inverse{at}"] = mobility
            known[f"operational_inertia{at}"] = np.linalg.inv(damped)
            known[f"consistent_inverse{at}"] = inverse
            known[f"null_space_projector{at}"] = np.eye(n) - inverse @ j
            rest = j @ np.linalg.solve(m, bias) - rate
            known[f"operational_bias{at}"] = np.linalg.solve(damped, rest)
            squared = j @ j.T + square * np.eye(len(j))
            known[f"contact_wrench{at}"] = np.linalg.solve(squared, j @ tau)
    # C is that of Pinocchio, whose Cᵀq̇ is ∂T/∂q.
    c = pin.computeCoriolisMatrix(model, model.createData(), q, qd)
    gravity = pin.computeGeneralizedGravity(model, model.createData(), q)
    known["momentum_drift"] = c.T @ qd - gravity - damping * qd
    return {key: np.ravel(entry).tolist() for key, entry in known.items()}


def main():
    for seed, name in enumerate(NAMES):
        robot = tomllib.loads((ROBOTS / f"{name}.toml").read_text())
        n = len(robot["joint"])
        fixed = frames(n)
        model = build(robot, fixed)
        draw = np.random.default_rng(0x6672 + seed)
        states = []
        for _ in range(STATES):
            state = {
                "q": draw.uniform(-3, 3, n).tolist(),
                "qd": draw.uniform(-2, 2, n).tolist(),
                "qdd": draw.uniform(-5, 5, n).tolist(),
                "torque": draw.uniform(-50, 50, n).tolist(),
                "hand_wrench": draw.uniform(-30, 30, 6).tolist(),
                "damping": draw.uniform(0.01, 0.2),
            }
            states.append(state | value(model, robot, state))
        made = {"by": f"Pinocchio {pin.__version__}", "frames": fixed, "states": states}
        (HERE / f"{name}.json").write_text(json.dumps(made) + "\n")


main()
