# SPDX-License-Identifier: MIT
import cv2
import numpy as np
import pytest

from benchmarks.quality.cues import dense_flow as flow
from benchmarks.quality.cues.dense_flow import RatedFlow


@pytest.fixture(scope="module")
def cases():
    """The synthetic frames, by name."""
    return {frames.name: frames for frames in flow.synthetic()}


def test_all_find_a_small_shift(cases):
    """Of 1 px all are right to 0.3 px on our reliable half, and wrong where the truth is another."""
    frames = cases["shift 1 px"]
    for method in flow.METHODS.values():
        result = flow.measure(frames, method, rounds=1)
        assert max(result.errors) < 0.3
        assert min(result.seconds) > 0
        wrong = flow.measure(frames._replace(truth=-frames.truth), method, rounds=1)
        assert min(wrong.errors) > 1.7


def test_pyramid_follows_what_one_level_cannot(cases):
    """Of 4 px and where all turns the pyramid's half is right to 0.1 px."""
    for name in ("shift 4 px", "turn and grow"):
        assert flow.measure(cases[name], flow.pyramid(), rounds=1).errors[0] < 0.1
    assert flow.measure(cases["shift 4 px"], flow.one_level(), rounds=1).errors[0] > 1


def test_half_is_what_is_ranked_first():
    """Half of the known pixels, by angle^2 contrast, those without flow last."""
    angle = np.array([[1, 0.5, 1, 1, 0.1, 1]], np.float32)
    contrast = np.array([[1, 9, 100, 3, 50, 99]], np.float32)
    found = np.zeros((1, 6, 2), np.float32)
    found[0, 5] = np.nan
    known = np.array([[True, True, False, True, True, True]])
    half = flow.reliable_half(RatedFlow(found, angle, contrast), known)
    np.testing.assert_array_equal(half, [[False, True, False, True, False, False]])


def test_pixels_without_truth_do_not_count(cases):
    """Where nothing is known nothing is wrong."""
    frames = cases["shift 1 px"]
    truth = frames.truth.copy()
    truth[:60] += 50
    assert flow.measure(frames._replace(truth=truth), flow.pyramid(), rounds=1).errors[0] > 10
    truth[:60] = np.nan
    assert flow.measure(frames._replace(truth=truth), flow.pyramid(), rounds=1).errors[0] < 0.1


def test_ranking_is_that_of_the_errors(cases):
    """On synthetic frames one level's error falls nearly with angle and the root of contrast."""
    small = [cases[name] for name in ("shift 0.5 px", "shift 1 px", "turn and shrink")]
    for sigma in (1.5, 2.0, 3.0):
        angle, contrast = flow.fit(small, sigma)
        assert angle == pytest.approx(-1, abs=0.2)
        assert contrast == pytest.approx(-0.5, abs=0.06)


def test_frames_are_read_with_their_flow(tmp_path):
    """Huge numbers of the truth are unknown; a missing file is named."""
    folder = tmp_path / "Thing"
    folder.mkdir()
    with pytest.raises(OSError, match=r"expected Thing1.png, Thing2.png, Thing.flo in .*Thing"):
        flow.load(folder)
    for name in ("Thing1.png", "Thing2.png"):
        cv2.imwrite(str(folder / name), np.full((2, 3), 7, np.uint8))
    written = np.array([[[1, 2], [0, 0], [1.7e9, 1.7e9]]] * 2, np.float32)
    cv2.writeOpticalFlow(str(folder / "Thing.flo"), written)
    frames = flow.load(folder)
    np.testing.assert_array_equal(frames.truth[0], [[1, 2], [0, 0], [np.nan, np.nan]])
    assert frames.previous.shape == (2, 3)


def test_rubber_whale(data):
    """One level's half has at most DIS ultrafast's error, the pyramid's at most 0.7 times that."""
    whole = flow.load(data / "flow" / "RubberWhale")
    middle = np.s_[64:324, 132:452]
    frames = flow.Frames("middle", *(np.ascontiguousarray(image[middle]) for image in whole[1:]))
    column = 1 + flow.BASELINES.index("DIS ultrafast")
    for name, most in (("one level", 1.0), ("pyramid", 0.7)):
        result = flow.measure(frames, flow.METHODS[name], rounds=1)
        assert result.errors[0] <= most * result.errors[column]


def test_table_has_a_line_for_each(cases):
    """Both methods, for each case."""
    lines = flow.table([cases["shift 1 px"]], rounds=1).splitlines()
    assert [line.split("|")[2].strip() for line in lines] == ["flow", "---", "one level", "pyramid"]
    assert {line.count("|") for line in lines} == {len(flow.COLUMNS) + 1}
