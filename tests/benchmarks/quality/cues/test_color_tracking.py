# SPDX-License-Identifier: MIT
import cv2
import numpy as np
import pytest
from tricue import Box, Frame
from tricue.evaluation import baselines, metrics
from tricue.evaluation.one_pass import run

from benchmarks.quality.common import perturbed_starts, sequences
from benchmarks.quality.common.color_search import ColorSearch, SearchParams
from benchmarks.quality.cues import color_tracking


@pytest.fixture(scope="module")
def disc():
    """A reddish ellipse 40x50 px that moves 3 px a frame to the right over bluish clutter; true boxes."""
    rng = np.random.default_rng(1)
    ground = cv2.resize(rng.integers(30, 120, (12, 16, 3), dtype=np.uint8) + np.uint8([60, 0, 0]), (160, 120))
    frames, boxes = [], []
    for index in range(20):
        image = ground.copy()
        x, y = 40 + 3 * index, 60
        cv2.ellipse(image, (x, y), (20, 25), 0, 0, 360, (60, 80, 170), cv2.FILLED)
        frames.append(Frame(color=image))
        boxes.append(Box(x - 19.5, y - 24.5, 40.0, 50.0))
    return tuple(frames), boxes


@pytest.mark.parametrize("gradient", [0.0, 0.35])
def test_search_follows_an_ellipse(disc, gradient):
    """The center stays within 2 px of the moving disc's, with the gradient's term and without."""
    frames, boxes = disc
    found = run(ColorSearch(SearchParams(gradient_weight=gradient)), frames, boxes[0]).boxes
    off = np.abs(found[:, :2] - np.array(boxes)[:, :2])
    assert off.max() <= 2
    np.testing.assert_allclose(found[:, 2:], [[40, 50]] * 20)


def test_gradient_pulls_to_the_outline(disc):
    """From a start that is 8 % off the center, the outline brings the ellipse back onto the disc."""
    frames, boxes = disc
    start = boxes[0]._replace(x=boxes[0].x + 3.2, y=boxes[0].y + 4)

    def error(gradient):
        found = run(ColorSearch(SearchParams(gradient_weight=gradient)), frames, start).boxes
        return np.abs(found[-1, :2] - boxes[-1][:2]).sum()

    assert error(0.35) < error(0.0)


def test_starts_are_the_box_and_six_around_it():
    """Shifted by 8 % along each axis, or scaled by 6 % around the same center."""
    box = Box(100.0, 50.0, 50.0, 100.0)
    found = perturbed_starts.starts(box)
    assert found[0] == box
    np.testing.assert_allclose(
        found[1:5], [[104, 50, 50, 100], [96, 50, 50, 100], [100, 58, 50, 100], [100, 42, 50, 100]]
    )
    np.testing.assert_allclose([each.center for each in found[5:]], [box.center] * 2)
    np.testing.assert_allclose([each.width / box.width for each in found[5:]], [0.94, 1.06])


def test_score_is_taken_from_every_start(disc):
    """A box that never moves has, from each start, the score of that start over the whole sequence."""
    frames, boxes = disc
    truth = np.array(boxes)
    sequence = sequences.Sequence("disc", frames, truth)
    scores, fps = perturbed_starts.measure(lambda seed: baselines.StillBox(), sequence)
    still = [np.tile(start, (20, 1)) for start in perturbed_starts.starts(boxes[0])]
    assert scores == [metrics.score(each, truth) for each in still]
    assert len({score.mean_error for score in scores}) > 3
    assert fps > 0
    line = perturbed_starts.table({"still": lambda seed: baselines.StillBox()}, [sequence]).splitlines()[2]
    assert line.startswith("| still | 0.")


def test_missing_sequence_is_named(tmp_path, capsys):
    """A sequence that isn't in the folder is refused by name."""
    with pytest.raises(SystemExit):
        color_tracking.main([str(tmp_path)])
    assert f"expected some with true boxes under {tmp_path}, got 'David'" in capsys.readouterr().err


@pytest.mark.parametrize(("name", "least"), [("David", 0.42), ("Girl", 0.55)])
def test_search_holds_recorded_heads(data, name, least):
    """The mean AUC over the seven starts is what the color search alone has to reach."""
    scores, _ = perturbed_starts.measure(lambda seed: ColorSearch(), sequences.load(data / "color" / name))
    assert np.mean([score.auc for score in scores]) >= least
