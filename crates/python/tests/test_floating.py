"""A robot whose base floats: values, names, poses and gradients."""

import importlib
import json
import pickle
import shutil
import subprocess

import numpy as np
import pytest
from conftest import ROOT, slopes
from numpy.testing import assert_allclose

import dalembert
from dalembert import pose

FILE = ROOT / "crates/model/tests/data/two_legs.toml"
STATES = json.loads((ROOT / "crates/model/tests/data/golden/two_legs.json").read_text())["states"]
CONTACT = "contact_forward_dynamics@left_foot,right_foot"


@pytest.fixture(scope="module")
def legs():
    return dalembert.load(
        FILE,
        outputs=[
            "inverse_dynamics",
            "forward_dynamics",
            "inertia",
            "gravity",
            "inverse_dynamics_derivatives",
            "forward_dynamics_derivatives",
            "centroidal_momentum_matrix",
        ],
    )


def given(key):
    return np.array([state[key] for state in STATES])


def test_values_of_pinocchio(legs):
    q, qd, qdd, g = (given(key) for key in ("q", "qd", "qdd", "g"))
    slopes = legs.inverse_dynamics_derivatives(q, qd, qdd, g)
    for found, key in [
        (legs.inverse_dynamics(q, qd, qdd, g), "tau"),
        (legs.forward_dynamics(q, qd, given("effort"), g), "accelerations"),
        (legs.inertia(q), "inertia"),
        (legs.gravity(q, g), "gravity"),
        (slopes.dtau_dq, "dtau_dq"),
        (slopes.dtau_dqd, "dtau_dqd"),
        (legs.centroidal_momentum_matrix(q), "centroidal"),
    ]:
        expected = given(key).reshape(found.shape)
        scale = np.abs(expected).max()
        assert_allclose(found / scale, expected / scale, rtol=0, atol=1e-12, err_msg=key)


def test_names_in_place_of_numbers(legs):
    assert legs.base == "trunk"
    n = len(legs.joints)
    names = [joint.name for joint in legs.joints]
    assert legs.places == {"trunk": slice(0, 6), **{name: 6 + k for k, name in enumerate(names)}}
    q = legs.positions({names[2]: 0.5}, fill=0.1)
    assert q.tolist() == [0.5 if k == 2 else 0.1 for k in range(n)]
    qd = legs.rates({"trunk": [1, 2, 3, 4, 5, 6], names[-1]: 7})
    assert qd.tolist() == [1, 2, 3, 4, 5, 6, *([0] * (n - 1)), 7]
    tau = legs.inverse_dynamics(q, qd, 0 * qd, [0, 0, -9.81])
    parts = legs.by_name(tau)
    assert list(parts) == ["trunk", *names] and parts["trunk"].tolist() == tau[:6].tolist()
    assert parts[names[1]] == tau[7]
    assert legs.by_name(q)[names[2]] == 0.5
    rows = legs.by_name(legs.inertia(q), axis=0)
    assert rows["trunk"].shape == (6, n + 6) and rows[names[0]].shape == (n + 6,)
    many = legs.by_name(legs.inverse_dynamics(np.tile(q, (5, 1)), qd, 0 * qd, [0, 0, -9.81]))
    assert many[names[0]].shape == (5,)
    with pytest.raises(ValueError, match="did you mean"):
        legs.positions({names[0] + "s": 1})
    with pytest.raises(ValueError, match="no joint 'trunk'"):
        legs.positions({"trunk": 1})
    with pytest.raises(ValueError, match="axis -1 has 3 entries"):
        legs.by_name([1, 2, 3])
    again = pickle.loads(pickle.dumps(legs))
    assert again.base == "trunk" and again.joints == legs.joints


@pytest.mark.parametrize("scene", [None, "squat"])
def test_inertia_in_blocks(scene):
    legs = dalembert.load(FILE, outputs=["inertia", "inertia_blocks"], scene=scene)
    names = ["left_hip", "left_knee", "right_hip"] + (["right_slide"] if scene is None else [])
    assert legs.limbs == (("left_hip", "left_knee"), tuple(names[2:]))
    q = given("q")
    whole, parts = legs.inertia(q), legs.inertia_blocks(q)
    joints = whole[:, 6:, 6:].copy()
    first = 0
    for block in legs.blocks(parts.limbs):
        rows = slice(first, first + block.shape[-1])
        assert_allclose(block, joints[:, rows, rows], rtol=0, atol=1e-15)
        joints[:, rows, rows] = 0
        first = rows.stop
    assert first == len(names) and not joints.any()
    assert_allclose(parts.base, whole[:, :6, :6], rtol=0, atol=1e-14)
    assert_allclose(parts.coupling, whole[:, :6, 6:], rtol=0, atol=1e-14)
    with pytest.raises(ValueError, match="blocks: expected"):
        legs.blocks(parts.base)


def test_a_scene_locks_the_base(legs, tmp_path):
    file = tmp_path / "legs.toml"
    file.write_text(FILE.read_text() + '\n[scene.stand]\nlock = { trunk = "level" }\n')
    held = dalembert.load(file, outputs=["inverse_dynamics"], scene="stand")
    assert held.base is None and held.limbs == ()
    assert held.places == {joint.name: place for place, joint in enumerate(held.joints)}
    q, qd = np.full(4, 0.3), np.linspace(-1, 1, 4)
    tau = held.inverse_dynamics(q, qd, qd)
    wide = np.concatenate([np.zeros(6), qd])
    assert_allclose(tau, legs.inverse_dynamics(q, wide, wide, [0, 0, -9.81])[6:], rtol=0, atol=1e-13)


def test_arguments_have_their_lengths(legs):
    n = len(legs.joints)
    with pytest.raises(ValueError, match=rf"argument `qd` has shape \({n},\), expected \({n + 6},\)"):
        legs.inverse_dynamics(np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(3))
    with pytest.raises(ValueError, match="not available where the base floats|floats"):
        dalembert.load(FILE, outputs=["dynamic_coefficients"])


def test_contacts():
    legs = dalembert.load(FILE, outputs=[CONTACT, "joint_torques_free"])
    name = next(name for name in legs.functions if name.startswith("contact"))
    assert set(legs.functions[name].arguments) == {"q", "qd", "tau", "g", "damping"}


def turns(count=50):
    rng = np.random.default_rng(5)
    xyzw = rng.normal(size=(count, 4))
    return xyzw / np.linalg.norm(xyzw, axis=1, keepdims=True), rng


def test_poses():
    xyzw, rng = turns()
    wxyz = np.roll(xyzw, 1, axis=1)
    x, y, z, w = xyzw.T
    rows = 2 * np.array([x * z - w * y, y * z + w * x, 0.5 - x * x - y * y])
    g = pose.gravity(xyzw=xyzw)
    assert_allclose(g, -9.81 * rows.T, atol=1e-14)
    assert_allclose(pose.gravity(wxyz=wxyz), g, rtol=0, atol=0)
    assert_allclose(pose.gravity(wxyz=[1, 0, 0, 0]), [0, 0, -9.81])
    position, step = rng.normal(size=(2, 50, 3)), rng.uniform(-1.5, 1.5, (50, 6))
    moved, turned = pose.integrate(position[0], step, wxyz=wxyz)
    same = pose.difference(position[0], moved, wxyz=(wxyz, turned))
    assert_allclose(same, step, atol=1e-13)
    other = pose.integrate(position[0], step, xyzw=xyzw)[1]
    assert_allclose(np.roll(turned, -1, axis=1), other, rtol=0, atol=0)
    for axes in ("mixed", "world", "split"):
        velocity, rate = rng.normal(size=(2, 50, 6))
        there = {"position": position[0], "xyzw": xyzw}
        seen = pose.velocity_in(axes, velocity, **there)
        assert_allclose(pose.velocity_from(axes, seen, **there), velocity, atol=1e-13)
        # The rate of what is seen, by differences along the motion.
        ends = []
        for sign in (1, -1):
            step = sign * 1e-6 * velocity
            at, to = pose.integrate(position[0], step, xyzw=xyzw)
            changed = velocity + sign * 1e-6 * rate
            ends.append(pose.velocity_in(axes, changed, position=at, xyzw=to))
        found = pose.acceleration_in(axes, velocity, rate, **there)
        assert_allclose(found, (ends[0] - ends[1]) / 2e-6, atol=1e-7)
        assert_allclose(pose.acceleration_from(axes, velocity, found, **there), rate, atol=1e-13)


def test_poses_say_what_is_wrong():
    with pytest.raises(TypeError, match="one of xyzw= and wxyz="):
        pose.gravity()
    with pytest.raises(TypeError, match="one of xyzw= and wxyz="):
        pose.gravity(xyzw=[0, 0, 0, 1], wxyz=[1, 0, 0, 0])
    with pytest.raises(TypeError):
        pose.gravity([0, 0, 0, 1])
    with pytest.raises(ValueError, match="four numbers"):
        pose.gravity(xyzw=[0, 0, 1])
    with pytest.raises(ValueError, match="axes: expected one of mixed, world, split"):
        pose.velocity_in("local", np.zeros(6), xyzw=[0, 0, 0, 1])
    with pytest.raises(ValueError, match=r"expected \(..., 6\)"):
        pose.integrate([0, 0, 0], [0, 0, 0], xyzw=[0, 0, 0, 1])


NAMES = ["inverse_dynamics", "forward_dynamics"]


def arrays(legs):
    n = len(legs.joints)
    rng = np.random.default_rng(9)
    return [rng.normal(size=(3, size)) for size in (n, n + 6, n + 6, 3)]


def squares(function):
    return lambda *given: function(*given) ** 2


@pytest.mark.parametrize("name", NAMES)
def test_jax(legs, name):
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    of = getattr(importlib.import_module("dalembert.jax"), name)(legs)
    given = arrays(legs)
    expected = slopes(squares(getattr(legs, name)), given)
    found = jax.jit(jax.grad(lambda *all: (of(*all) ** 2).sum(), argnums=(0, 1, 2, 3)))(*given)
    for own, other in zip(found, expected):
        assert_allclose(np.asarray(own), other, atol=1e-7 * np.abs(other).max())
    one = jax.vmap(of)(*given)
    assert_allclose(one, getattr(legs, name)(*given), rtol=0, atol=0)
    with pytest.raises(TypeError, match="expected 4 arrays, found 3"):
        of(*given[:3])
    with pytest.raises(ValueError, match=r"expected \(..., 10\)"):
        of(given[0], given[0], *given[2:])


@pytest.mark.parametrize("name", NAMES)
def test_torch(legs, name):
    torch = pytest.importorskip("torch")
    of = getattr(importlib.import_module("dalembert.torch"), name)(legs)
    given = arrays(legs)
    expected = slopes(squares(getattr(legs, name)), given)
    tensors = [torch.tensor(x, requires_grad=True) for x in given]
    (of(*tensors) ** 2).sum().backward()
    for own, other in zip(tensors, expected):
        assert_allclose(own.grad.numpy(), other, atol=1e-7 * np.abs(other).max())
    (first,) = torch.autograd.grad(of(*tensors).sum(), tensors[0], create_graph=True)
    with pytest.raises(RuntimeError, match="no second derivatives"):
        first.sum().backward()


def test_the_turn_of_a_base_is_a_tangent(legs):
    """The base's columns of the slopes are what a turn about its axes does to gravity in them."""
    q, qd, qdd, g = (given(key) for key in ("q", "qd", "qdd", "g"))
    by = legs.inverse_dynamics_derivatives(q, qd, qdd, g)
    step = 1e-6
    for axis in range(3):
        turn = np.eye(3)[axis]
        ends = [
            legs.inverse_dynamics(q, qd, qdd, g - sign * step * np.cross(turn, g))
            for sign in (1, -1)
        ]
        expected = (ends[0] - ends[1]) / (2 * step)
        assert_allclose(by.dtau_dq[..., 3 + axis], expected, atol=1e-6)


def test_a_header_with_names(legs, tmp_path):
    legs.to_c(tmp_path / "legs.h", name="legs")
    header = (tmp_path / "legs.h").read_text()
    assert "LEGS_BASE" in header and "LEGS_JOINT_NAMES" in header
    if shutil.which("cc"):
        (tmp_path / "main.c").write_text(
            '#include "legs.h"\nint main(void) { return LEGS_NV != 10; }\n'
        )
        out = tmp_path / "main"
        subprocess.run(["cc", "-std=c99", tmp_path / "main.c", "-o", out, "-lm"], check=True)
        subprocess.run([out], check=True)


def quadruped():
    """An MJCF of a made-up quadruped: nothing is symmetric, and joints are damped."""
    legs = ""
    for name, x, y in [("fl", 1, 1), ("fr", 1, -1), ("rl", -1, 1), ("rr", -1, -1)]:
        legs += f"""
        <body name="{name}_hip" pos="{0.19 * x} {0.05 * y} 0.01" quat="0.98 0.1 {0.05 * y} 0">
          <inertial pos="{-0.005 * x} {0.002 * y} 0" quat="0.5 0.5 0.6 0.4" mass="0.7"
            diaginertia="0.0009 0.0006 0.0005"/>
          <joint name="{name}_hip" axis="1 0 0" damping="2" armature="0.01"/>
          <body name="{name}_thigh" pos="0 {0.1 * y} 0">
            <inertial pos="-0.004 {-0.02 * y} -0.03" mass="1.2" diaginertia="0.006 0.0058 0.0009"/>
            <joint name="{name}_thigh" axis="0 1 0" damping="2" armature="0.01"/>
            <body name="{name}_calf" pos="0 0 -0.21">
              <inertial pos="0.006 0 {-0.14 - 0.01 * x}" mass="0.24" diaginertia="0.00145 0.0014 6e-05"/>
              <joint name="{name}_calf" axis="0 1 0.1" damping="1" armature="0.02"/>
            </body>
          </body>
        </body>"""
    return f"""<mujoco model="quadruped">
      <compiler angle="radian"/>
      <worldbody>
        <body name="trunk" pos="0 0 0.4">
          <freejoint/>
          <inertial pos="0.02 0 -0.005" quat="0.7 0.1 0 0.7" mass="7" diaginertia="0.1 0.09 0.03"/>
          {legs}
        </body>
      </worldbody>
    </mujoco>"""


def test_mujoco(tmp_path):
    """Inverse and forward dynamics of MuJoCo, whose base has other axes and another order of q."""
    mujoco = pytest.importorskip("mujoco")
    file = tmp_path / "quadruped.xml"
    file.write_text(quadruped())
    model = mujoco.MjModel.from_xml_path(str(file))
    data = mujoco.MjData(model)
    robot = dalembert.load(file, exact=True, outputs=["inverse_dynamics", "forward_dynamics"])
    assert robot.base == "trunk"
    assert [joint.name for joint in robot.joints] == [model.joint(k).name for k in range(1, 13)]
    rng = np.random.default_rng(1)
    for _ in range(60):
        q, qd, qdd = rng.uniform(-2, 2, 12), 2 * rng.normal(size=18), 5 * rng.normal(size=18)
        wxyz = rng.normal(size=4)
        wxyz /= np.linalg.norm(wxyz)
        rate = pose.acceleration_in("split", qd[:6], qdd[:6], wxyz=wxyz)
        data.qpos[:] = np.r_[rng.normal(size=3), wxyz, q]
        data.qvel[:] = np.r_[pose.velocity_in("split", qd[:6], wxyz=wxyz), qd[6:]]
        data.qacc[:] = np.r_[rate, qdd[6:]]
        mujoco.mj_inverse(model, data)
        expected = data.qfrc_inverse.copy()
        g = pose.gravity(wxyz=wxyz)
        tau = robot.inverse_dynamics(q, qd, qdd, g)
        found = np.r_[pose.rotate(tau[:3], wxyz=wxyz), tau[3:]]
        assert_allclose(found, expected, rtol=0, atol=1e-14 * np.abs(expected).max())
        data.qfrc_applied[:] = expected
        mujoco.mj_forward(model, data)
        again = robot.forward_dynamics(q, qd, tau, g)
        assert_allclose(again, qdd, rtol=0, atol=1e-11 * np.abs(qdd).max())
        there = np.r_[pose.acceleration_in("split", qd[:6], again[:6], wxyz=wxyz), again[6:]]
        assert_allclose(there, data.qacc, rtol=0, atol=1e-11 * np.abs(qdd).max())
