"""Writes poses, steps and velocities of a base that floats, by Pinocchio.

    pip install pin numpy
    python crates/pose/tests/data/values.py > crates/pose/tests/data/values.json
"""

import json

import numpy as np
import pinocchio as pin

rng = np.random.default_rng(7)
model = pin.Model()
model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "base")


def unit(size):
    vector = rng.normal(size=size)
    return vector / np.linalg.norm(vector)


rows = []
for angle in [0, 1e-12, 1e-8, 1e-4, 1e-2, 0.3, 1.0, 2.0, 3.0, 3.14159] * 4:
    pose = np.r_[rng.normal(size=3), unit(4)]
    step = np.r_[rng.normal(size=3), angle * unit(3)]
    to = pin.integrate(model, pose, step)
    velocity, acceleration = rng.normal(size=6), rng.normal(size=6)
    data = model.createData()
    pin.forwardKinematics(model, data, pose, velocity, acceleration)
    row = {
        "position": pose[:3],
        "xyzw": pose[3:],
        "step": step,
        "to": to,
        "difference": pin.difference(model, pose, to),
        "velocity": velocity,
        "acceleration": acceleration,
        "gravity": data.oMi[1].rotation.T @ [0, 0, -9.81],
    }
    for name, axes, rate in [
        ("mixed", pin.LOCAL_WORLD_ALIGNED, pin.getClassicalAcceleration),
        ("world", pin.WORLD, pin.getAcceleration),
    ]:
        row[name + "_velocity"] = pin.getVelocity(model, data, 1, axes).vector
        row[name + "_acceleration"] = rate(model, data, 1, axes).vector
    rows.append(json.dumps({key: list(value) for key, value in row.items()}))
print("[\n" + ",\n".join(rows) + "\n]")
