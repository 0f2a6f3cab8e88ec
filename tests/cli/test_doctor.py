# SPDX-License-Identifier: MIT
"""``tricue doctor`` as a user runs it, in whole and in damaged installations."""

import json
import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest
import tricue

PACKAGE = Path(tricue.__file__).parent
SECTIONS = [
    *("Versions", "Machine", "cv2, OpenCV for Python", "Cameras", "Video encoders", "Extras", "Places"),
    "Self test",
]


def doctor(*options: str, path: Path | None = None) -> subprocess.CompletedProcess[str]:
    """The command in a process of its own. path: a folder in front of the packages."""
    found = os.environ.get("PYTHONPATH", "")
    environment = {**os.environ, "PYTHONPATH": f"{path}{os.pathsep}{found}" if path else found}
    command = [sys.executable, "-m", "tricue", "doctor", *options]
    return subprocess.run(command, capture_output=True, text=True, env=environment, check=False)


@pytest.fixture(scope="module")
def whole() -> subprocess.CompletedProcess[str]:
    """What it says of this installation, as JSON."""
    return doctor("--json")


def test_this_installation_is_healthy(whole):
    """Exit code 0, all sections, nothing on stderr."""
    assert whole.returncode == 0, whole.stdout
    assert whole.stderr == ""
    report = json.loads(whole.stdout)
    assert report["healthy"]
    assert list(dict.fromkeys(each["section"] for each in report["findings"])) == SECTIONS


def test_the_encoders_were_tried(whole):
    """Each of those that tricue can write with has a line, and cv2's work wherever the tests run."""
    lines = {each["name"]: each for each in json.loads(whole.stdout)["findings"]}
    assert {"H.264 in .mp4", "VP9 in .webm", "VP8 in .webm", "MJPG in .avi"} <= set(lines)
    assert lines["MJPG in .avi"]["verdict"] == "ok"


def test_the_core_tells_what_it_was_built_with(whole):
    """Compiler, OpenCV and Eigen; and by which instructions it runs."""
    lines = {each["name"]: each["text"] for each in json.loads(whole.stdout)["findings"]}
    assert "OpenCV " in lines["native core"]
    assert "Eigen " in lines["native core"]
    assert lines["kernels run as"] == tricue._core._build_info["instructions"]


@pytest.fixture
def damaged(tmp_path):
    """A copy of the package, in front of the installed one, to be damaged."""
    copy = tmp_path / "tricue"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    return copy


def verdicts(run: subprocess.CompletedProcess[str]) -> dict[str, tuple[str, str]]:
    """Verdict and text by name."""
    return {each["name"]: (each["verdict"], each["text"]) for each in json.loads(run.stdout)["findings"]}


def test_without_the_native_core(damaged):
    """Nothing else can be imported, and the report says why and how to build it."""
    for core in [*damaged.glob("_core*.so"), *damaged.glob("_core*.pyd")]:
        core.unlink()
    run = doctor("--json", path=damaged.parent)
    assert run.returncode == 1, run.stderr
    verdict, text = verdicts(run)["native core"]
    assert verdict == "failed"
    assert "there is none" in text
    assert "Self test" not in {each["section"] for each in json.loads(run.stdout)["findings"]}


def test_with_a_core_that_does_not_load(damaged):
    """As of another system; the text form ends in a line that sums it up."""
    (core,) = [*damaged.glob("_core*.so"), *damaged.glob("_core*.pyd")]
    core.write_bytes(b"no library")
    run = doctor(path=damaged.parent)
    assert run.returncode == 1
    assert "can't be loaded: ImportError" in run.stdout
    assert run.stdout.splitlines()[-1].startswith("tricue can't run: native core")
    assert "Traceback" not in run.stdout + run.stderr


@pytest.mark.parametrize("module", ["numpy", "cv2"])
def test_with_a_broken_package(tmp_path, module):
    """What the core needs and can't be imported is told, with its odd error."""
    (tmp_path / module).mkdir()
    (tmp_path / module / "__init__.py").write_text("raise RuntimeError('built for something else')")
    run = doctor("--json", path=tmp_path)
    assert run.returncode == 1, run.stderr
    name = {"numpy": "NumPy", "cv2": "cv2"}[module]
    assert verdicts(run)[name] == ("failed", "RuntimeError: built for something else")


def test_the_script_runs_it_too(damaged):
    """The command ``tricue doctor``, where the core is missing."""
    script = Path(sysconfig.get_path("scripts")) / "tricue"
    if not script.is_file():
        pytest.skip("needs tricue's script")
    for core in [*damaged.glob("_core*.so"), *damaged.glob("_core*.pyd")]:
        core.unlink()
    environment = {**os.environ, "PYTHONPATH": str(damaged.parent)}
    run = subprocess.run([script, "doctor"], capture_output=True, text=True, env=environment, check=False)
    assert run.returncode == 1, run.stderr
    assert "tricue can't run: native core" in run.stdout


def test_others_hear_of_it(damaged):
    """``import tricue`` fails as ever where the core is missing, also with the word in the arguments."""
    for core in [*damaged.glob("_core*.so"), *damaged.glob("_core*.pyd")]:
        core.unlink()
    environment = {**os.environ, "PYTHONPATH": str(damaged.parent)}
    command = [sys.executable, "-c", "import tricue", "tricue", "doctor"]
    run = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    assert run.returncode == 1
    assert "python -m tricue doctor tells more" in run.stderr
