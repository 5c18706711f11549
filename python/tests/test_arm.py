"""Arms: how they are loaded, and what they know."""

import os
import subprocess
import sys

import numpy as np
import pytest
from conftest import ROBOTS, data, robot, urdf
from numpy.testing import assert_allclose, assert_array_equal

import dalembert


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


def test_what_an_arm_knows(planar):
    assert planar.name == "planar3r"
    assert [joint.kind for joint in planar.joints] == ["revolute"] * 3
    assert planar.frames[0] == "base" and len(planar.frames) == 5
    assert planar.limits.lower.shape == (3,)
    assert planar.counts["gravity"]["mul"] > 0
    assert "random points" in planar.proof["inverse_dynamics"]
    assert planar.certificate is None
    assert "inverse_dynamics" in dir(planar) and "planar3r" in repr(planar)
    assert repr(planar.gravity) == "gravity(q) -> c (3,)"
    html = planar._repr_html_()
    assert "<svg" in html and "inverse_dynamics" in html
    with pytest.raises(AttributeError, match="loaded without 'coriolis'"):
        planar.coriolis
    with pytest.raises(AttributeError, match="no 'colour'"):
        planar.colour


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
    with pytest.raises(ValueError, match="gripper"):
        dalembert.load(urdf("so101"), **options)
    with pytest.raises(ValueError, match="nowhere"):
        dalembert.load(urdf("so101"), **{**options, "tip": "nowhere"})
    with pytest.raises(ValueError, match="wants a URDF and its tip"):
        dalembert.load(urdf("so101"), lock="*")


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


def test_wrong_options():
    for options, words in [
        ({"outputs": ["gravty"]}, "did you mean \"gravity\""),
        ({"scalar": "f16"}, "there is no \"f16\""),
        ({"effort": "much"}, "expected one of quick, thorough"),
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


def test_the_first_interrupt_of_a_long_search_keeps_the_best(tmp_path):
    code = (
        "import dalembert, signal, threading, os\n"
        "threading.Timer(2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()\n"
        f"arm = dalembert.load({str(robot('stanford'))!r}, outputs='jacobian', "
        "effort='thorough', cache=False, progress=True)\n"
        "print(arm.has_ended_early, arm.jacobian(arm.limits.lower * 0).shape)"
    )
    said = run(code).strip()
    assert said in ("True (6, 6)", "False (6, 6)")
