"""Writes values of robots whose links branch, with joints that follow others, by Pinocchio.

    pip install pin numpy
    python crates/import/tests/data/trees.py

All joints are free in Pinocchio's model; what follows is put together by the chain rule, q = S c + o: torques are
Sᵀ τ(S c + o, S ċ, S c̈), and D is Sᵀ D S. Friction is in the torques. Joints are in the order of the names given.
"""

import json
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pinocchio as pin

HERE = Path(__file__).parent


def put_on(arm, link):
    """Returns an arm with the gripper on a link."""
    text = (HERE / "gripper.urdf").read_text()
    inside = text[text.index("<link") : text.rindex("</robot>")]
    mount = f'<joint name="mount" type="fixed"><parent link="{link}"/><child link="gripper_base"/></joint>'
    return arm.replace("</robot>", inside + mount + "</robot>")


ROBOTS = {
    "baxter": (HERE / "../../../../gallery/urdf/baxter.urdf").read_text(),
    "panda": (HERE / "panda.urdf").read_text(),
    "ur5_gripper": put_on((HERE / "ur5.urdf").read_text(), "tool0"),
}
FRAMES = {"baxter": "left_gripper", "panda": "panda_leftfinger", "ur5_gripper": "right_finger_tip"}


def values(name, text):
    model = pin.buildModelFromXML(text)
    data = model.createData()
    joints = {joint.get("name"): joint for joint in ET.fromstring(text).findall("joint")}
    ids = list(range(1, model.njoints))
    names = [model.names[i] for i in ids]
    places = [model.joints[i].idx_v for i in ids]
    mimic = [joints[name].find("mimic") for name in names]
    free = [k for k, follows in enumerate(mimic) if follows is None]
    S, o = np.zeros((len(ids), len(free))), np.zeros(len(ids))
    for k, follows in enumerate(mimic):
        leader = k if follows is None else names.index(follows.get("joint"))
        S[k, free.index(leader)] = 1 if follows is None else float(follows.get("multiplier", 1))
        o[k] = 0 if follows is None else float(follows.get("offset", 0))
    damping = [joints[name].find("dynamics") for name in names]
    B = np.array([0 if d is None else float(d.get("damping", 0)) for d in damping])

    def whole(values):
        out = np.zeros(model.nv)
        out[places] = values
        return out

    random, states = np.random.default_rng(70), []
    for _ in range(6):
        c, cd, cdd = (random.uniform(-1.5, 1.5, len(free)) for _ in range(3))
        q, v, a = S @ c + o, S @ cd, S @ cdd
        tau = pin.rnea(model, data, whole(q), whole(v), whole(a))[places] + B * v
        D = pin.crba(model, data, whole(q))
        D = (np.triu(D) + np.triu(D, 1).T)[np.ix_(places, places)]
        gravity = pin.computeGeneralizedGravity(model, data, whole(q))[places]
        pin.framesForwardKinematics(model, data, whole(q))
        pose = data.oMf[model.getFrameId(FRAMES[name])]
        rows = np.hstack([pose.rotation, pose.translation[:, None]])
        given = {"q": c, "qd": cd, "qdd": cdd, "tau": S.T @ tau, "gravity": S.T @ gravity}
        given |= {"inertia": (S.T @ D @ S).ravel(), "frame": rows.ravel()}
        states.append({key: value.tolist() for key, value in given.items()})
    return {"joints": [names[k] for k in free], "frame": FRAMES[name], "states": states}


found = {name: values(name, text) for name, text in ROBOTS.items()}
rows = json.dumps(found).replace('{"q"', '\n{"q"')
(HERE / "trees.golden.json").write_text(rows + "\n")
