# SPDX-License-Identifier: MIT
import importlib
import subprocess
import sys

import pytest
from tricue import scenes
from tricue.former_names import MODULES


@pytest.mark.parametrize(("former", "present"), MODULES.items())
def test_former_modules_are_the_present_ones(former: str, present: str) -> None:
    """A module is imported by its name of version 0.1.0, with a warning that tells the present one."""
    if "got10k" in former:
        pytest.importorskip("got10k")
    sys.modules.pop(f"tricue.{former}", None)
    warning = rf"^tricue\.{former} is deprecated: it is tricue\.{present} now"
    with pytest.warns(DeprecationWarning, match=warning):
        module = importlib.import_module(f"tricue.{former}")
    assert module is importlib.import_module(f"tricue.{present}")
    assert module.__spec__ is not None
    assert module.__spec__.name == module.__name__ == f"tricue.{present}"


def test_a_former_program_runs() -> None:
    """``python -m tricue.trax``, which workspaces of the VOT toolkit name, is still the TraX program."""
    command = [sys.executable, "-m", "tricue.trax", "--help"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert "TRICUE_TRACKER" in done.stdout


def test_other_names_are_not_found() -> None:
    """A name that never was is missing as ever."""
    with pytest.raises(ModuleNotFoundError, match=r"No module named .tricue\.camera\.nothing"):
        importlib.import_module("tricue.camera.nothing")


@pytest.mark.parametrize(
    ("former", "present"), [("KINDS", "HEAD_KINDS"), ("OVERTAKINGS", "OVERTAKING_KINDS")]
)
def test_former_names_of_a_module_are_the_present_ones(former: str, present: str) -> None:
    """What a module exported by another name is still there, with a warning."""
    with pytest.warns(DeprecationWarning, match=rf"{former} is deprecated: it is {present} now"):
        assert getattr(scenes, former) is getattr(scenes, present)
    with pytest.raises(AttributeError, match="has no attribute 'SORTS'"):
        _ = scenes.SORTS
