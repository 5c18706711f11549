"""Robots of the project, and a cache of the session's own."""

from __future__ import annotations

import json
import os
import tempfile
from pathlib import Path

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
