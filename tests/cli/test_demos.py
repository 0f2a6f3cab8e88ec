# SPDX-License-Identifier: MIT
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tricue import Box, Frame, Status, Track
from tricue.cli import main
from tricue.cli.demos import depth, flow_depth, fused, stereo
from tricue.cli.demos.metric import SceneResult
from tricue.cli.outputs import Step
from tricue.scenes import crossing, head, overtaking, walker
from tricue.scenes.stress.scene import stress_scene

pytest.importorskip("matplotlib", reason="the plot needs matplotlib: pip install tricue[demo]")


def once(make: Callable[..., Any], *arguments: Any, **keywords: Any) -> Callable[[int], Any]:
    """Makes the scene of a seed once; the demo and the test look at the same."""
    made = cache(partial(make, *arguments, **keywords))
    return lambda seed: made(seed=seed)


@dataclass(frozen=True)
class Demo:
    """A demo on short scenes: what of its module is replaced, and the columns after a line's name."""

    name: str
    module: Any
    scenes: dict[str, Callable[[int], Any]]
    ways: dict[str, Any] | None = None  # what an entry has beside its scene
    hidden: tuple[str, int] = ("hidden", 0)  # in this line this column tells how many hidden frames are told

    @property
    def entries(self) -> dict[str, Any]:
        """As the module has them."""
        return {
            name: make if self.ways is None else (make, self.ways[name]) for name, make in self.scenes.items()
        }


DEMOS = [
    Demo(
        "depth-particle",
        depth,
        {"alone": once(walker, frames=6), "hidden": once(crossing, frames=45)},
        hidden=("hidden", 5),
    ),
    Demo(
        "stereo-head",
        stereo,
        {"jumping": once(head, frames=12, kind="jump"), "hidden": once(head, frames=50, kind="hidden")},
        hidden=("hidden", 6),
    ),
    Demo(
        "flow-depth",
        flow_depth,
        {
            "both": once(overtaking, frames=32),
            "flow": once(overtaking, frames=8),
            "depth": once(overtaking, frames=8, depth=True),
        },
        {"both": {}, "flow": {"cues": ("flow",)}, "depth": {}},
        hidden=("both", 4),
    ),
    Demo(
        "fused",
        fused,
        {
            "color": once(stress_scene, "hidden", size=(120, 90), channels="rgbd"),
            "both": once(stress_scene, "plain", size=(120, 90), channels="rgbd"),
            "pair": once(stress_scene, "plain", size=(120, 90), channels="stereo"),
        },
        {"color": ("color",), "both": ("color", "depth"), "pair": ("color", "right")},
        hidden=("color", 4),
    ),
]


@pytest.fixture(params=DEMOS, ids=lambda demo: demo.name)
def demo(request: pytest.FixtureRequest) -> Demo:
    """Each of the demos of one tracker."""
    if request.param.name == "fused":
        pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")
    return request.param


def test_demo_writes_a_table_a_video_and_a_plot(
    demo: Demo, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Every scene is run with its cues or channels and measured, the files are written, and the report is in
    words, without a name of the code.
    """
    monkeypatch.setattr(demo.module, "SCENES" if demo.ways is None else "CASES", demo.entries)
    assert main(["demo", demo.name, "--output", str(tmp_path), "--seed", "1"]) == 0
    out = capsys.readouterr().out.replace(str(tmp_path), "")
    assert "_" not in out
    words = [line.split() for line in out.splitlines() if not line.startswith(" ")]
    rows = {first: rest for first, *rest in filter(None, words) if first in demo.scenes}
    assert list(rows) == list(demo.scenes)
    for row in rows.values():
        assert float(row[0]) > 0.5  # overlap
        CHECKS[demo.name](row)
    name, column = demo.hidden
    hidden = int((demo.scenes[name](1).visible < 0.15).sum())
    assert hidden > 0
    assert rows[name][column].endswith(f"/{hidden}")
    MORE.get(demo.name, lambda _: None)(rows)
    assert cv2.imread(str(tmp_path / f"{demo.name}.png")) is not None
    capture = cv2.VideoCapture(str(tmp_path / f"{demo.name}.mp4"))
    count = sum(1 for _ in iter(lambda: capture.read()[0], False))
    assert count == sum(len(make(1).frames) for make in demo.scenes.values())


def check_depth(row: list[str]) -> None:
    """Errors in centimeters."""
    _, error, _, high, *_ = row
    assert float(error) < 15
    assert float(error) <= float(high)


def check_stereo(row: list[str]) -> None:
    """Errors in percent of the distance."""
    _, held, median, _, high, _, *_ = row
    assert float(held.removesuffix("%")) > 50
    assert float(median) < 4
    assert float(median) <= float(high)


def check_held(row: list[str]) -> None:
    """Held on most frames."""
    assert float(row[1].removesuffix("%")) > 50


def check_flow_depth(rows: dict[str, list[str]]) -> None:
    """Without depth there is no error of a position, and with it it is small."""
    assert rows["flow"][2] == "-"
    assert float(rows["both"][2]) < 0.5
    assert float(rows["depth"][2]) < 0.5


def check_fused(rows: dict[str, list[str]]) -> None:
    """On color alone there are no positions."""
    assert rows["color"][2:4] == ["-", "-"]


CHECKS = {
    "depth-particle": check_depth,
    "stereo-head": check_stereo,
    "flow-depth": check_held,
    "fused": check_held,
}
MORE = {"flow-depth": check_flow_depth, "fused": check_fused}


def test_errors_are_shares_of_the_distance() -> None:
    """An error of a hundredth of the way to the head is 1 %."""
    scene = head(seed=1, frames=2)
    tracks = [Track(Box(0, 0, 9, 9), 1.0, Status.TRACKED, 1.01 * place) for place in scene.positions]
    np.testing.assert_allclose(stereo.relative_errors(SceneResult(scene, tracks)), 1.0)


@pytest.mark.parametrize(
    ("module", "make"),
    [
        (depth, partial(walker, frames=6)),
        (flow_depth, partial(overtaking, frames=6)),
        (fused, partial(stress_scene, "plain", size=(120, 90), channels="rgbd")),
    ],
    ids=["depth", "flow_depth", "fused"],
)
def test_no_legend_is_drawn_over_a_path(module: Any, make: Callable[..., Any]) -> None:
    """The plots of a demo have one legend, outside of all of them, with what each path shows."""
    from matplotlib.figure import Figure

    scene = make(seed=1)
    tracks = [Track(Box(0, 0, 9, 9), 1.0, Status.TRACKED, place) for place in scene.positions]
    lost = [Track(Box(0, 0, 9, 9), 0.0, Status.LOST, place) for place in scene.positions]
    figure = Figure(layout="constrained")
    module._plot(figure, {"tracked": SceneResult(scene, tracks), "lost": SceneResult(scene, lost)})
    assert all(axes.get_legend() is None for axes in figure.axes)
    (legend,) = figure.legends
    assert {"truth", "tracked", "lost"} <= {text.get_text() for text in legend.get_texts()}


def test_the_picture_is_there_without_color_and_without_truth() -> None:
    """Depth alone makes a picture of the same size, and the true box is only drawn where there is one."""
    track = Track(Box(20, 20, 30, 30), 1.0, Status.TRACKED)
    depths = np.full((90, 120), 2.0, np.float32)
    depths[30:60, 40:80] = 1.0
    for frame in (Frame(np.zeros((90, 120, 3), np.uint8)), Frame(depth=depths)):
        known = fused._picture(Step(1, frame, track, 0.1), np.array([50.0, 40, 20, 20]), "here")
        unknown = fused._picture(Step(1, frame, track, 0.1), np.full(4, np.nan), "here")
        assert known.shape == unknown.shape
        assert (known != unknown).any()
