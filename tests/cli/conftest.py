# SPDX-License-Identifier: MIT
"""Recordings and sequences for the commands, a depth tracker, and trackers of one's own."""

import sys
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, Frame, Intrinsics, Status, Track
from tricue.errors import TargetNotFoundError
from tricue.track.base import registry
from tricue.track.base.params import Params
from tricue.track.base.traits import Channels, Traits

WALL, PERSON = 4.0, 2.0  # meters


@dataclass(frozen=True, slots=True, kw_only=True)
class NearestParams(Params):
    pass


class Nearest:
    """Follows what is nearer than 3 m in the depth image; finds it by itself."""

    Params = NearestParams
    traits = Traits(
        channels=(Channels.of("depth"),),
        camera=frozenset({"intrinsics"}),
        detects="person",
        shows=frozenset({"particles", "objects"}),
    )

    def __init__(
        self, seed: int = 0, kernels: str = "native", intrinsics: Intrinsics | None = None, **params: float
    ) -> None:
        self.params = NearestParams(**params)
        self.intrinsics = intrinsics
        self.objects: list[Box] = []
        self.particles = np.empty((0, 5))

    def init(self, frame: Frame, box: Box | None = None) -> Track:
        frame.require("depth")
        found = self._find(frame)
        if box is None and found is None:
            raise TargetNotFoundError("box: found nobody in this frame")
        return self._track(box or found, Status.TRACKED)

    def update(self, frame: Frame) -> Track:
        found = self._find(frame)
        return self._track(found or Box(0, 0, 4, 4), Status.TRACKED if found else Status.LOST)

    def _find(self, frame: Frame) -> Box | None:
        assert frame.depth is not None
        rows, columns = np.nonzero(frame.depth < 3)
        self.objects = []
        if len(rows):
            corners = (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1)
            self.objects = [Box.from_xyxy(*map(float, corners))]
        return self.objects[0] if self.objects else None

    def _track(self, box: Box | None, status: Status) -> Track:
        assert box is not None
        x, y = box.center
        self.particles = np.array([[x, y, box.width, box.height, PERSON]])
        camera = self.intrinsics
        position = None if camera is None else camera.back_project(x - 0.5, y - 0.5, PERSON)
        return Track(box, 0.5, status, position)


@pytest.fixture
def nearest() -> Nearest:
    """That tracker, without a camera."""
    return Nearest()


@pytest.fixture
def nearest_tracker(monkeypatch: pytest.MonkeyPatch) -> str:
    """The name under which ``create`` now makes that tracker."""
    monkeypatch.setitem(registry._BUILT_IN, "depth-particle", f"{Nearest.__module__}:Nearest")
    return "depth-particle"


def person_at(left: int | None) -> NDArray[np.uint16]:
    """Depth in millimeters, 80x60: a wall, in front of it a person of 10x30 px, and no measurement above."""
    image = np.full((60, 80), round(WALL * 1000), np.uint16)
    if left is not None:
        image[20:50, left : left + 10] = round(PERSON * 1000)
    image[:5] = 0
    return image


@pytest.fixture
def recording(tmp_path: Path) -> Path:
    """Six images of depth: two of nobody, then a person who goes right by 8 px a frame from x = 10."""
    folder = tmp_path / "recording" / "depth"
    folder.mkdir(parents=True)
    for index, left in enumerate([None, None, 10, 18, 26, 34]):
        cv2.imwrite(str(folder / f"{index}.png"), person_at(left))
    return folder


@pytest.fixture
def sequence(tmp_path: Path) -> Path:
    """Ten bright images, the last two black, in OTB's layout; the true box moves 2 px right a frame."""
    folder = tmp_path / "walk"
    (folder / "img").mkdir(parents=True)
    for index in range(10):
        cv2.imwrite(
            str(folder / "img" / f"{index:04}.png"), np.full((60, 80, 3), 200 * (index < 8), np.uint8)
        )
    lines = [f"{6 + 2 * index},11,20,20" for index in range(10)]
    (folder / "groundtruth_rect.txt").write_text("\n".join(lines))
    return folder


def write_sequence(folder: Path, frames: int, seed: int = 0, size: tuple[int, int] = (80, 60)) -> None:
    """OTB's layout: a bright textured square that goes round in a circle over noise."""
    rng = np.random.default_rng(seed)
    ground = rng.integers(20, 60, (size[1], size[0], 3), dtype=np.uint8)
    square = cv2.resize(rng.integers(90, 255, (4, 4, 3), dtype=np.uint8), (20, 20)) // [4, 4, 1]
    (folder / "img").mkdir(parents=True)
    lines = []
    for index in range(frames):
        x, y = 30 + round(20 * np.cos(index / 12)), 20 + round(15 * np.sin(index / 12))
        image = ground.copy()
        image[y : y + 20, x : x + 20] = square
        cv2.imwrite(str(folder / "img" / f"{index + 1:05d}.jpg"), image)
        lines.append(f"{x + 1},{y + 1},20,20\n")
    (folder / "groundtruth_rect.txt").write_text("".join(lines))


@pytest.fixture(scope="session")
def dataset(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Four sequences of 40 frames."""
    root = tmp_path_factory.mktemp("data")
    for seed, name in enumerate(("one", "two", "three", "four")):
        write_sequence(root / name, 40, seed)
    return root


OWN = """
import os, time
from pathlib import Path
print("imported")

class Mine:
    def init(self, frame, box): self.box = box
    def update(self, frame):
        print("| a | line | like | the table's |")
        return self.box

class Stays(Mine):
    def update(self, frame):
        Path("processes", str(os.getpid())).touch()
        time.sleep(1000)
"""


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working folder with trackers of one's own in it."""
    (tmp_path / "own_tracker.py").write_text(OWN)
    (tmp_path / "processes").mkdir()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [path for path in sys.path if path])
    return tmp_path
