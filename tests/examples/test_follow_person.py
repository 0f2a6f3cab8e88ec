# SPDX-License-Identifier: MIT
import math
from collections.abc import Callable, Iterator
from contextlib import nullcontext
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import cv2
import numpy as np
import pytest
import tricue
from tricue import Box, Frame, Status, Track
from tricue.data.source import Source
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
    """It proves that it waits for a person, finds them, turns to their side, drives up to the distance, and
    stops at the end.
    """
    module = program("follow_person")
    commands: list[tuple[float, float]] = []
    monkeypatch.setattr(module, "drive", lambda *speeds: commands.append(speeds))
    module.main([str(recording), "--depth-scale", "0.001", "--fov", "47.5", "--distance", "1.5"])
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "0: nobody there"
    assert commands.pop() == (0.0, 0.0)
    assert len(commands) == len(person.frames)
    assert all("tracked" in line for line in lines[1:])
    for (forward, turn), (x, _, z) in zip(commands, person.positions.tolist(), strict=True):
        assert turn == pytest.approx(np.clip(module.TURN_GAIN * math.atan2(x, z), -1, 1), abs=0.1)
        assert forward == pytest.approx(np.clip(module.GAIN * (z - 1.5), -0.8, 0.8), abs=0.1)


def test_it_turns_a_head(recording: Path, program: Program, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that a pan-tilt head gets speeds instead, and stands still at the end."""
    program("follow_person").main([str(recording), "--depth-scale", "0.001", "--fov", "47.5", "--pan-tilt"])
    lines = [line for line in capsys.readouterr().out.splitlines() if "rad/s, tilt" in line]
    assert len(lines) == 21
    assert lines[-1] == "  pan +0.00 rad/s, tilt +0.00 rad/s"
    assert lines[-2] != lines[-1]


@pytest.mark.parametrize(
    ("error", "ending"),
    [(ValueError("depth/0009.png: can't be read"), SystemExit), (KeyboardInterrupt, None)],
)
def test_it_stops_when_the_images_do(
    error: Exception | type[KeyboardInterrupt],
    ending: type[SystemExit] | None,
    person: DepthScene,
    program: Program,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It proves that the last command is to stand still, after an image that can't be read or Ctrl-C, too."""

    def images() -> Iterator[Frame]:
        yield from person.frames[:3]
        raise error

    class Broken(Source):
        def __iter__(self) -> Iterator[Frame]:
            return images()

    module = program("follow_person")
    assert person.frames[0].depth is not None
    stream = SimpleNamespace(length=None, size=person.frames[0].depth.shape[::-1])
    source = Broken("walk", {"depth": stream})  # type: ignore[dict-item]
    monkeypatch.setattr(tricue, "open_source", lambda *_, **__: source)
    for option, name in (([], "drive"), (["--pan-tilt"], "turn_head")):
        commands: list[tuple[Any, ...]] = []
        monkeypatch.setattr(module, name, lambda *values, commands=commands: commands.append(values))
        with nullcontext() if ending is None else pytest.raises(ending):
            module.main(["walk", "--fov", "47.5", *option])
        assert len(commands) == 4
        last = commands[-1] if name == "drive" else commands[-1][0][:2]
        assert last == (0.0, 0.0)


def test_it_stops_without_the_person(program: Program) -> None:
    """It proves that the robot stands still when the person is lost or hidden, without a position, too."""
    follow = program("follow_person").follow
    assert follow(track_at(Status.LOST, 1, 3), 1.5) == (0.0, 0.0)
    assert follow(Track(Box(0, 0, 1, 1), 1.0, Status.TRACKED), 1.5) == (0.0, 0.0)
    assert follow(track_at(Status.OCCLUDED, 1, 3), 1.5) == (0.0, 0.0)
    forward, turn = follow(track_at(Status.TRACKED, -1, 1), 1.5)
    assert forward < 0
    assert turn < 0


@pytest.mark.parametrize("status", Status)
@pytest.mark.parametrize(("option", "name"), [([], "drive"), (["--pan-tilt"], "turn_head")])
def test_it_chases_nobody(
    status: Status,
    option: list[str],
    name: str,
    recording: Path,
    program: Program,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It proves that wheels and head stop while the person is hidden or lost, or the score low, for however
    long.
    """
    doubtful = Track(Box(0, 0, 10, 20), 0.1, status, np.array([1.0, 0.0, 3.0]))
    tracks = iter([track_at(Status.TRACKED, 0.1 * x, 3) for x in range(1, 9)] + 13 * [doubtful])
    stand_in = SimpleNamespace(init=lambda *_: next(tracks), update=lambda _: next(tracks))
    monkeypatch.setattr(tricue, "DepthParticleTracker", lambda **_: stand_in)
    module = program("follow_person")
    commands: list[Any] = []
    monkeypatch.setattr(module, name, lambda *values: commands.append(values))
    module.main([str(recording), "--depth-scale", "0.001", "--fov", "47.5", *option])
    speeds = [each if name == "drive" else each[0][:2] for each in commands]
    assert len(speeds) == 22
    assert speeds[7] != (0.0, 0.0)
    assert speeds[-5:] == 5 * [(0.0, 0.0)]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ([], "--fov 57"),
        (["--fov", "57", "--box", "a,b"], "expected four numbers x,y,width,height, got 'a,b'"),
        (["--fov", "57", "--box", "1,2"], "box"),
        (["--fov", "57", "--distance", "nan"], "--distance: expected a finite number"),
        (["--fov", "57", "--distance", "-1"], "--distance: expected meters above 0"),
    ],
)
def test_wrong_input_is_one_line(
    options: list[str], said: str, recording: Path, program: Program, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that an unknown camera, a wrong box and a distance that no motor should get are told with
    what to do, and exit code 2.
    """
    with pytest.raises(SystemExit) as stop:
        program("follow_person").main([str(recording), "--depth-scale", "0.001", *options])
    assert stop.value.code == 2
    assert said in capsys.readouterr().err.splitlines()[-1]


def test_a_pair_without_depth_is_refused(
    tmp_path: Path, program: Program, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that depth is what is said to be missing of a stereo pair, not the camera."""
    for side in ("left", "right"):
        (tmp_path / side).mkdir()
        assert cv2.imwrite(str(tmp_path / side / "0.png"), np.zeros((48, 64, 3), np.uint8))
    with pytest.raises(SystemExit) as stop:
        program("follow_person").main([str(tmp_path)])
    assert stop.value.code == 2
    assert "expected depth images, found only color and right" in capsys.readouterr().err
