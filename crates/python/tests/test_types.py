"""The stubs are what is there."""

import inspect
import re
import shutil
from pathlib import Path

import pytest

import dalembert
from dalembert import _dalembert


CONFIG = """
[mypy]
strict = True
[mypy-jax.*,torch.*]
follow_imports = skip
ignore_missing_imports = True
[mypy-dalembert.jax,dalembert.torch]
disallow_untyped_decorators = False
"""


def test_mypy_accepts_the_package(tmp_path):
    api = pytest.importorskip("mypy.api")
    ignored = shutil.ignore_patterns("*.so", "*.pyd", "__pycache__")
    shutil.copytree(Path(dalembert.__file__).parent, tmp_path / "dalembert", ignore=ignored)
    (tmp_path / "mypy.ini").write_text(CONFIG)
    config = [f"--config-file={tmp_path / 'mypy.ini'}", f"--cache-dir={tmp_path / 'cache'}"]
    use = tmp_path / "use.py"
    use.write_text(
        "import dalembert\n"
        "arm = dalembert.load('a.urdf', tip='hand', outputs=['gravity'])\n"
        "names: list[str] = [joint.name for joint in arm.joints]\n"
        "arm.gravity([0.1], threads=2)\n"
        "arm.save('a.toml')\n"
    )
    said, errors, status = api.run([*config, str(tmp_path / "dalembert"), str(use)])
    assert status == 0, said + errors
    use.write_text("import dalembert\ndalembert.load('a.urdf', tips='hand')\n")
    said, _, status = api.run([*config, str(use)])
    assert status == 1 and "tips" in said, said


def test_stubs_name_what_there_is():
    stub = (Path(dalembert.__file__).parent / "_dalembert.pyi").read_text()
    for owner in (_dalembert.Arm, _dalembert.Function, _dalembert.Load):
        body = stub.split(f"class {owner.__name__}:")[1].split("\nclass ")[0].split("\ndef ")[0]
        named = set(re.findall(r"def (\w+)\(", body)) - {"__call__", "__name__", "__new__"}
        there = {name for name, _ in inspect.getmembers(owner) if not name.startswith("_")}
        assert named == there
