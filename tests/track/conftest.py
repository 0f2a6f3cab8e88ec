# SPDX-License-Identifier: MIT
from dataclasses import dataclass

import pytest
from tricue import Box, Status, Track
from tricue.camera.box import BoxLike, as_box
from tricue.camera.frame import FrameLike, as_frame
from tricue.track.params import Params, parameter


@dataclass(frozen=True, slots=True, kw_only=True)
class DriftParams(Params):
    step: float = parameter(1.0, unit="px", source="made up")


class Drift:
    """A tracker that moves its box ``step`` to the right a frame; black frames lose it, dim ones hide it."""

    Params = DriftParams

    def __init__(self, **params: float) -> None:
        self.params = DriftParams(**params)
        self.box = Box(0, 0, 1, 1)

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        self.box = as_box(box) if box is not None else Box(0, 0, 8, 8)
        return self._track(frame)

    def update(self, frame: FrameLike) -> Track:
        self.box = self.box._replace(x=self.box.x + self.params.step)
        return self._track(frame)

    def _track(self, frame: FrameLike) -> Track:
        color = as_frame(frame).color
        assert color is not None
        score = float(color.mean()) / 255
        return Track(
            self.box, score, (Status.LOST, Status.OCCLUDED, Status.TRACKED)[(score > 0) + (score > 0.2)]
        )


@pytest.fixture
def drift() -> Drift:
    return Drift(step=2.5)
