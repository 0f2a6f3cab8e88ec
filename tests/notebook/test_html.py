# SPDX-License-Identifier: MIT
"""What values show in a notebook: whole HTML, escaped, with what a reader needs to know."""

import base64
import re
import subprocess
import sys
from dataclasses import dataclass
from html.parser import HTMLParser
from typing import Any

import cv2
import numpy as np
import pytest
import tricue
from numpy.typing import NDArray
from tricue import Box, Frame, Intrinsics, Pose, Status, StereoRig, Track
from tricue.evaluation.one_pass import Run
from tricue.notebook import markup
from tricue.track.base.params import Params, parameter

COLOR = np.random.default_rng(0).integers(0, 256, (48, 640, 3), np.uint8)
METERS = np.tile(np.linspace(1, 3, 64, dtype=np.float32), (48, 1))
METERS[:12] = np.nan
CAMERA = Intrinsics(60, 60, 31.5, 23.5, 64, 48)
COVARIANCE = np.diag([0.01, 0.04, 0.09]) ** 2
TRACK = Track(Box(1, 2, 3, 4.33333), 0.876, Status.OCCLUDED, np.array([0.1, -0.2, 2.0]), COVARIANCE, 2.0)
RUN = Run(
    np.zeros((4, 4)),
    np.array([1.0, 0.5, 0.5, 0.0]),
    (Status.TRACKED, Status.TRACKED, Status.OCCLUDED, Status.LOST),
    np.full((4, 3), np.nan),
    np.full((4, 3, 3), np.nan),
    np.full(3, 0.001),
)


class Reader(HTMLParser):
    """Checks that elements are closed in order, and keeps the text and the pictures."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.words: list[str] = []
        self.pictures: list[NDArray[Any]] = []

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        values = dict(attributes)
        if tag == "img":
            data = base64.b64decode((values["src"] or "").removeprefix("data:image/png;base64,"))
            self.pictures.append(cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED))
            assert values["alt"]
        elif tag != "br":
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.words.append(data)


def read(value: Any) -> Reader:
    """A value's HTML, read."""
    reader = Reader()
    reader.feed(value._repr_html_())
    reader.close()
    assert not reader.open
    return reader


def shown(value: Any) -> str:
    """The text that a reader sees."""
    return " ".join(" ".join(read(value).words).split())


@dataclass(frozen=True, slots=True, kw_only=True)
class SomeParams(Params):
    """With what HTML would take for its own."""

    size: int = parameter(3, unit="<b>px</b>", source="a & b", doc="of it")
    name: str = parameter("plain", unit="-", source="ours")


VALUES = {
    "Box": Box(1, 2, 3, 4),
    "Frame": Frame(COLOR, METERS, COLOR, timestamp=0.5, pose=Pose(np.eye(3))),
    "gray": Frame(COLOR[..., 0]),
    "nothing measured": Frame(depth=np.zeros((4, 5))),
    "one depth": Frame(depth=np.ones((4, 5))),
    "Intrinsics": CAMERA,
    "StereoRig": StereoRig(CAMERA, 0.1),
    "Track": TRACK,
    "lost": Track(Box(*[float("nan")] * 4), 0.0, Status.LOST),
    "Params": SomeParams(),
    "Run": RUN,
}


@pytest.mark.parametrize("value", VALUES.values(), ids=VALUES.keys())
def test_the_html_is_whole_and_has_no_colors_of_a_page(value: Any) -> None:
    """It proves that elements are closed, and that text and background keep the page's colors, light or dark.

    The dot of a status, whose color is seen on both, is all that has one.
    """
    read(value)
    colored = re.findall(r"background[^;\"]*|(?<![-\w])color:[^;\"]*", value._repr_html_())
    assert set(colored) <= {"color:#009E73", "color:#E69F00", "color:#D55E00"}


def test_a_frame_shows_its_channels() -> None:
    """It proves that each channel is a picture with its size, made small, in its own colors."""
    value = VALUES["Frame"]
    color, depth, scale, right = read(value).pictures
    assert color.shape == right.shape == (24, 320, 3)
    assert color.mean() == pytest.approx(COLOR.mean(), abs=1)
    assert depth.shape == (48, 64, 3)
    assert not depth[:12].any()
    text = shown(value)
    assert "Frame at 0.500 s, with a pose" in text
    assert "color, 640x48 px" in text
    assert "depth, 64x48 px, 75% measured" in text
    near, far = np.nanpercentile(METERS, [2, 98])
    assert f"{near:.2f} m {far:.2f} m" in text
    assert scale[0, 0].astype(int).sum() > scale[-1, 0].astype(int).sum()  # near is bright
    assert np.array_equal(scale[0, 0], depth[-1, 0])


def test_a_small_frame_is_shown_as_it_is() -> None:
    """It proves that pixels aren't resampled without need."""
    (picture,) = read(Frame(COLOR[:, :100])).pictures
    assert np.array_equal(picture, COLOR[:, :100])


def test_a_track_shows_its_position_with_its_deviation() -> None:
    """It proves that numbers come with units, and standard deviations from the covariance."""
    text = shown(TRACK)
    assert "● occluded score 0.88 box x 1.0, y 2.0, 3.0x4.3 px" in text
    assert "X +0.100 ± 0.010, Y -0.200 ± 0.040, Z +2.000 ± 0.090 m depth 2.000 m" in text
    assert "world" not in text
    moved = Track(TRACK.box, 1.0, Status.TRACKED, TRACK.position, pose=Pose(np.eye(3), (1, 0, 0)))
    assert "in the world X +1.100, Y -0.200, Z +2.000 m" in shown(moved)
    assert "position" not in shown(VALUES["lost"])


def test_parameters_that_were_changed_stand_out() -> None:
    """It proves that a changed value is bold beside its default, and that all text is escaped."""
    assert "SomeParams , all as by default" in shown(SomeParams())
    changed = SomeParams(size=5)
    assert "1 of 2 changed" in shown(changed)
    assert "size 5 3 <b>px</b> of it a & b name plain plain" in shown(changed)
    assert "<strong>5</strong>" in changed._repr_html_()
    assert "<strong>plain</strong>" not in changed._repr_html_()


def test_every_trackers_parameters_show_themselves() -> None:
    """It proves that there is a row for each parameter of our trackers."""
    for kind in ("color-particle", "depth-particle", "flow-depth", "fused", "stereo-head"):
        params = tricue.create(kind).params
        text = read(params).words
        assert set(type(params).__dataclass_fields__) <= set(text)


def test_cameras_show_angles_and_disparities() -> None:
    """It proves that what follows from the numbers is right: tan(angle / 2) = 32 / 60, d = f b / z."""
    assert "image 64x48 px" in shown(CAMERA)
    assert "56.1° by 43.6°" in shown(CAMERA)
    rig = StereoRig(Intrinsics(60, 60, 31.5, 23.5, 64, 48, Pose(np.eye(3), (0, 1, 0))), 0.1)
    assert "baseline 0.1 m disparity 6.0 px at 1 m, 3.0 px at 2 m" in shown(rig)
    assert "in the world at +0.000, +1.000, +0.000 m" in shown(rig)


def test_a_run_shows_its_statuses() -> None:
    """It proves that shares, mean score and speed are those of the run."""
    expected = (
        "Run frames 4 status tracked 50%, occluded 25%, lost 25% mean score 0.50 updates 1,000 per second"
    )
    assert shown(RUN) == expected


def test_text_is_escaped() -> None:
    """It proves that names from files can't become elements."""
    made = markup.table("<i>", ["<b>"], [["<script>"]])
    assert "<i>" not in made
    assert "<b>" not in made
    assert "<script>" not in made
    assert "&lt;script&gt;" in made


def test_plain_text_is_one_line() -> None:
    """It proves that arrays don't flood a console, and that what is absent is left out."""
    assert repr(VALUES["gray"]) == "Frame(color=<uint8 (48, 640)>)"
    frame = Frame(depth=METERS, timestamp=0.5)
    assert repr(frame) == "Frame(depth=<float32 (48, 64)>, timestamp=0.5)"
    assert repr(Track(Box(1, 2, 3, 4), 0.5, Status.LOST)) == (
        "Track(Box(x=1, y=2, width=3, height=4), score=0.5, status='lost')"
    )
    assert repr(RUN) == "Run(<4 frames>, lost=0.25)"
    assert "\n" not in repr(TRACK)
    assert "position=[0.1, -0.2, 2.0]" in repr(TRACK)


def test_the_import_of_tricue_leaves_it_out() -> None:
    """It proves that nobody pays for pictures who doesn't look at any."""
    code = "import sys, tricue; repr(tricue.Box(1, 2, 3, 4)); sys.exit('tricue.notebook' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
