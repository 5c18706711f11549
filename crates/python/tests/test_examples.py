"""The examples do what they say; pictures where matplotlib is installed."""

import doctest
import importlib.util
import sys
from pathlib import Path

import dalembert
import pytest
from dalembert import _arm

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def run(name, tmp_path):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    drawn = importlib.util.find_spec("matplotlib") is not None
    picture = tmp_path / f"{name}.png"
    result = module.main(str(picture) if drawn else None)
    assert picture.exists() == drawn
    return result


@pytest.mark.parametrize("module", [dalembert, _arm])
def test_docstrings(module, monkeypatch):
    monkeypatch.chdir(EXAMPLES.parents[2])
    failed, tried = doctest.testmod(module)
    assert tried >= 3 and failed == 0


def test_gravity_compensation(tmp_path):
    assert run("gravity_compensation", tmp_path) < 1e-8


def test_computed_torque(tmp_path):
    right, light = run("computed_torque", tmp_path)
    assert right < 1e-2 and light > 2 * right


def test_trajectory(tmp_path):
    pytest.importorskip("scipy")
    before, after = run("trajectory", tmp_path)
    assert after < 0.9 * before


def test_identification(tmp_path):
    assert run("identification", tmp_path) < 0.02
