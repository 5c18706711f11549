"""Writes NAME.golden.json of every model here that has a NAME.json, by MuJoCo.

    pip install mujoco
    python golden.py [FOLDER]

NAME.json says the tip, a body or a site, and the chain's joints; every other joint is
held at 0 or its nearest limit, unless "held" says where. The torques are those of
mj_inverse without what MuJoCo adds to the arm itself: friction, damping, springs and
limits are off.
"""

import json
import pathlib
import random
import sys

import mujoco
import numpy

STATES = 10


def state(model, data, chosen, held, draw):
    """A state of the chain, all else held."""
    data.qpos[:] = held
    data.qvel[:] = 0
    data.qacc[:] = 0
    q, qd, qdd = [], [], []
    for joint in chosen:
        low, high = model.jnt_range[joint] if model.jnt_limited[joint] else (-3, 3)
        q.append(draw.uniform(low, high))
        qd.append(draw.uniform(-2, 2))
        qdd.append(draw.uniform(-5, 5))
        data.qpos[model.jnt_qposadr[joint]] = q[-1]
        data.qvel[model.jnt_dofadr[joint]] = qd[-1]
        data.qacc[model.jnt_dofadr[joint]] = qdd[-1]
    return q, qd, qdd


def pose(data, model, tip):
    """Rows of [R | p] of a body or a site."""
    body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, tip)
    if body >= 0:
        turn, at = data.xmat[body], data.xpos[body]
    else:
        site = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, tip)
        assert site >= 0, tip
        turn, at = data.site_xmat[site], data.site_xpos[site]
    return numpy.hstack([turn.reshape(3, 3), at.reshape(3, 1)]).tolist()


def golden(path, wanted):
    """Torques, gravity loads, inertia matrices and poses of a model."""
    model = mujoco.MjModel.from_xml_path(str(path))
    off = mujoco.mjtDisableBit
    for bit in (off.mjDSBL_CONSTRAINT, off.mjDSBL_ACTUATION):
        model.opt.disableflags |= int(bit)
    model.dof_damping[:] = 0
    model.jnt_stiffness[:] = 0
    model.body_gravcomp[:] = 0
    data = mujoco.MjData(model)
    held = numpy.array(model.qpos0)
    for joint in range(model.njnt):
        if model.jnt_type[joint] in (2, 3):
            at = 0.0
            if model.jnt_limited[joint]:
                at = float(numpy.clip(at, *model.jnt_range[joint]))
            held[model.jnt_qposadr[joint]] = at
    for name, at in wanted.get("held", {}).items():
        joint = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)
        held[model.jnt_qposadr[joint]] = at
    names = wanted["joints"]
    chosen = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, n) for n in names]
    assert -1 not in chosen, names
    dofs = [model.jnt_dofadr[joint] for joint in chosen]
    draw = random.Random(1)
    states = []
    for _ in range(STATES):
        q, qd, qdd = state(model, data, chosen, held, draw)
        mujoco.mj_inverse(model, data)
        tau = data.qfrc_inverse[dofs].tolist()
        tip = pose(data, model, wanted["tip"])
        full = numpy.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, full)
        data.qvel[:] = 0
        data.qacc[:] = 0
        mujoco.mj_inverse(model, data)
        states.append(
            {
                "q": q,
                "qd": qd,
                "qdd": qdd,
                "tau": tau,
                "gravity": data.qfrc_inverse[dofs].tolist(),
                "inertia": full[numpy.ix_(dofs, dofs)].tolist(),
                "tip_pose": tip,
            }
        )
    return {
        "mujoco": mujoco.__version__,
        "tip": wanted["tip"],
        "joints": names,
        "states": states,
    }


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__)
    folder = folder if folder.is_dir() else folder.parent
    for wanted in sorted(folder.glob("*.json")):
        name = wanted.name.removesuffix(".json")
        if name.endswith(".golden"):
            continue
        found = golden(folder / f"{name}.xml", json.loads(wanted.read_text()))
        (folder / f"{name}.golden.json").write_text(json.dumps(found) + "\n")
        print(name)


if __name__ == "__main__":
    main()
