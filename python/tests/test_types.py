"""The stubs are what is there."""

import inspect
import re
from pathlib import Path

import pytest

import dalembert
from dalembert import _dalembert


def test_mypy_accepts_the_package(tmp_path):
    api = pytest.importorskip("mypy.api")
    use = tmp_path / "use.py"
    use.write_text(
        "import dalembert\n"
        "arm = dalembert.load('a.urdf', tip='hand', outputs=['gravity'])\n"
        "names: list[str] = [joint.name for joint in arm.joints]\n"
        "arm.gravity([0.1], threads=2)\n"
        "arm.save('a.toml')\n"
    )
    package = Path(dalembert.__file__).parent
    said, errors, status = api.run(["--strict", str(package), str(use)])
    assert status == 0, said + errors
    use.write_text("import dalembert\ndalembert.load('a.urdf', tips='hand')\n")
    assert api.run(["--strict", str(use)])[2] == 1


def test_stubs_name_what_there_is():
    stub = (Path(dalembert.__file__).parent / "_dalembert.pyi").read_text()
    for owner in (_dalembert.Arm, _dalembert.Function):
        body = stub.split(f"class {owner.__name__}:")[1].split("\nclass ")[0].split("\ndef ")[0]
        named = set(re.findall(r"def (\w+)\(", body)) - {"__call__", "__name__"}
        there = {name for name, _ in inspect.getmembers(owner) if not name.startswith("_")}
        assert named == there
