# SPDX-License-Identifier: MIT
"""Trackers of two commits in turns: the files of the cases, the process that measures, and the table."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tricue
from tricue.scenes import face_over_clutter, head
from tricue.track.base import registry

from benchmarks import paired

FRAMES = 5


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where the cases' files go, instead of build/paired."""
    monkeypatch.setattr(paired, "FOLDER", tmp_path)
    return tmp_path


def site() -> Path:
    """The folder of the package that is tested."""
    return Path(tricue.__file__).parents[1]


@pytest.mark.parametrize(
    ("tracker", "scene", "camera", "channels"),
    [
        ("color-particle", face_over_clutter, None, ["color"]),
        ("stereo-head", head, "rig", ["color", "right"]),
    ],
)
def test_a_case_is_measured_from_its_file(
    folder: Path, tracker: str, scene: Any, camera: str | None, channels: list[str]
) -> None:
    """A process of the package reads the case's frames, box and camera, and gives each update's seconds."""
    made = scene(0, FRAMES)
    file = paired.dump("a name, 160x120", tracker, made, camera)
    assert file == folder / "a-name-160x120.npz"
    data = np.load(file)
    assert [name for name in ("color", "depth", "right") if name in data] == channels
    np.testing.assert_array_equal(data["color"][-1], made.frames[-1].color)
    seconds = paired.measure(site(), file)
    assert seconds.shape == (FRAMES - 1,)
    assert (seconds > 0).all()


def test_a_package_that_fails_ends_the_run(folder: Path, tmp_path: Path) -> None:
    """What can't track a case isn't left out of the table in silence."""
    file = paired.dump("case", "no-such-tracker", face_over_clutter(0, 2), None)
    with pytest.raises(subprocess.CalledProcessError):
        paired.measure(site(), file)


def test_every_tracker_has_a_case() -> None:
    """Each of ours is timed; all names differ, as files are named by them."""
    cases = list(paired.cases())
    assert {tracker for _, tracker, *_ in cases} == set(registry.names())
    assert len({name for name, *_ in cases}) == len(cases)


def test_table_takes_the_least_of_all_rounds(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Both commits take turns; an update's time is its least, a case's the median of its updates'."""
    runs = {
        "old": [[4e-6, 9e-6, 2e-6], [6e-6, 3e-6, 8e-6]],  # least 4, 3, 2: median 3
        "new": [[2e-6, 2e-6, 9e-6], [1e-6, 9e-6, 1.5e-6]],  # least 1, 2, 1.5: median 1.5
    }
    turns: list[str] = []

    def measure(site: Path, case: Path) -> Any:
        turns.append(site.name)
        return np.array(runs[site.name][turns.count(site.name) - 1])

    scene = face_over_clutter(0, 2)
    monkeypatch.setattr(paired, "cases", lambda: iter([("a case", "fused", scene, None)]))
    monkeypatch.setattr(paired, "build", Path)
    monkeypatch.setattr(paired, "measure", measure)
    monkeypatch.setattr(sys, "argv", ["paired", "old", "new", "--rounds", "2"])
    paired.main()
    assert turns == ["old", "new", "old", "new"]
    assert "| a case | 3 | 2 | 2.00 |" in capsys.readouterr().out


def test_worker_needs_nothing_new(folder: Path) -> None:
    """The worker runs in old packages: of them it knows the front door alone."""
    source = paired.WORKER.read_text()
    assert "from tricue" not in source
    file = paired.dump("case", "color-particle", face_over_clutter(0, 3), None)
    about = json.loads(str(np.load(file)["about"]))
    assert about == {"name": "case", "tracker": "color-particle", "camera": []}
