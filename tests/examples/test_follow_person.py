# SPDX-License-Identifier: MIT
import math
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import cv2
import numpy as np
import pytest
from tricue import Box, Status, Track
from tricue.scenes import DepthScene, walker

Program = Callable[[str], ModuleType]


@pytest.fixture(scope="module")
def person() -> DepthScene:
    """Somebody who walks before a time-of-flight camera."""
    return walker(seed=0, frames=20)


@pytest.fixture(scope="module")
def recording(person: DepthScene, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The person's depth as 16-bit images in millimeters, after an empty frame."""
    folder = tmp_path_factory.mktemp("walk")
    images = [np.full_like(person.frames[0].depth, 3.0), *(frame.depth for frame in person.frames)]
    for number, depth in enumerate(images):
        assert depth is not None
        millimeters = np.rint(np.nan_to_num(depth) * 1000).astype(np.uint16)
        assert cv2.imwrite(str(folder / f"{number:04d}.png"), millimeters)
    return folder


def track_at(status: Status, x: float, z: float) -> Track:
    """A track at a position, meters."""
    return Track(Box(0, 0, 10, 20), 0.9, status, np.array([x, 0.0, z]))


def test_it_drives_to_the_person(
    person: DepthScene,
    recording: Path,
    program: Program,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """It proves that it waits for a person, finds them, turns to their side and drives up to the distance."""
    module = program("follow_person")
    commands: list[tuple[float, float]] = []
    monkeypatch.setattr(module, "drive", lambda *speeds: commands.append(speeds))
    module.main([str(recording), "--depth-scale", "0.001", "--fov", "47.5", "--distance", "1.5"])
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "0: nobody there"
    assert len(commands) == len(person.frames)
    assert all("tracked" in line for line in lines[1:])
    for (forward, turn), (x, _, z) in zip(commands, person.positions.tolist(), strict=True):
        assert turn == pytest.approx(np.clip(module.TURN_GAIN * math.atan2(x, z), -1, 1), abs=0.1)
        assert forward == pytest.approx(np.clip(module.GAIN * (z - 1.5), -0.8, 0.8), abs=0.1)


def test_it_turns_a_head(recording: Path, program: Program, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that a pan-tilt head gets speeds instead."""
    program("follow_person").main([str(recording), "--depth-scale", "0.001", "--fov", "47.5", "--pan-tilt"])
    assert capsys.readouterr().out.count("rad/s, tilt") == 20


def test_it_stops_without_the_person(program: Program) -> None:
    """It proves that the robot stands still when the person is lost, and doesn't drive at who hides them."""
    follow = program("follow_person").follow
    assert follow(track_at(Status.LOST, 1, 3), 1.5) == (0.0, 0.0)
    assert follow(Track(Box(0, 0, 1, 1), 1.0, Status.TRACKED), 1.5) == (0.0, 0.0)
    forward, turn = follow(track_at(Status.OCCLUDED, 1, 3), 1.5)
    assert forward == 0
    assert turn > 0
    forward, turn = follow(track_at(Status.TRACKED, -1, 1), 1.5)
    assert forward < 0
    assert turn < 0


def test_wrong_input_is_one_line(
    recording: Path, program: Program, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that an unknown camera is told with what to do, and exit code 2."""
    with pytest.raises(SystemExit) as stop:
        program("follow_person").main([str(recording), "--depth-scale", "0.001"])
    assert stop.value.code == 2
    assert "--fov 57" in capsys.readouterr().err
