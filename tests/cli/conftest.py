# SPDX-License-Identifier: MIT
"""Recordings for the commands, and a depth tracker."""

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
