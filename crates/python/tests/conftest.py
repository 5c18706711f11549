"""Robots of the project, and a cache of the session's own."""

from __future__ import annotations

import json
import os
import tempfile
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[3]
ROBOTS = ("puma560", "stanford", "ur10", "panda", "planar2r", "planar3r")

_folder = tempfile.TemporaryDirectory(prefix="dalembert-")
os.environ["DALEMBERT_CACHE"] = _folder.name


def robot(name: str) -> Path:
    return ROOT / "generated" / "robots" / f"{name}.toml"


def urdf(name: str) -> Path:
    return ROOT / "crates" / "import" / "tests" / "data" / f"{name}.urdf"


def data(kind: str, name: str) -> dict:
    return json.loads((ROOT / "crates" / "model" / "tests" / "data" / kind / f"{name}.json").read_text())


def slopes(function, arrays, step=1e-6):
    """Central differences of Σ of the results by every entry of every argument."""
    found = []
    for k, array in enumerate(arrays):
        own = np.empty_like(array)
        for index in np.ndindex(array.shape):
            ends = []
            for sign in (1, -1):
                moved = [x.copy() for x in arrays]
                moved[k][index] += sign * step
                ends.append(function(*moved).sum())
            own[index] = (ends[0] - ends[1]) / (2 * step)
        found.append(own)
    return found


@pytest.fixture(scope="session")
def planar():
    import dalembert

    return dalembert.load(
        robot("planar3r"),
        outputs=[
            "inverse_dynamics",
            "gravity",
            "inertia",
            "manipulator_equation",
            "inverse_dynamics_derivatives",
            "forward_dynamics",
            "forward_dynamics_derivatives",
            "jacobian",
        ],
        scalar=["f64", "f32"],
    )
