"""Writes values of a robot whose base floats, by Pinocchio.

    pip install pin numpy
    python crates/model/tests/data/golden/two_legs.py

The base is where the world is, so that its axes are the world's, and gravity in them is an argument. Velocities and
accelerations are linear over angular of the base in its own axes, then of the joints; the acceleration is the rate of
the velocity. Friction and armature are in the torques, accelerations and slopes.
"""

import json
import tomllib
from math import pi
from pathlib import Path

import numpy as np
import pinocchio as pin

HERE = Path(__file__).parent


def number(x):
    return eval(x, {"pi": pi}) if isinstance(x, str) else x


def placed(at):
    rpy = [number(x) for x in at.get("rpy", [0, 0, 0])]
    return pin.SE3(pin.rpy.rpyToMatrix(*rpy), np.array([number(x) for x in at.get("xyz", [0, 0, 0])]))


def body(joint):
    xx, yy, zz, xy, yz, xz = joint["inertia"]
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return pin.Inertia(joint["mass"], np.array(joint["com"]), tensor)


robot = tomllib.loads((HERE / "../two_legs.toml").read_text())
model, ids = pin.Model(), {}
viscous, armature = np.zeros(6), np.zeros(6)
for k, joint in enumerate(robot["joint"]):
    name = joint["name"]
    if joint["kind"] == "floating":
        ids[name] = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), name)
    else:
        axis = np.array(joint["axis"]) / np.linalg.norm(joint["axis"])
        kind = pin.JointModelRevoluteUnaligned if joint["kind"] == "revolute" else pin.JointModelPrismaticUnaligned
        parent = ids[joint.get("parent", robot["joint"][k - 1]["name"])]
        ids[name] = model.addJoint(parent, kind(axis), placed(joint["placement"]), name)
        viscous = np.append(viscous, joint.get("viscous", 0))
        armature = np.append(armature, joint.get("armature", 0))
    model.appendBodyToJoint(ids[name], body(joint), pin.SE3.Identity())
for frame in robot["frame"]:
    parent = ids[frame["link"]]
    model.addFrame(pin.Frame(frame["name"], parent, 0, placed(frame), pin.FrameType.OP_FRAME))
model.armature = armature
data = model.createData()
foot = model.getFrameId("left_foot")
aligned = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED

random, states = np.random.default_rng(71), []
for _ in range(6):
    joints = random.uniform(-1.5, 1.5, model.nv - 6)
    v, a, effort = (random.uniform(-3, 3, model.nv) for _ in range(3))
    g = random.uniform(-9, 9, 3)
    model.gravity.linear = g
    q = np.concatenate([np.zeros(6), [1], joints])
    tau = pin.rnea(model, data, q, v, a) + viscous * v
    gravity = pin.computeGeneralizedGravity(model, data, q)
    bias = pin.nonLinearEffects(model, data, q, v) - gravity
    dq, dv, D = (np.array(x) for x in pin.computeRNEADerivatives(model, data, q, v, a))
    D = np.triu(D) + np.triu(D, 1).T
    qdd = pin.aba(model, data, q, v, effort - viscous * v)
    C = np.array(pin.computeCoriolisMatrix(model, data, q, v))
    kinetic = pin.computeKineticEnergy(model, data, q, v) + 0.5 * armature @ v**2
    pin.forwardKinematics(model, data, q, v, np.zeros(model.nv))
    pin.updateFramePlacements(model, data)
    drift = pin.getFrameClassicalAcceleration(model, data, foot, aligned).vector
    pin.computeJointJacobians(model, data, q)
    J = pin.getFrameJacobian(model, data, foot, aligned)
    pose = data.oMf[foot]
    points = [foot, model.getFrameId("right_foot")]
    held = np.vstack([pin.getFrameJacobian(model, data, point, aligned)[:3] for point in points])
    escape = np.hstack([pin.getFrameClassicalAcceleration(model, data, point, aligned).linear for point in points])
    com = pin.centerOfMass(model, data, q)
    A = np.array(pin.ccrba(model, data, q, v))
    pin.dccrba(model, data, q, v)
    rate = data.dAg @ v
    free = np.linalg.solve(D[:6, :6], -(bias + gravity + D @ np.concatenate([np.zeros(6), a[6:]]))[:6])
    tau_free = pin.rnea(model, data, q, v, np.concatenate([free, a[6:]])) + viscous * v
    tau_free[:6] = 0
    state = {"q": joints, "qd": v, "qdd": a, "g": g, "effort": effort, "tau": tau, "gravity": gravity, "bias": bias}
    state |= {"inertia": D, "accelerations": qdd, "dtau_dq": dq, "dtau_dqd": dv + np.diag(viscous), "coriolis": C}
    state |= {"kinetic": np.array([kinetic]), "jacobian": J, "drift": drift}
    state |= {"frame": np.hstack([pose.rotation, pose.translation[:, None]])}
    state |= {"com": com, "centroidal": A, "centroidal_bias": rate, "base_free": free, "tau_free": tau_free}
    pin.computeAllTerms(model, data, q, v)
    qdd_held = pin.forwardDynamics(model, data, q, v, effort - viscous * v, held, escape, 0.01)
    state |= {"contact_jacobians": held, "contact_bias": escape, "qdd_held": qdd_held, "forces": data.lambda_c}
    states.append({key: np.ravel(value).tolist() for key, value in state.items()})
rows = json.dumps({"states": states}).replace('{"q"', '\n{"q"')
(HERE / "two_legs.json").write_text(rows + "\n")
