# SPDX-License-Identifier: MIT
import importlib
import re
import sys
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
import pytest
import tricue
from numpy.typing import NDArray
from PIL import Image
from tricue import Box, Track
from tricue.camera.frame import as_frame
from tricue.doctor.install import install_extra
from tricue.evaluation import one_pass
from tricue.scenes import face_over_clutter, overtaking
from tricue.track.base.track import Tracker

pytest.importorskip("matplotlib", reason="got10k imports it: pip install tricue[got10k,evaluate]").use("Agg")
got10k = pytest.importorskip("got10k", reason="the toolkit that is to run ours: pip install tricue[got10k]")
experiments = importlib.import_module("got10k.experiments")
datasets = importlib.import_module("got10k.datasets")
as_got10k = importlib.import_module("tricue.evaluation.toolkits.got10k").as_got10k

Images = Sequence[NDArray[np.uint8]]


class LocalOTB(experiments.ExperimentOTB):  # type: ignore[misc, name-defined]  # got10k has no types
    """The experiment, without the download that its constructor asks for."""

    def __init__(self, folder: Path) -> None:
        self.dataset = datasets.OTB(str(folder / "OTB"), version=2015, download=False)
        self.result_dir, self.report_dir = str(folder / "results"), str(folder / "reports")
        self.nbins_iou, self.nbins_ce = 21, 51


class Walks(LocalOTB):
    """The experiment that keeps what a tracker returned, before it is rounded for the file."""

    boxes: NDArray[np.float64]

    def _record(self, record_file: str, boxes: NDArray[np.float64], times: NDArray[np.float64]) -> None:
        self.boxes = boxes
        super()._record(record_file, boxes, times)


def write_otb(folder: Path, images: Images, boxes: Sequence[Box]) -> None:
    """A sequence as OTB lays it out, under one of its names; PNG by content, so that no pixel changes."""
    (folder / "OTB" / "Walking" / "img").mkdir(parents=True)
    for index, image in enumerate(images):
        data = cv2.imencode(".png", image)[1].tobytes()
        (folder / "OTB" / "Walking" / "img" / f"{index + 1:04d}.jpg").write_bytes(data)
    np.savetxt(folder / "OTB" / "Walking" / "groundtruth_rect.txt", boxes, fmt="%.17g", delimiter=",")


def scene_for(name: str) -> tuple[list[NDArray[np.uint8]], tuple[Box, ...]]:
    """A short scene that the tracker is made for, its frames in color alone."""
    if name == "color-particle":
        pytest.importorskip("skimage", reason="the scene needs scikit-image: pip install tricue[demo]")
        made = face_over_clutter(1, frames=15)
        return [frame.color for frame in made.frames if frame.color is not None], made.boxes
    walk = overtaking(0, 15)
    return [frame.color for frame in walk.frames if frame.color is not None], walk.boxes


@pytest.fixture(
    params=[("color-particle", {"seed": 3, "observation": "region"}), ("flow-depth", {"cues": ("flow",)})],
    ids=lambda p: p[0],
)
def case(request: pytest.FixtureRequest) -> tuple[Tracker, Tracker, Images, Sequence[Box]]:
    """A tracker that follows color, its twin, and a scene for both."""
    name, params = request.param
    return tricue.create(name, **params), tricue.create(name, **params), *scene_for(name)


def test_got10ks_experiment_gives_the_boxes_of_one_pass(
    case: tuple[Tracker, Tracker, Images, Sequence[Box]], tmp_path: Path
) -> None:
    """It proves that got10k's own loop over files gets from a tracker, bit for bit, the boxes that our
    one-pass evaluation gets from the same pixels. Its first box is the one that the tracker was given.
    """
    tracker, twin, images, boxes = case
    write_otb(tmp_path, images, boxes)
    experiment = Walks(tmp_path)
    experiment.run(as_got10k(tracker, "ours"))
    frames = [as_frame(image) for image in images]
    expected = one_pass.run(twin, frames, boxes[0]).boxes
    np.testing.assert_array_equal(experiment.boxes[0], boxes[0])
    np.testing.assert_array_equal(experiment.boxes[1:], expected[1:])
    written = np.loadtxt(tmp_path / "results" / "ours" / "Walking.txt", delimiter=",")
    np.testing.assert_allclose(written, expected, rtol=0, atol=0.0005 + 1e-9)
    assert np.ptp(expected[:, 0]) > 5  # it did follow


def test_swapped_channels_would_change_the_result() -> None:
    """It proves that the order of the channels matters: the same tracker given RGB ends elsewhere.

    Not every one would: the default observation compares ranks and bins of three channels alike.
    """
    images, boxes = scene_for("color-particle")
    params = {"seed": 3, "observation": "region"}
    adapted, swapped = (
        as_got10k(tricue.create("color-particle", **params)),
        tricue.create("color-particle", **params),
    )
    rgb = [np.ascontiguousarray(image[:, :, ::-1]) for image in images]
    adapted.init(Image.fromarray(rgb[0]), np.array(boxes[0]))
    swapped.init(rgb[0], boxes[0])
    pairs = [(adapted.update(Image.fromarray(each)), np.array(swapped.update(each).box)) for each in rgb[1:]]
    assert any(not np.array_equal(ours, theirs) for ours, theirs in pairs)


class Recorder:
    """Keeps the frame that it is given."""

    seen: NDArray[np.uint8]

    def init(self, frame: NDArray[np.uint8], box: Box) -> Track:
        return self.update(frame)

    def update(self, frame: NDArray[np.uint8]) -> Track:
        self.seen = frame
        return Track(Box(1.25, 2, 3, 4), 1.0, tricue.Status.TRACKED)


@pytest.mark.parametrize("mode", ["RGB", "L", "RGBA", "P"])
def test_pictures_of_every_mode_arrive_as_bgr(mode: str) -> None:
    """It proves that color arrives in our order and gray in three equal channels, in frames we accept."""
    rgb = np.random.default_rng(0).integers(0, 256, (6, 8, 3), dtype=np.uint8)
    image, recorder = Image.fromarray(rgb).convert(mode), Recorder()
    as_got10k(recorder).init(image, np.array([1.0, 2, 3, 4]))  # type: ignore[arg-type]
    expected = cv2.cvtColor(np.array(image.convert("RGB")), cv2.COLOR_RGB2BGR)
    np.testing.assert_array_equal(as_frame(recorder.seen).color, expected)
    if mode == "RGB":
        np.testing.assert_array_equal(recorder.seen, rgb[:, :, ::-1])
    if mode == "L":
        np.testing.assert_array_equal(recorder.seen, np.array(image)[:, :, None] * np.ones(3, np.uint8))


def test_it_is_got10ks_tracker(drift: Tracker) -> None:
    """It proves that got10k's own class is its base, that it is deterministic, and that its name is the
    class's or the one given.
    """
    adapted = as_got10k(drift)
    assert isinstance(adapted, got10k.trackers.Tracker)
    assert (adapted.name, adapted.is_deterministic) == ("Drift", True)
    assert as_got10k(drift, "fast").name == "fast"


def test_boxes_are_arrays_and_init_starts_again(drift: Tracker) -> None:
    """It proves that a box is a (4,) float array that isn't rounded, and that a second init restarts."""
    adapted, image = as_got10k(drift), Image.fromarray(np.full((20, 30, 3), 200, np.uint8))
    for _ in range(2):
        assert adapted.init(image, np.array([1.0, 2.0, 8.0, 9.0])) is None  # type: ignore[func-returns-value]
        box = adapted.update(image)
        assert box.dtype == np.float64
        np.testing.assert_array_equal(box, [3.5, 2, 8, 9])


def test_a_lost_target_keeps_its_last_box() -> None:
    """It proves that a third party's target of unknown place, of NaN, doesn't make a sequence's mean one."""

    class Unsure(Recorder):
        def update(self, frame: NDArray[np.uint8]) -> Track:
            return Track(Box(*[float("nan")] * 4), 0.0, tricue.Status.LOST)

    adapted, image = as_got10k(Unsure()), Image.new("RGB", (64, 48))  # type: ignore[arg-type]
    adapted.init(image, np.array([1.0, 2, 3, 4]))
    assert adapted.update(image).tolist() == [1, 2, 3, 4]


def test_misuse_is_named() -> None:
    """It proves that what is no tracker is refused, and one that needs depth says so when it is started."""
    with pytest.raises(TypeError, match=r"^tracker: expected a tricue tracker, got str"):
        as_got10k("csrt")  # type: ignore[arg-type]
    adapted = as_got10k(tricue.create("depth-particle"))
    with pytest.raises(ValueError, match="expected the channel depth"):
        adapted.init(Image.new("RGB", (64, 48)), np.array([10.0, 10, 20, 20]))


def test_without_got10k_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that without the toolkit the import fails and says what to install."""
    monkeypatch.setitem(sys.modules, "got10k.trackers", None)
    monkeypatch.delitem(sys.modules, "tricue.evaluation.toolkits.got10k")
    with pytest.raises(ImportError, match=re.escape(install_extra("got10k"))):
        importlib.import_module("tricue.evaluation.toolkits.got10k")
