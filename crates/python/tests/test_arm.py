"""Arms: how they are loaded, and what they know."""

import copy
import ctypes
import json
import multiprocessing
import os
import pickle
import pydoc
import re
import shutil
import subprocess
import sys
import warnings
from xml.etree import ElementTree

import numpy as np
import pytest
from conftest import ROBOTS, ROOT, data, robot, urdf
from numpy.testing import assert_allclose, assert_array_equal

import dalembert
from dalembert._progress import Note


@pytest.mark.parametrize("name", ROBOTS)
def test_golden_values(name):
    """Torques, D, h and c of an independent library."""
    arm = dalembert.load(
        robot(name), outputs=["inverse_dynamics", "inertia", "coriolis", "gravity"]
    )
    given = data("golden", name)["states"]
    q, qd, qdd, tau, h, c, d = (
        np.array([state[key] for state in given]) for key in ("q", "qd", "qdd", "tau", "h", "c", "D")
    )
    close = {"rtol": 0, "atol": 1e-12}
    for found, expected in [
        (arm.inverse_dynamics(q, qd, qdd), tau),
        (arm.coriolis(q, qd), h),
        (arm.gravity(q), c),
        (arm.inertia(q), d.reshape(len(q), *arm.inertia(q[0]).shape)),
    ]:
        scale = np.abs(expected).max() or 1
        assert_allclose(found / scale, expected / scale, **close)


@pytest.mark.parametrize("name", ["planar2r", "planar3r", "stanford"])
def test_values_of_other_outputs(name):
    """Every other output that an independent library has."""
    functions = set(dalembert.outputs()) - {"joint_torques_free", "inertia_blocks"}
    arm = dalembert.load(robot(name), outputs=sorted(functions))
    assert set(arm.functions) == functions
    states = data("outputs", name)["states"]
    n = len(arm.joints)

    def given(key):
        return np.array([state[key] for state in states])

    q, qd, qdd, torque = (given(key) for key in ("q", "qd", "qdd", "torque"))
    inverse = 100 * 2.0**-53 * given("condition").max()
    by_tau = arm.forward_dynamics_derivatives(q, qd, torque)
    of_tau = arm.inverse_dynamics_derivatives(q, qd, qdd)
    for found, key, close in [
        (arm.forward_dynamics(q, qd, torque), "forward_dynamics", inverse),
        (arm.inertia_inverse(q), "inertia_inverse", inverse),
        (by_tau.dqdd_dq, "dqdd_dq", inverse),
        (by_tau.dqdd_dqd, "dqdd_dqd", inverse),
        (by_tau.dqdd_dtau, "inertia_inverse", inverse),
        (of_tau.dtau_dq, "dtau_dq", 1e-12),
        (of_tau.dtau_dqd, "dtau_dqd", 1e-12),
        (arm.forward_kinematics(q), "pose", 1e-12),
        (arm.jacobian(q), "jacobian", 1e-12),
        (arm.jacobian_rate(q, qd), "jacobian_rate_qd", 1e-12),
        (arm.kinetic_energy(q, qd), "kinetic", 1e-12),
        (arm.potential_energy(q), "potential", 1e-12),
        (arm.reaction_wrenches(q, qd, qdd), "wrench", 1e-12),
        (arm.full_regressor(q, qd, qdd), "regressor", 1e-12),
    ]:
        expected = given(key).reshape(found.shape)
        scale = np.abs(expected).max() or 1
        assert_allclose(found / scale, expected / scale, rtol=0, atol=close, err_msg=key)
    # What follows from these.
    tau, c = arm.inverse_dynamics(q, qd, qdd), arm.gravity(q)
    d, h, gravity = arm.manipulator_equation(q, qd)
    assert_allclose(gravity, c, atol=1e-12 * (np.abs(c).max() or 1))
    p, ct_qd = arm.momentum(q, qd)
    rate = np.einsum("kij,kj->ki", arm.coriolis_matrix(q, qd), qd)
    terms = arm.dalembert_terms(q, qd)
    coefficients = arm.dynamic_coefficients(q)
    for left, right in [
        (p, np.einsum("kij,kj->ki", d, qd)),
        (rate, h),
        (ct_qd, np.einsum("kij,ki->kj", arm.coriolis_matrix(q, qd), qd)),
        (terms.d_rot + terms.d_tran, d),
        (terms.h_rot + terms.h_tran, h),
        (np.einsum("kijl,kj,kl->ki", coefficients.h, qd, qd), h),
        (arm.passivity(q, qd, qd, qdd), tau),
        (arm.passivity_regressor(q, qd, qd, qdd), arm.regressor(q, qd, qdd)),
        (arm.link_poses(q)[:, -1], arm.forward_kinematics(q)),
    ]:
        scale = np.abs(right).max() or 1
        assert_allclose(left / scale, right / scale, rtol=0, atol=1e-12)
    base = np.linalg.lstsq(arm.regressor(q, qd, qdd).reshape(len(q) * n, -1), tau.ravel())[0]
    assert_allclose(arm.regressor(q, qd, qdd) @ base, tau, atol=1e-9 * np.abs(tau).max())


def test_what_an_arm_knows(planar):
    assert planar.name == "planar3r"
    assert [joint.kind for joint in planar.joints] == ["revolute"] * 3
    assert planar.frames == ("hand",)
    assert planar.limits.lower.shape == (3,)
    assert planar.counts["gravity"]["mul"] > 0
    assert "random points" in planar.proof["inverse_dynamics"]
    assert "tolerated" not in planar.claim["functions"][0]
    assert "inverse_dynamics" in dir(planar) and "planar3r" in repr(planar)
    assert repr(planar.gravity) == "gravity(q) -> c (3,)"
    html = planar._repr_html_()
    assert "<svg" in html and "inverse_dynamics" in html
    with pytest.raises(AttributeError, match="loaded without 'coriolis'"):
        planar.coriolis
    with pytest.raises(AttributeError, match="no 'colour'$"):
        planar.colour
    with pytest.raises(AttributeError, match="did you mean `inverse_dynamics`?"):
        planar.inverse_dynamic


def test_urdf_and_locks(tmp_path):
    options = {"outputs": "gravity", "cache": tmp_path}
    options |= {"tip": "gripper_frame_link"}
    arm = dalembert.load(urdf("so101"), lock={"gripper": 0}, **options)
    n = len(arm.joints)
    last = arm.joints[-1].name
    assert (n, last) == (5, "wrist_roll")
    shorter = dalembert.load(urdf("so101"), lock={last: 0.1, "gripper": 0}, **options)
    assert len(shorter.joints) == n - 1
    q = np.linspace(0.1, 0.3, n)
    q[-1] = 0.1
    assert_allclose(shorter.gravity(q[:-1]), arm.gravity(q)[:-1], atol=1e-12)
    again = dalembert.load(urdf("so101"), lock={"gripper": 0}, **options)
    assert again.is_from_cache
    every = dalembert.load(urdf("so101"), lock="*", **options)
    assert_array_equal(every.gravity(q), arm.gravity(q))
    # Messages speak of keywords, as a caller writes them.
    with pytest.raises(ValueError, match='lock={"gripper": ') as error:
        dalembert.load(urdf("so101"), **options)
    assert not re.search(r"--\w", str(error.value)) and 'lock="*"' in str(error.value)
    with pytest.raises(ValueError, match='lock={"gripper": 9}: the joint'):
        dalembert.load(urdf("so101"), lock={"gripper": 9}, **options)
    with pytest.raises(ValueError, match="tip=: there is no link `nowhere`"):
        dalembert.load(urdf("so101"), **{**options, "tip": "nowhere"})
    # A number counts the joints that move from the root outwards, whatever their order in the file.
    numbered = dalembert.load(urdf("so101"), lock={n + 1: 0}, **options)
    assert numbered.joints == arm.joints
    assert_array_equal(numbered.gravity(q), arm.gravity(q))
    with pytest.raises(ValueError, match="there is no joint `9`(.|\\n)*1 to 6, from the root"):
        dalembert.load(urdf("so101"), lock={9: 0}, **options)
    with pytest.raises(ValueError, match="expected ... or a dictionary"):
        dalembert.load(urdf("so101"), lock="all")


def test_what_else_import_takes(tmp_path):
    options = {"outputs": "gravity", "cache": tmp_path, "lock": "*"}
    arm = dalembert.load(urdf("so101"), name="little", acceleration=12.5, **options)
    assert arm.name == "little"
    assert_array_equal(arm.limits.acceleration, np.full(len(arm.joints), 12.5))
    assert np.isinf(dalembert.load(urdf("so101"), **options).limits.acceleration).all()
    for wrong in (0, -1, float("inf"), "much"):
        with pytest.raises(ValueError, match="acceleration: expected a number above zero"):
            dalembert.load(urdf("so101"), acceleration=wrong, **options)
    with pytest.raises(ValueError, match="name: expected .* such as small_arm"):
        dalembert.load(urdf("so101"), name="Small arm", **options)
    with pytest.raises(ValueError, match="exact, snap"):
        dalembert.load(urdf("so101"), exact=True, snap=True, **options)
    gen3 = ROOT / "gallery" / "urdf" / "gen3.urdf"
    said = "\n".join(dalembert.load(gen3, **options).notes)
    assert "snap= takes the exact ones" in said, said
    snapped = dalembert.load(gen3, snap=True, **options)
    assert "is taken for pi/2" in "\n".join(snapped.notes)
    tied = tmp_path / "tied.xml"
    body = "<inertial pos='0 0 0.1' mass='1' diaginertia='1 1 1'/><joint name='{0}' axis='{1}'/>"
    one, two = body.format("turn", "0 0 1"), body.format("bend", "0 1 0")
    tied.write_text(
        f"<mujoco><worldbody><body name='upper'>{one}<body name='lower' pos='1 0 0'>{two}</body>"
        "</body></worldbody><equality><weld body1='lower'/></equality></mujoco>"
    )
    with pytest.raises(ValueError, match="ignore_ties="):
        dalembert.load(tied, **options)
    dalembert.load(tied, ignore_ties=True, **options)


def test_a_dictionary(planar):
    pendulum = {
        "name": "pendulum",
        "convention": "standard",
        "gravity": [0, -9.81, 0],
        "joint": [
            {"kind": "revolute", "a": 1, "mass": 2, "com": np.array([-0.5, 0, 0]),
             "inertia": [0, 0.1, 0.1, 0, 0, 0]},
        ],
    }
    arm = dalembert.load(pendulum, outputs="gravity")
    assert_allclose(arm.gravity([0.3]), [2 * 9.81 * 0.5 * np.cos(0.3)], rtol=1e-14)
    joint = pendulum["joint"][0] | {"a": np.float32(1), "mass": np.float64(2), "d": np.int64(0)}
    same = dalembert.load({**pendulum, "joint": [joint]}, outputs="gravity")
    assert_array_equal(same.gravity([0.3]), arm.gravity([0.3]))
    with pytest.raises(ValueError, match="mass"):
        dalembert.load({**pendulum, "joint": [{"kind": "revolute", "mass": -1}]})
    with pytest.raises(TypeError, match="joint.com"):
        dalembert.load({"joint": [{"com": object()}]})


def test_parameters_are_arguments():
    arm = dalembert.load(
        robot("planar2r"), outputs="gravity", parameters=["payload", "gravity"]
    )
    assert arm.gravity.arguments == ["q", "g", "load"]
    none = arm.load(np.zeros(10))
    carried = arm.load([1.5, 0.1, 0, 0, 0, 0, 0, 0, 0, 0])
    q, g = [0.3, 0.2], [0, -9.81, 0]
    fixed = dalembert.load(robot("planar2r"), outputs="gravity")
    assert_allclose(arm.gravity(q, g, none), fixed.gravity(q), atol=1e-12)
    assert np.abs(arm.gravity(q, g, carried) - fixed.gravity(q)).max() > 1
    # Of many payloads there are many loads.
    both = arm.load([np.zeros(10), [1.5, 0.1, 0, 0, 0, 0, 0, 0, 0, 0]])
    assert_array_equal(arm.gravity(q, g, both)[1], arm.gravity(q, g, carried))
    again = pickle.loads(pickle.dumps(carried))
    assert_array_equal(arm.gravity(q, g, again), arm.gravity(q, g, carried))


def test_a_payload_is_a_body_and_no_load():
    arm = dalembert.load(robot("planar2r"), outputs="gravity", parameters="payload")
    payload, q = np.array([1.5, 0.1, 0, 0, 0, 0.1, 0.1, 0, 0, 0]), [0.3, 0.2]
    load = arm.load(payload)
    assert isinstance(load, dalembert.Load) and load.numbers.ndim == 1
    for passed in (payload, load.numbers, load.numbers.tolist()):
        with pytest.raises(TypeError, match=r"expected what `arm.load` returns"):
            arm.gravity(q, passed)
        with pytest.raises(TypeError, match="`load` is"):
            arm.gravity(q, load=passed)
    with pytest.raises(TypeError, match="payload"):
        arm.load(load)
    for place, value, words in [
        (0, -1, "the mass is -1"),
        (0, 0, "the mass is zero"),
        (0, np.nan, "finite"),
        (2, np.inf, "finite"),
        (4, -0.1, "a principal moment is negative"),
        (6, 0.3, "exceeds the sum of the other two"),
        (7, 0.2, "no body has this inertia"),
    ]:
        wrong = payload.copy()
        wrong[place] = value
        with pytest.raises(ValueError, match=words):
            arm.load(wrong)
        with pytest.raises(ValueError, match=f"at state 1.*{words}"):
            arm.load([payload, wrong])
    # A plate whose moments are rounded.
    arm.load([1, 0, 0, 0, 0.1, 0.2, 0.3000001, 0, 0, 0])


def test_bodies_are_arguments():
    """Against robot files with other numbers, and against a batch of one load a state."""
    pendulum = {
        "name": "pendulum",
        "convention": "standard",
        "gravity": [0, -9.81, 0],
        "joint": [
            {"kind": "revolute", "a": 0.5, "mass": 2, "com": [-0.25, 0, 0], "inertia": [0.01, 0.05, 0.05, 0, 0, 0]},
            {"kind": "revolute", "a": 0.4, "mass": 1, "com": [-0.2, 0.1, 0], "inertia": [0.01, 0.03, 0.03, 0, 0, 0]},
        ],
    }
    outputs = ["inverse_dynamics", "inertia"]
    arm = dalembert.load(pendulum, outputs=outputs, parameters=["bodies", "armature"])
    assert arm.body_links == (1, 2) and arm.bodies.shape == (2, 10)
    assert_array_equal(arm.bodies[1], [1, -0.2, 0.1, 0, 0.01, 0.03, 0.03, 0, 0, 0])
    state = ([0.3, 0.2], [0.5, -0.4], [1.0, 2.0])
    own = dalembert.load(pendulum, outputs=outputs)
    assert_allclose(arm.with_bodies().inverse_dynamics(*state), own.inverse_dynamics(*state), rtol=1e-13)

    def changed(masses, armature):
        joints = []
        for joint, mass, rotor in zip(pendulum["joint"], masses, armature):
            inertia = [x * mass / joint["mass"] for x in joint["inertia"]]
            joints.append({**joint, "mass": mass, "inertia": inertia, "armature": rotor})
        return dalembert.load({**pendulum, "joint": joints}, outputs=outputs)

    masses, armature = [3.0, 0.25], [0.5, 0.125]
    heavy = arm.with_bodies(masses, armature=armature)
    expected = changed(masses, armature)
    for name in outputs:
        arguments = state if name == "inverse_dynamics" else state[:1]
        assert_allclose(getattr(heavy, name)(*arguments), getattr(expected, name)(*arguments), rtol=1e-13)
    assert heavy.inverse_dynamics.arguments == ["q", "qd", "qdd"]
    with pytest.raises(AttributeError):
        heavy.load
    assert arm.inverse_dynamics.arguments == ["q", "qd", "qdd", "load"]
    for again in (pickle.loads(pickle.dumps(heavy)), copy.copy(heavy)):
        assert_array_equal(again.inertia([0.1, 0.2]), heavy.inertia([0.1, 0.2]))
    # Randomised worlds: a robot a state.
    many = np.array([[2.0, 1.0], [3.0, 0.25], [1.0, 1.5]])
    worlds = arm.with_bodies(many)
    found = worlds.inverse_dynamics(*state)
    assert found.shape == (3, 2)
    for mass, torque in zip(many, found):
        assert_array_equal(torque, arm.with_bodies(mass).inverse_dynamics(*state))
    out = np.empty((3, 2))
    assert_array_equal(worlds.inverse_dynamics(*state, out=out), found)
    with pytest.raises(ValueError, match="masses: expected \\(2,\\), found \\(3,\\)"):
        arm.with_bodies([1, 2, 3])
    with pytest.raises(ValueError, match="at state 1, body 0: the mass is -1"):
        arm.with_bodies([[1, 2], [-1, 2]])
    with pytest.raises(ValueError, match="viscous are constants"):
        arm.with_bodies(viscous=[1, 2])
    with pytest.raises(ValueError, match="bodies are constants"):
        own.with_bodies()
    with pytest.raises(TypeError, match="expected what `arm.load` returns"):
        arm.inertia([0.1, 0.2], arm.bodies)
    one = dalembert.load(pendulum, outputs=outputs, parameters="bodies", bodies=[2], keep_zeros=True)
    assert one.body_links == (2,)
    with pytest.raises(ValueError, match="z is 0.1, and stays zero as in the robot file"):
        one.with_bodies(centres=[[-0.2, 0.1, 0.1]])
    assert_allclose(one.with_bodies([0.25]).inertia([0.1, 0.2]), changed([2, 0.25], [0, 0]).inertia([0.1, 0.2]), rtol=1e-13)


def test_bodies_are_those_of_pinocchio():
    """Four Pandas with other bodies, torques from Pinocchio; the fingers' bodies are part of link 7's."""
    path = urdf("panda")
    golden = json.loads((path.parent / "panda.bodies.json").read_text())
    arm = dalembert.load(
        path, tip="panda_link8", lock="*", outputs="inverse_dynamics", parameters=["bodies", "viscous"]
    )
    bodies = np.array(golden["bodies"])
    robots = arm.with_bodies(bodies=bodies[:, None], viscous=np.zeros(7))
    q, qd, qdd = np.moveaxis(np.array(golden["states"]), 1, 0)
    expected = np.array(golden["torques"])
    found = robots.inverse_dynamics(q, qd, qdd)
    assert found.shape == expected.shape == (4, 10, 7)
    assert_allclose(found, expected, rtol=0, atol=1e-13 * np.abs(expected).max())


def test_wrenches_are_about_the_links_of_the_model():
    """Forces and moments between links, about the origins of the URDF's links, from Pinocchio."""
    path = urdf("panda")
    golden = json.loads((path.parent / "wrenches.json").read_text())
    # The finger slides.
    finger = {"panda_finger_joint2": 0}
    for name, tip, lock in (("panda", "panda_link8", "*"), ("panda_finger", "panda_leftfinger", finger)):
        values = golden[name]
        arm = dalembert.load(path, tip=tip, lock=lock, outputs="reaction_wrenches")
        assert [joint for joint, _ in arm.joints] == values["joints"]
        q, qd, qdd = np.moveaxis(np.array(values["states"]), 1, 0)
        expected = np.array(values["wrenches"])
        most = 1e-13 * np.abs(expected).max()
        assert_allclose(arm.reaction_wrenches(q, qd, qdd), expected, rtol=0, atol=most)


def test_links_that_branch():
    """A Panda with its hand: the second finger follows the first, on a limb of its own."""
    path = urdf("panda")
    values = json.loads((path.parent / "trees.golden.json").read_text())["panda"]
    arm = dalembert.load(path, tree=True, outputs=["inverse_dynamics", "inertia"])
    assert [name for name, _ in arm.joints] == values["joints"]
    assert arm.frames[0] == "panda_link1" and "panda_rightfinger" in arm.frames
    assert "hand" not in arm.frames
    both = dalembert.load(
        path, tip=["panda_leftfinger", "panda_rightfinger"], outputs=["inverse_dynamics"]
    )
    for state in values["states"]:
        q, qd, qdd, tau = (np.array(state[key]) for key in ("q", "qd", "qdd", "tau"))
        for loaded in (arm, both):
            most = 1e-13 * abs(tau).max()
            assert_allclose(loaded.inverse_dynamics(q, qd, qdd), tau, rtol=0, atol=most)
        expected = np.reshape(state["inertia"], (8, 8))
        assert_allclose(arm.inertia(q), expected, rtol=0, atol=1e-13 * abs(expected).max())
    with pytest.raises(ValueError, match="jacobian@panda_leftfinger"):
        dalembert.load(path, tree=True, outputs=["jacobian"])
    with pytest.raises(ValueError, match="both are given: tip=, tree="):
        dalembert.load(path, tree=True, tip="panda_hand")


def test_parameters_are_those_of_the_urdf():
    path = ROOT / "gallery" / "urdf" / "iiwa14.urdf"
    outputs = ["inverse_dynamics", "full_regressor"]
    arm = dalembert.load(path, tip="iiwa_link_ee", outputs=outputs)
    root = ElementTree.parse(path).getroot()
    drake = "{http://drake.mit.edu}"
    gears = {}
    for transmission in root.findall("transmission"):
        actuator = transmission.find("actuator")
        inertia = actuator.find(drake + "rotor_inertia") if actuator is not None else None
        if inertia is not None:
            ratio = float(actuator.find(drake + "gear_ratio").get("value"))
            joint = transmission.find("joint").get("name")
            gears[joint] = float(inertia.get("value")) * ratio**2
    expected, damping, armature = [], [], []
    for number, (name, _) in enumerate(arm.joints, 1):
        joint = root.find(f"joint[@name='{name}']")
        damping.append(float(joint.find("dynamics").get("damping")))
        armature.append(gears[name])
        link = root.find(f"link[@name='{joint.find('child').get('link')}']/inertial")
        c = np.array(link.find("origin").get("xyz").split(), float)
        mass = float(link.find("mass").get("value"))
        given = {key: float(value) for key, value in link.find("inertia").items()}
        rows = np.array([[given["i" + min(a + b, b + a)] for b in "xyz"] for a in "xyz"])
        about = rows + mass * (c @ c * np.eye(3) - np.outer(c, c))
        expected += [mass, *(mass * c)] + [about[k] for k in ((0, 0), (1, 1), (2, 2))]
        expected += [about[k] for k in ((0, 1), (1, 2), (0, 2))]
        assert_allclose(arm.parameters[f"Ixy{number}"], about[0, 1], rtol=1e-12, atol=1e-15)
    assert list(arm.parameters)[:11] == "m1 mx1 my1 mz1 Ixx1 Iyy1 Izz1 Ixy1 Iyz1 Ixz1 m2".split()
    assert_allclose(list(arm.parameters.values()), expected, rtol=1e-12, atol=1e-15)
    q, qd, qdd = np.random.default_rng(4).uniform(-2, 2, (3, 7))
    tau = arm.inverse_dynamics(q, qd, qdd) - damping * qd - armature * qdd
    assert_allclose(arm.full_regressor(q, qd, qdd) @ expected, tau, atol=1e-11)


def test_base_parameters_give_the_torques():
    arm = dalembert.load(robot("planar2r"), outputs=["inverse_dynamics", "regressor"])
    state = np.random.default_rng(5).uniform(-2, 2, (3, 2))
    pi = list(arm.base_parameters.values())
    assert_allclose(arm.regressor(*state) @ pi, arm.inverse_dynamics(*state), atol=1e-12)
    # Each name is a sum of parameters.
    for name, value in arm.base_parameters.items():
        terms = re.findall(r"(-?) ?([\d.]+ )?([a-zI]+\d)", name)
        signs = [-1 if minus else 1 for minus, _, _ in terms]
        sums = [float(factor or 1) * arm.parameters[own] for _, factor, own in terms]
        assert_allclose(np.dot(signs, sums), value, atol=1e-12)


def test_arms_are_pickled_and_copied(tmp_path):
    shutil.copy(urdf("so101"), tmp_path / "arm.urdf")
    options = {"tip": "gripper_frame_link", "lock": "*", "scalar": ["f64", "f32"], "cache": False}
    arm = dalembert.load(tmp_path / "arm.urdf", outputs="inertia", nan="raise", **options)
    # The file itself need not be there any more.
    (tmp_path / "arm.urdf").unlink()
    q = np.random.default_rng(3).normal(size=(4, 5))
    for again in (pickle.loads(pickle.dumps(arm)), copy.deepcopy(arm)):
        assert (again.joints, again.counts, again.notes) == (arm.joints, arm.counts, arm.notes)
        for given in (q, q.astype(np.float32)):
            assert_array_equal(again.inertia(given), arm.inertia(given))
        with pytest.raises(ValueError, match="not a number"):
            again.inertia(np.full(5, np.nan))


def test_functions_are_pickled_by_arm_and_name():
    """So that a pool of processes maps them; their named tuples come back."""
    outputs = ["gravity", "manipulator_equation"]
    arm = dalembert.load(robot("planar2r"), outputs=outputs, nan="raise")
    q = np.random.default_rng(4).normal(size=(6, 2))
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        loads = pool.map(arm.gravity, list(q))
        terms = pool.starmap(arm.manipulator_equation, list(zip(q, q)))
    assert_array_equal(loads, arm.gravity(q))
    assert type(terms[0]).__name__ == "ManipulatorEquation"
    for state, own in zip(q, terms):
        for found, expected in zip(own, arm.manipulator_equation(state, state)):
            assert_array_equal(found, expected)
    for again in (pickle.loads(pickle.dumps(arm.gravity)), copy.deepcopy(arm.gravity)):
        assert repr(again) == repr(arm.gravity)
        with pytest.raises(ValueError, match="not a number"):
            again(np.full(2, np.nan))


LOADS = """
import ctypes, gc, os, sys
import dalembert

NUMBERS = "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost"

class Info(ctypes.Structure):
    _fields_ = [(name, ctypes.c_size_t) for name in NUMBERS.split()]

def held():
    gc.collect()
    with open("/proc/self/statm") as pages:
        resident = int(pages.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    libc = ctypes.CDLL(None)
    if not hasattr(libc, "mallinfo2"):
        return resident, 0, sys.getallocatedblocks()
    libc.mallinfo2.restype = Info
    info = libc.mallinfo2()
    return resident, info.uordblks + info.hblkhd, sys.getallocatedblocks()

def load():
    arm = dalembert.load(sys.argv[2], outputs=sys.argv[3:], parameters=["payload"])
    assert arm.is_from_cache

for _ in range(100):
    load()
before = held()
for _ in range(int(sys.argv[1])):
    load()
print(*(after - before for before, after in zip(before, held())))
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="what is held is Linux's to tell")
def test_loads_do_not_add_up(tmp_path):
    """A kept arm, with a bundle and a frame in the request and in the plan beside the file.

    LOADS=30000 tries more of them.
    """
    count = int(os.environ.get("LOADS", "500"))
    outputs = ["gravity", "inertia", "jacobian@hand:local", "both=gravity+inertia"]
    options = {"outputs": outputs, "parameters": ["payload"]}
    dalembert.load(robot("planar2r"), **options).save(tmp_path / "arm.toml")
    dalembert.load(tmp_path / "arm.toml", **options)
    call = [sys.executable, "-c", LOADS, str(count), str(tmp_path / "arm.toml"), *outputs]
    done = subprocess.run(call, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    resident, allocated, blocks = map(int, done.stdout.split())
    print(f"{count} loads: {resident} bytes resident, {allocated} allocated, {blocks} blocks")
    assert allocated < 100 * count, "the allocator's bytes in use"
    assert blocks < 300, "Python's blocks in use"
    assert resident < 2 << 20


def test_help_says_what_a_payload_holds():
    said = " ".join(pydoc.render_doc(dalembert.Function).split())
    assert "mass, com x y z, inertia xx yy zz xy yz xz" in said, said
    assert "about the centre of mass" in said and "last link" in said and "payload_frame" in said


def test_wrong_options():
    for options, words in [
        ({"outputs": ["gravty"]}, "outputs: unknown output `gravty`: did you mean `gravity`?"),
        ({"outputs": "a=gravity"}, "outputs: a bundle has two parts at least"),
        ({"scalar": "f16"}, "scalar: unknown scalar `f16`"),
        ({"effort": "much"}, "known: quick, thorough"),
        ({"scene": "lunch"}, "lunch"),
        ({"nan": "ignore"}, "propagate"),
    ]:
        with pytest.raises(ValueError) as error:
            dalembert.load(robot("planar2r"), **options)
        assert words in str(error.value)
    with pytest.raises(FileNotFoundError, match="nowhere.urdf"):
        dalembert.load("nowhere.urdf")


def test_nan_raises_where_that_is_wanted():
    arm = dalembert.load(robot("planar2r"), outputs="gravity", nan="raise")
    q = np.zeros((4, 2))
    arm.gravity(q)
    q[2, 1] = np.nan
    with pytest.raises(ValueError, match="argument `q` is not a number at state 2, entry 1"):
        arm.gravity(q)


def test_saved_arms_are_loaded_without_a_search(tmp_path, planar):
    arm = dalembert.load(robot("planar2r"), outputs="gravity", cache=False)
    arm.save(tmp_path / "arm.toml")
    assert (tmp_path / "arm.plan").exists()
    again = dalembert.load(tmp_path / "arm.toml", outputs="gravity", cache=False)
    assert again.counts == arm.counts
    assert_array_equal(again.gravity([0.1, 0.2]), arm.gravity([0.1, 0.2]))
    arm.to_rust(tmp_path / "arm.rs")
    assert "pub fn gravity" in (tmp_path / "arm.rs").read_text()
    with pytest.raises(ValueError, match="ends in .toml"):
        arm.save(tmp_path / "arm.txt")


def test_a_header_has_names_and_an_ending_of_c(tmp_path):
    long = robot("planar2r").read_text().replace("planar2r", "a_robot_of_nineteen")
    (tmp_path / "arm.toml").write_text(long)
    arm = dalembert.load(tmp_path / "arm.toml", outputs="dynamic_coefficients")
    for path, write in [("arm.rs", arm.to_c), ("arm.h", arm.to_rust)]:
        with pytest.raises(ValueError, match="path: the name of a file of .* ends in"):
            write(tmp_path / path)
        assert not (tmp_path / path).exists()
    with pytest.warns(UserWarning, match="called `a_ro.*` in C: with `a_robot_of_nineteen`.*`name`"):
        arm.to_c(tmp_path / "arm.h")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        arm.to_c(tmp_path / "named.hpp", name="arm")
    assert " arm_dynamic_coefficients(" in (tmp_path / "named.hpp").read_text()
    with pytest.raises(ValueError, match="at most 31"):
        arm.to_c(tmp_path / "arm.h", name="a_robot_of_nineteen")


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler")
def test_c_has_the_same_bits(tmp_path):
    arm = dalembert.load(robot("planar3r"), outputs="gravity")
    arm.to_c(tmp_path / "arm.h")
    (tmp_path / "arm.c").write_text(
        '#include "arm.h"\nvoid run(const double *q, double *c) { planar3r_gravity(q, c); }\n'
    )
    command = ["cc", "-std=c99", "-O2", "-shared", "-fPIC", "arm.c", "-o", "arm.so", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    run = ctypes.CDLL(str(tmp_path / "arm.so")).run
    q, c = np.random.default_rng(1).normal(size=(100, 3)), np.empty(3)
    for row, expected in zip(q, arm.gravity(q)):
        run(ctypes.c_void_p(row.ctypes.data), ctypes.c_void_p(c.ctypes.data))
        assert_array_equal(c, expected)


def test_a_bundle_shares_work():
    arm = dalembert.load(robot("planar2r"), outputs=["servo=inverse_dynamics+jacobian"])
    found = arm.servo([0.1, 0.2], [0.3, 0.4], [0.5, 0.6])
    assert type(found).__name__ == "Servo" and found._fields == ("tau", "jacobian")
    assert found.tau.shape == (2,) and found.jacobian.shape == (6, 2)


def test_a_scene_with_a_tolerance_claims_its_bounds():
    arm = dalembert.load(robot("stanford"), scene="swing")
    own = arm.claim["functions"][0]
    assert own["function"] in arm.functions and "claim" in arm.proof[own["function"]]
    assert own["tolerated"]["relative_to"] == "range"


def command(*arguments):
    call = [sys.executable, "-m", "dalembert", *map(str, arguments)]
    return subprocess.run(call, capture_output=True, text=True, check=False)


def test_the_package_is_the_command(tmp_path):
    written = tmp_path / "arm.rs"
    done = command("generate", robot("planar2r"), "--outputs=gravity", "-o", written)
    assert done.returncode == 0 and "pub fn gravity" in written.read_text(), done.stderr
    assert "dalembert" in command("--version").stdout
    wrong = command("generate", tmp_path / "nowhere.toml")
    assert wrong.returncode == 2 and "nowhere.toml" in wrong.stderr


def run(code, **environment):
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_no_compiler_is_needed(tmp_path):
    code = (
        "import dalembert, shutil;"
        "assert shutil.which('cc') is None and shutil.which('rustc') is None;"
        f"arm = dalembert.load({str(robot('planar2r'))!r}, outputs='gravity', cache=False);"
        "print(arm.gravity([0.1, 0.2]).shape)"
    )
    assert run(code, PATH=str(tmp_path)).strip() == "(2,)"


def test_an_import_is_light():
    code = "import sys, dalembert; print(sorted({'numpy', 'json', 'html'} & set(sys.modules)))"
    assert run(code).strip() == "[]"


# What a shell starts in the background ignores interrupts, and so does all that it starts.
LISTENS = "signal.signal(signal.SIGINT, signal.default_int_handler)\n"


def test_an_interrupt_ends_a_short_search_at_once():
    code = (
        "import dalembert, signal, threading, os, time\n"
        f"{LISTENS}"
        "threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()\n"
        "try:\n"
        f"    dalembert.load({str(robot('puma560'))!r}, outputs='full_regressor', cache=False)\n"
        "    time.sleep(9)\n"
        "except KeyboardInterrupt:\n"
        "    print('ended')\n"
    )
    assert run(code).strip() == "ended"


@pytest.mark.parametrize("progress", [True, None, False])
def test_the_first_interrupt_of_a_long_search_keeps_the_best(tmp_path, progress):
    """A search that takes longer than a second says so, unless it shows more or is to be silent."""
    # Without the plan that is beside the file.
    shutil.copy(robot("puma560"), tmp_path / "arm.toml")
    code = (
        "import dalembert, io, signal, threading, os, sys\n"
        f"{LISTENS}"
        "threading.Timer(1.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()\n"
        "sys.stderr = io.StringIO()\n"
        f"arm = dalembert.load({str(tmp_path / 'arm.toml')!r}, outputs='inverse_dynamics', "
        f"effort='thorough', cache=False, progress={progress})\n"
        "said = sys.stderr.getvalue()\n"
        "print(arm.has_ended_early, arm.inverse_dynamics(*[[0.1] * 6] * 3).shape,\n"
        "    '[#' in said or '[.' in said, said.count('searching for functions of '))"
    )
    assert run(code).strip() == f"True (6,) {progress is True} {int(progress is None)}"


def test_a_search_is_told_once_and_only_if_it_is_long(capsys):
    note = Note("arm.urdf")
    note("gravity: search", None)
    assert capsys.readouterr().err == ""
    note._due = 0.0
    for _ in range(3):
        note("gravity: search", 0.5)
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and "searching for functions of arm.urdf" in said, said
